// What moves the cameras of a document (glTF 2.0, 3.11).
#pragma once

#include "scenes/accessor.h"
#include "scenes/gltf_document.h"
#include "scenes/gltf_nodes.h"

#include "shading/camera_animation.h"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rawtexel::scenes {

/// The animations of a document that was read with LoadOptions::camera_animations; of one that was not there are none. All three arguments
/// outlive it.
class GltfCameraAnimations {
  public:
    GltfCameraAnimations(const GltfDocument& document, const Accessors& accessors, const GltfNodes& nodes);

    /// Of the first animation that moves a node or one of its parents all that does so; nullopt when none does. Throws InputError for key
    /// frames that are not what glTF allows, and where the document asks for more memory than its size allows.
    std::optional<shading::CameraAnimation> of(int node) const;

  private:
    using ChannelPlace = std::pair<int, int>;  ///< animation and channel

    shading::MovingTransform read_node(int animation, int node) const;
    shading::KeyTrack read_track(const ChannelPlace& place, int components) const;
    shading::KeyInterpolation interpolation_of(const std::string& name, const std::string& what) const;
    std::vector<float> read_times(int accessor, const std::string& what) const;
    std::vector<glm::dvec4> read_values(int accessor, size_t count, int components, const std::string& what) const;
    std::vector<float> read_all(int accessor, int components, const std::string& what) const;

    const GltfDocument& document_;
    const Accessors& accessors_;
    const GltfNodes& nodes_;
    std::vector<int> first_animation_;                                   ///< of every node, what moves its parents counted; -1: none
    std::map<std::pair<int, int>, std::vector<ChannelPlace>> channels_;  ///< by animation and node
};

}  // namespace rawtexel::scenes
