// Whole clusters against the view: outside, facing away, in need of clipping, and how near.
#pragma once

#include "raster/mesh_clusters.h"
#include "raster/screen_vertex.h"
#include "raster/tile_grid.h"

#include <array>

namespace rawtexel::raster {

/// What is certain about a cluster's triangles under one transform. No test is wrong about a single one of them, rounding included.
struct ClusterView {
    bool outside = false;      ///< every triangle is outside the view volume, or beside all samples of the active tiles
    bool unclipped = false;    ///< every vertex is finite and inside of all planes that clip
    bool facing_away = false;  ///< every triangle that has an area once snapped is a back face; asks for `unclipped`
    float nearest = 1.0f;      ///< no depth of it is greater
    SampleBox box{};           ///< holds all of it once snapped; asks for `unclipped`
};

/// Tests the clusters of one draw.
class ClusterCull {
  public:
    ClusterCull(const Draw& draw, const FrameOptions& options, const TileGrid& grid);

    /// `back_faces_matter`: whether to find out about `facing_away`.
    ClusterView view(const Cluster& cluster, bool back_faces_matter) const;

  private:
    /// A linear form over the object's space: a*x + b*y + c*z + d.
    struct Form {
        glm::dvec3 slope;
        double constant;
    };
    struct Range {
        double low, high;
    };
    /// The cluster's bounds by their middle.
    struct Box {
        glm::dvec3 middle, half;
    };
    /// Over the box, widened by more than rounding moves the vertices' own values.
    static Range range_over(const Form& form, const Box& box);
    static Form combine(double p, const Form& f, double q, const Form& g);
    static SampleBox box_over(const Range& x, const Range& y, const Range& w);
    bool outside_samples(const Box& box) const;
    bool faces_away(const Cluster& cluster, const Box& box, const Range& x, const Range& y, const Range& w) const;

    Form x_, y_, z_, w_, before_near_;  ///< homogeneous pixels, as ScreenVertex
    std::array<Form, 4> beyond_samples_;
    SampleBox sample_box_;
    glm::dvec3 eye_;  ///< where x_, y_ and w_ vanish, in homogeneous object space
    double eye_w_;
    double x_length_, y_length_, w_length_, eye_length_;  ///< of the slopes, and of the eye
    bool front_is_clockwise_;
};

}  // namespace rawtexel::raster
