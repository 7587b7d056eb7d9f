// Perspective-correct interpolation of one triangle at one point, in quadruple precision.
#pragma once

#include <glm/glm.hpp>

namespace rawtexel::reference {

using Quad = __float128;

/// A vertex in homogeneous pixels: (x/w, y/w) on the screen, z/w the depth.
struct QuadVertex {
    Quad x, y, z, w;
};

/// Transform and viewport without rounding but for the quadruple's own.
QuadVertex to_screen(const glm::mat4& clip_from_object, const glm::vec3& position, int width, int height);

struct QuadWeights {
    Quad b[3];  ///< sum 1
    Quad inverse_w, depth;
};

/// Solves b0*P0 + b1*P1 + b2*P2 = s*(x, y, 1) by Cramer's rule.
QuadWeights weights_at(const QuadVertex (&vertex)[3], Quad x, Quad y);

enum class Side { Inside, Outside, OnBorder };

/// The visible part (0 <= depth <= 1, w > 0) of an unsnapped triangle as the half planes that bound it on the screen.
class VisiblePart {
  public:
    explicit VisiblePart(const QuadVertex (&vertex)[3]);

    /// OnBorder when a bounding line passes closer than `tolerance` pixels, or the triangle is seen edge-on.
    Side side_of(double x, double y, double tolerance) const;

  private:
    /// Distance in pixels from the line, positive inside: a*x + b*y + c.
    struct Bound {
        long double a, b, c;
    };
    Bound bound_[6];
    bool edge_on_;
};

}  // namespace rawtexel::reference
