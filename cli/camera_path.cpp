#include "cli/camera_path.h"

#include "cli/json_text.h"
#include "cli/limits.h"
#include "cli/option_values.h"
#include "scenes/image_io.h"
#include "scenes/load.h"
#include "scenes/message_text.h"

#include <nlohmann/json.hpp>

#include <glm/gtc/type_ptr.hpp>

#include <cmath>
#include <span>

namespace rawtexel::cli {
namespace {

using Json = nlohmann::json;
using scenes::InputError;

/// One element of the file's array.
struct KeyReader {
    const std::string& path;
    const Json& key;
    size_t number;

    [[noreturn]] void fail(const std::string& what) const { throw InputError(path + ": key " + std::to_string(number) + " " + what); }

    double number_of(const Json& value, const std::string& name, const NumberRange& range) const {
        const double found = value.is_number() ? value.get<double>() : std::nan("");
        if (!(found >= double(range.lowest) && found <= double(range.highest)))
            fail("has a \"" + name + "\" that is no number from " + print(range));
        return found;
    }

    std::vector<double> numbers(const std::string& name, size_t count) const {
        const Json& list = key.at(name);
        if (!list.is_array() || list.size() != count)
            fail("has a \"" + name + "\" that is no array of " + std::to_string(count) + " numbers");
        std::vector<double> values;
        for (const Json& value : list) values.push_back(number_of(value, name, {-kMaxLength, kMaxLength}));
        return values;
    }

    glm::dvec3 point(const std::string& name) const { return glm::make_vec3(numbers(name, 3).data()); }
};

/// Rotation and position, no more.
glm::dmat4 rigid_matrix(const KeyReader& reader) {
    constexpr double kTolerance = 1e-3;
    const std::vector<double> values = reader.numbers("matrix", 16);
    const glm::dmat4 matrix = glm::make_mat4(values.data());
    const glm::dmat3 axes(matrix), product = glm::transpose(axes) * axes;
    double worst = std::abs(glm::determinant(axes) - 1.0);
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) worst = std::max(worst, std::abs(product[column][row] - (row == column ? 1.0 : 0.0)));
    const bool affine = matrix[0].w == 0.0 && matrix[1].w == 0.0 && matrix[2].w == 0.0 && matrix[3].w == 1.0;
    if (!affine || !(worst <= kTolerance)) reader.fail("has a \"matrix\" that is no rotation and translation, column by column");
    return matrix;
}

shading::CameraKey read_key(const KeyReader& reader, float fov) {
    const Json& key = reader.key;
    if (!key.is_object()) reader.fail("is no object");
    for (const auto& [name, value] : key.items())
        if (name != "eye" && name != "target" && name != "matrix" && name != "fov")
            reader.fail("has an unknown \"" + scenes::shortened(name) + "\" (allowed: eye, target, matrix, fov)");
    shading::CameraKey result;
    result.vertical_fov = glm::radians(key.contains("fov") ? reader.number_of(key["fov"], "fov", {kMinFov, kMaxFov}) : double(fov));
    if (key.contains("matrix")) {
        if (key.contains("eye") || key.contains("target")) reader.fail("has both a \"matrix\" and an \"eye\" or \"target\"");
        result.world_from_camera = rigid_matrix(reader);
        return result;
    }
    if (!key.contains("eye") || !key.contains("target")) reader.fail("has no \"eye\" and \"target\", and no \"matrix\"");
    result.eye = reader.point("eye");
    result.target = reader.point("target");
    if (glm::vec3(*result.eye) == glm::vec3(*result.target)) reader.fail("has its \"eye\" and \"target\" in one point");
    return result;
}

/// Brackets within brackets at most, counted in strings too: keys need three.
std::vector<shading::CameraKey> read_camera_keys(const std::string& path, float fov) {
    const std::vector<std::byte> bytes = scenes::read_file(path);
    return parse_camera_keys(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, fov);
}

void refuse_beside(const char* path, bool given, const char* option) {
    if (given)
        throw UsageError(std::string("--camera-path ") + path + " says itself where the camera is: " + option +
                         " makes no sense beside it");
}

void refuse_places(const char* path, const ViewOptions& options) {
    refuse_beside(path, options.orbit.has_value(), "--orbit");
    refuse_beside(path, options.eye.has_value(), "--eye");
    refuse_beside(path, options.target.has_value(), "--target");
}

shading::CameraPath gltf_path(const shading::Scene& scene, const ViewOptions& options, const View& view) {
    refuse_places("gltf", options);
    if (!view.scene_camera) throw UsageError("--camera-path gltf: the scene has no camera");
    const auto animation = scene.camera_animations.find(*view.scene_camera);
    if (animation == scene.camera_animations.end())
        throw UsageError("--camera-path gltf: no animation of the scene moves its camera '" + scene.cameras[*view.scene_camera].name + "'");
    return shading::animated_path(view.camera, animation->second);
}

}  // namespace

std::vector<shading::CameraKey> parse_camera_keys(const std::string& path, std::string_view text, float fov) {
    const Json json = parse_json(path, text);
    if (!json.is_array() || json.empty()) throw InputError(path + ": is no array of key frames (at least one is needed)");
    std::vector<shading::CameraKey> keys;
    for (size_t i = 0; i < json.size(); ++i) keys.push_back(read_key({path, json[i], i}, fov));
    return keys;
}

shading::CameraPath make_camera_path(const SequenceOptions& sequence, const shading::Scene& scene, const ViewOptions& options,
                                     const View& view) {
    if (!sequence.path) return shading::still_path(view.camera);
    const shading::PathStart start{view.camera, view.target, view.scene_camera ? std::nullopt : std::optional(scene.bounds())};
    switch (sequence.path->kind) {
        case CameraPathKind::Orbit: return shading::orbit_path(start);
        case CameraPathKind::Dolly: return shading::dolly_path(start);
        case CameraPathKind::Gltf: return gltf_path(scene, options, view);
        case CameraPathKind::File: break;
    }
    refuse_places("FILE", options);
    const float fov = glm::degrees(view.camera.vertical_fov);
    return shading::keyed_path(read_camera_keys(sequence.path->file, fov), scene.bounds());
}

void check_camera_path(const shading::CameraPath& path, int frames, const std::string& what) {
    for (int frame = 0; frame < frames; ++frame) {
        const glm::mat4 pose = path.frame(frame, frames).world_from_camera;
        bool usable = true;
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 3; ++row) usable &= std::abs(pose[column][row]) <= kMaxLength;
        if (!usable)
            throw InputError(what + ": frame " + std::to_string(frame) + " has no place for the camera (allowed: within 1e15 metres)");
    }
}

}  // namespace rawtexel::cli
