#include "scenes/export.h"

#include "scenes/export_buffer.h"
#include "scenes/export_materials.h"
#include "scenes/export_textures.h"
#include "scenes/image_io.h"
#include "scenes/output_file.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace rawtexel::scenes {
namespace {

using nlohmann::json;

json numbers(const glm::mat4& m) {
    json array = json::array();
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) array.push_back(double(m[column][row]));
    return array;
}

/// A rigid frame whose -Z is `direction` exactly.
glm::mat4 facing(const glm::vec3& direction, const glm::vec3& position) {
    const glm::vec3 z = -direction;
    const glm::vec3 helper = std::abs(z.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 x = glm::normalize(glm::cross(helper, z));
    return {glm::vec4(x, 0), glm::vec4(glm::cross(z, x), 0), glm::vec4(z, 0), glm::vec4(position, 1)};
}

json camera_json(const shading::Camera& camera) {
    json lens = {{"znear", double(camera.znear)}};
    if (camera.zfar > 0.0f) lens["zfar"] = double(camera.zfar);
    const bool perspective = camera.type == shading::Camera::Type::Perspective;
    if (perspective) {
        lens["yfov"] = double(camera.vertical_fov);
    } else {
        lens["xmag"] = double(camera.xmag);
        lens["ymag"] = double(camera.ymag);
    }
    const char* type = perspective ? "perspective" : "orthographic";
    return {{"name", camera.name}, {"type", type}, {type, std::move(lens)}};
}

json light_json(const shading::Light& light) {
    using Type = shading::Light::Type;
    const char* type = light.type == Type::Directional ? "directional" : light.type == Type::Point ? "point" : "spot";
    json exported = {{"name", light.name},
                     {"type", type},
                     {"color", {double(light.color.x), double(light.color.y), double(light.color.z)}},
                     {"intensity", double(light.intensity)}};
    if (light.range > 0.0f) exported["range"] = double(light.range);
    if (light.type == Type::Spot)
        exported["spot"] = {{"innerConeAngle", double(light.inner_cone)}, {"outerConeAngle", double(light.outer_cone)}};
    return exported;
}

class SceneExport {
  public:
    SceneExport(const shading::Scene& scene, const std::string& path) : scene_(scene), path_(path), textures_(scene, path, buffer_) {}

    /// The whole file: header, JSON chunk, binary chunk (glTF 2.0, 4.4).
    std::vector<std::byte> run() {
        add_materials();
        add_meshes();
        add_instances();
        add_cameras();
        add_lights();
        return file(document());
    }

  private:
    void add_materials() {
        for (const shading::Material& material : scene_.materials)
            materials_.push_back(export_material(material, path_, textures_, extensions_));
    }

    void add_meshes() {
        for (const shading::Mesh& mesh : scene_.meshes) {
            // glTF has no empty meshes.
            exported_mesh_.push_back(mesh.indices.empty() ? std::nullopt : std::optional(int(meshes_.size())));
            if (!mesh.indices.empty()) meshes_.push_back({{"name", mesh.name}, {"primitives", json::array({primitive(mesh)})}});
        }
    }

    json primitive(const shading::Mesh& mesh) {
        json attributes = {{"POSITION", buffer_.add_vectors(std::span<const glm::vec3>(mesh.positions), true)}};
        const auto add = [&](const char* name, const auto& values) {
            if (!values.empty()) attributes[name] = buffer_.add_vectors(std::span(std::as_const(values)));
        };
        add("NORMAL", mesh.normals);
        add("TANGENT", mesh.tangents);
        add("TEXCOORD_0", mesh.uv[0]);
        add("TEXCOORD_1", mesh.uv[1]);
        add("COLOR_0", mesh.colors);
        return {{"attributes", std::move(attributes)}, {"indices", buffer_.add_indices(mesh.indices)}, {"material", mesh.material}};
    }

    void add_instances() {
        for (const shading::Instance& instance : scene_.instances)
            if (const auto mesh = exported_mesh_[instance.mesh]) add_node({{"mesh", *mesh}}, instance.world_from_object);
    }

    void add_cameras() {
        for (const shading::Camera& camera : scene_.cameras) {
            add_node({{"name", camera.name}, {"camera", cameras_.size()}}, camera.world_from_camera);
            cameras_.push_back(camera_json(camera));
        }
    }

    void add_lights() {
        for (const shading::Light& light : scene_.lights) {
            json node = {{"name", light.name}};
            node["extensions"]["KHR_lights_punctual"]["light"] = lights_.size();
            add_node(std::move(node), facing(light.direction, light.position));
            lights_.push_back(light_json(light));
        }
    }

    void add_node(json node, const glm::mat4& world) {
        if (world != glm::mat4(1.0f)) node["matrix"] = numbers(world);
        nodes_.push_back(std::move(node));
    }

    json scene_json() const {
        json scene = {{"name", scene_.name}};
        for (size_t i = 0; i < nodes_.size(); ++i) scene["nodes"].push_back(i);
        using shading::EnvironmentRequest;
        if (scene_.environment != EnvironmentRequest::Unspecified)
            scene["extras"]["rawtexel"]["environment"] = scene_.environment == EnvironmentRequest::Sky ? "sky" : "none";
        return scene;
    }

    json document() {
        json document = {{"asset", {{"version", "2.0"}, {"generator", "rawtexel"}}}, {"scene", 0}, {"scenes", json::array({scene_json()})}};
        if (!lights_.empty()) {
            document["extensions"]["KHR_lights_punctual"]["lights"] = lights_;
            extensions_.used.insert("KHR_lights_punctual");
        }
        extensions_.used.insert(textures_.extensions().begin(), textures_.extensions().end());
        extensions_.required.insert(textures_.extensions().begin(), textures_.extensions().end());
        // glTF forbids empty arrays.
        const auto add = [&](const char* name, const json& array) {
            if (!array.empty()) document[name] = array;
        };
        add("extensionsUsed", extensions_.used);
        add("extensionsRequired", extensions_.required);
        add("nodes", nodes_);
        add("meshes", meshes_);
        add("materials", materials_);
        add("textures", textures_.textures());
        add("images", textures_.images());
        add("samplers", textures_.samplers());
        add("cameras", cameras_);
        add("accessors", buffer_.accessors());
        add("bufferViews", buffer_.views());
        if (!buffer_.bytes().empty()) document["buffers"] = json::array({{{"byteLength", buffer_.bytes().size()}}});
        return document;
    }

    std::vector<std::byte> file(const json& document) const {
        // Text that is not UTF-8 would make the file unreadable.
        const std::string text = document.dump(-1, ' ', false, json::error_handler_t::replace);
        const auto padded = [](size_t bytes) { return (bytes + 3) / 4 * 4; };
        const std::vector<std::byte>& binary = buffer_.bytes();
        const size_t binary_chunk = binary.empty() ? 0 : 8 + padded(binary.size());
        const size_t length = 12 + 8 + padded(text.size()) + binary_chunk;
        if (length > std::numeric_limits<uint32_t>::max())
            throw OutputError(path_ + ": the scene needs " + std::to_string(length) + " bytes (a .glb file holds less than 4 GiB)");

        std::vector<std::byte> bytes;
        bytes.reserve(length);
        const auto word = [&](size_t value) {
            for (int shift = 0; shift < 32; shift += 8) bytes.push_back(std::byte(value >> shift & 0xFF));
        };
        const auto chunk = [&](uint32_t type, std::span<const std::byte> data, std::byte fill) {
            word(padded(data.size()));
            word(type);
            bytes.insert(bytes.end(), data.begin(), data.end());
            bytes.resize(padded(bytes.size()), fill);
        };
        word(0x46546C67);  // "glTF"
        word(2);
        word(length);
        chunk(0x4E4F534A, std::as_bytes(std::span(text)), std::byte(' '));  // "JSON"
        if (!binary.empty()) chunk(0x004E4942, binary, std::byte(0));       // "BIN"
        return bytes;
    }

    const shading::Scene& scene_;
    const std::string& path_;
    ExportBuffer buffer_;
    ExportTextures textures_;
    ExportExtensions extensions_;
    json materials_ = json::array(), meshes_ = json::array(), nodes_ = json::array(), cameras_ = json::array(), lights_ = json::array();
    std::vector<std::optional<int>> exported_mesh_;
};

}  // namespace

void export_glb(const shading::Scene& scene, const std::string& path) { write_file(path, SceneExport(scene, path).run()); }

}  // namespace rawtexel::scenes
