#include "scenes/gltf_cameras.h"

#include "scenes/message_text.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <limits>
#include <numeric>

namespace rawtexel::scenes {
namespace {

constexpr int kNone = -1;

std::string name_of(int animation) { return "animations[" + std::to_string(animation) + "]"; }
std::string name_of(int animation, const char* list, int element) {
    return name_of(animation) + "." + list + "[" + std::to_string(element) + "]";
}

bool is_pose(const std::string& path) { return path == "translation" || path == "rotation" || path == "scale"; }

/// An animation's time runs over all of its tracks that move the camera.
void widen_times(const shading::KeyTrack& track, shading::CameraAnimation& animation) {
    if (!track.moves()) return;
    animation.first_time = std::min(animation.first_time, double(track.times.front()));
    animation.last_time = std::max(animation.last_time, double(track.times.back()));
}

}  // namespace

GltfCameraAnimations::GltfCameraAnimations(const GltfDocument& document, const Accessors& accessors, const GltfNodes& nodes)
    : document_(document), accessors_(accessors), nodes_(nodes), first_animation_(nodes.parent.size(), kNone) {
    const std::vector<tinygltf::Animation>& animations = document.model.animations;
    for (int a = 0; a < int(animations.size()); ++a) {
        const std::vector<tinygltf::AnimationChannel>& channels = animations[size_t(a)].channels;
        for (int c = 0; c < int(channels.size()); ++c) {
            const tinygltf::AnimationChannel& channel = channels[size_t(c)];
            if (channel.target_node < 0 || !is_pose(channel.target_path)) continue;
            channels_[{a, channel.target_node}].emplace_back(a, c);
            int& first = first_animation_[size_t(channel.target_node)];
            if (first == kNone) first = a;
        }
    }
    // Parents come before their children.
    for (const int node : nodes.shown) {
        const int parent = nodes.parent[size_t(node)];
        const int above = parent == kNone ? kNone : first_animation_[size_t(parent)];
        int& first = first_animation_[size_t(node)];
        if (above != kNone && (first == kNone || above < first)) first = above;
    }
}

std::optional<shading::CameraAnimation> GltfCameraAnimations::of(int node) const {
    const int animation = first_animation_[size_t(node)];
    if (animation == kNone) return std::nullopt;
    shading::CameraAnimation result;
    const std::string& name = document_.model.animations[size_t(animation)].name;
    result.name = name.empty() ? std::to_string(animation) : one_line(name);
    for (int at = node; at != kNone; at = nodes_.parent[size_t(at)]) {
        document_.memory->spend(sizeof(shading::MovingTransform));
        result.nodes.push_back(read_node(animation, at));
    }
    std::ranges::reverse(result.nodes);
    result.first_time = std::numeric_limits<double>::infinity();
    for (const shading::MovingTransform& moving : result.nodes)
        for (const shading::KeyTrack* track : {&moving.translations, &moving.rotations, &moving.scales}) widen_times(*track, result);
    return result;
}

shading::MovingTransform GltfCameraAnimations::read_node(int animation, int index) const {
    const tinygltf::Node& node = document_.model.nodes[size_t(index)];
    shading::MovingTransform result;
    result.matrix = nodes_.local[size_t(index)];
    if (!node.translation.empty()) result.translation = glm::make_vec3(node.translation.data());
    if (!node.scale.empty()) result.scale = glm::make_vec3(node.scale.data());
    if (!node.rotation.empty())
        result.rotation = glm::normalize(glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]));  // w first
    const auto channels = channels_.find({animation, index});
    if (channels == channels_.end()) return result;
    if (!node.matrix.empty())
        document_.fail(name_of(animation) + " moves nodes[" + std::to_string(index) +
                       "] (which has a matrix; allowed: translation, rotation and scale)");
    for (const ChannelPlace& place : channels->second) {
        const std::string& path = document_.model.animations[size_t(animation)].channels[size_t(place.second)].target_path;
        shading::KeyTrack& track = path == "translation" ? result.translations : path == "rotation" ? result.rotations : result.scales;
        if (track.moves()) document_.fail(name_of(animation) + " has two channels for nodes[" + std::to_string(index) + "]." + path);
        track = read_track(place, path == "rotation" ? 4 : 3);
    }
    return result;
}

shading::KeyTrack GltfCameraAnimations::read_track(const ChannelPlace& place, int components) const {
    const auto& [animation, channel] = place;
    const tinygltf::Animation& source = document_.model.animations[size_t(animation)];
    const int index = source.channels[size_t(channel)].sampler;
    if (index < 0 || size_t(index) >= source.samplers.size())
        document_.fail(name_of(animation, "channels", channel) + ".sampler is " + std::to_string(index) + " (allowed: below " +
                       std::to_string(source.samplers.size()) + ")");
    const tinygltf::AnimationSampler& sampler = source.samplers[size_t(index)];
    const std::string what = name_of(animation, "samplers", index);
    shading::KeyTrack track;
    track.interpolation = interpolation_of(sampler.interpolation, what);
    track.times = read_times(sampler.input, what + ".input");
    const bool spline = track.interpolation == shading::KeyInterpolation::CubicSpline;
    track.values = read_values(sampler.output, track.times.size() * (spline ? 3 : 1), components, what + ".output");
    if (components == 4)
        for (size_t i = spline ? 1 : 0; i < track.values.size(); i += spline ? 3 : 1)
            if (!(glm::length(track.values[i]) > 0.0))
                document_.fail(what + ".output is zero at element " + std::to_string(i) + " (a unit quaternion was expected)");
    return track;
}

shading::KeyInterpolation GltfCameraAnimations::interpolation_of(const std::string& name, const std::string& what) const {
    using shading::KeyInterpolation;
    if (name.empty() || name == "LINEAR") return KeyInterpolation::Linear;
    if (name == "STEP") return KeyInterpolation::Step;
    if (name == "CUBICSPLINE") return KeyInterpolation::CubicSpline;
    document_.fail(what + ".interpolation is \"" + shortened(name) + "\" (allowed: LINEAR, STEP, CUBICSPLINE)");
}

std::vector<float> GltfCameraAnimations::read_times(int accessor, const std::string& what) const {
    std::vector<float> times = read_all(accessor, 1, what);
    if (times.front() < 0.0f) document_.fail(what + " begins at " + print_short(times.front()) + " seconds (allowed: from 0)");
    const auto disorder = std::ranges::adjacent_find(times, std::greater_equal<>());
    if (disorder != times.end())
        document_.fail(what + " holds " + print_short(disorder[1]) + " after " + print_short(disorder[0]) + " (times must increase)");
    return times;
}

std::vector<glm::dvec4> GltfCameraAnimations::read_values(int accessor, size_t count, int components, const std::string& what) const {
    const uint64_t found = accessors_.at(accessor).count;
    if (found != count)
        document_.fail(what + " has " + std::to_string(found) + " elements (allowed: " + std::to_string(count) + ", as the times ask for)");
    const std::vector<float> numbers = read_all(accessor, components, what);
    document_.memory->spend(count * sizeof(glm::dvec4));
    std::vector<glm::dvec4> values(count, glm::dvec4(0.0));
    for (size_t i = 0; i < count; ++i)
        for (int c = 0; c < components; ++c) values[i][c] = double(numbers[i * size_t(components) + size_t(c)]);
    return values;
}

std::vector<float> GltfCameraAnimations::read_all(int index, int components, const std::string& what) const {
    const Accessor& accessor = accessors_.at(index);
    document_.memory->spend(accessor.count * sizeof(uint32_t));
    std::vector<uint32_t> elements(accessor.count);
    std::iota(elements.begin(), elements.end(), 0u);
    const Integers integers = components == 4 ? Integers::Normalized : Integers::No;
    return accessors_.read_floats(accessor, elements, {what, {components}, integers});
}

}  // namespace rawtexel::scenes
