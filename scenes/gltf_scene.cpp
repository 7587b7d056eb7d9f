// From a checked glTF document to the scene that is drawn.
#include "scenes/load.h"

#include "scenes/accessor.h"
#include "scenes/gltf_cameras.h"
#include "scenes/gltf_deform.h"
#include "scenes/gltf_document.h"
#include "scenes/gltf_lights.h"
#include "scenes/gltf_materials.h"
#include "scenes/gltf_nodes.h"
#include "scenes/gltf_notices.h"
#include "scenes/gltf_primitive.h"
#include "scenes/gltf_textures.h"
#include "scenes/message_text.h"
#include "scenes/tangents.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <tuple>

namespace rawtexel::scenes {
namespace {

class SceneBuilder {
  public:
    SceneBuilder(const GltfDocument& document, const LoadOptions& options)
        : document_(document),
          notices_(document.path, options),
          accessors_(document),
          textures_(document, options, notices_),
          nodes_(flatten_nodes(document)),
          camera_animations_(document, accessors_, nodes_) {
        check_lights(document);
    }

    shading::Scene build() {
        read_names();
        scene_.materials = read_materials(document_, textures_, notices_);
        for (const int node : nodes_.shown) add_node(node);
        scene_.textures = textures_.take();
        if (scene_.instances.empty()) notices_.say_once("there is nothing to draw");
        return std::move(scene_);
    }

  private:
    void read_names() {
        scene_.name = std::filesystem::path(document_.path).stem().string();
        const tinygltf::Model& model = document_.model;
        if (model.scenes.empty()) return;
        const tinygltf::Scene& source = model.scenes[size_t(std::max(model.defaultScene, 0))];
        if (!source.extras.Has("rawtexel") || !source.extras.Get("rawtexel").Has("environment")) return;
        const std::string environment = source.extras.Get("rawtexel").Get("environment").Get<std::string>();
        if (environment != "sky" && environment != "none")
            document_.fail("extras.rawtexel.environment is \"" + one_line(environment) + "\" (allowed: sky, none)");
        scene_.environment = environment == "sky" ? shading::EnvironmentRequest::Sky : shading::EnvironmentRequest::None;
    }

    void add_node(int index) {
        const tinygltf::Node& node = document_.model.nodes[size_t(index)];
        const glm::dmat4& world = nodes_.world[size_t(index)];
        if (node.mesh >= 0) add_mesh(index, node);
        if (node.camera >= 0) add_camera(index, node);
        if (const auto light = node.extensions.find("KHR_lights_punctual"); light != node.extensions.end())
            scene_.lights.push_back(read_light(document_, light->second.Get("light").GetNumberAsInt(), world));
    }

    void add_camera(int index, const tinygltf::Node& node) {
        if (auto animation = camera_animations_.of(index)) scene_.camera_animations.emplace(scene_.cameras.size(), std::move(*animation));
        scene_.cameras.push_back(read_camera(document_, node.camera, nodes_.world[size_t(index)]));
    }

    void add_mesh(int index, const tinygltf::Node& node) {
        const tinygltf::Mesh& mesh = document_.model.meshes[size_t(node.mesh)];
        const std::vector<float> weights = morph_weights(node, mesh);
        const bool skinned = node.skin >= 0;
        if (skinned) notices_.say_once("skinned meshes are drawn as their joints stand in the file");
        const SkinPose pose = skinned ? skin_pose(document_, accessors_, node.skin, nodes_.world) : SkinPose{};
        for (size_t p = 0; p < mesh.primitives.size(); ++p) {
            const auto drawn = drawn_mesh({node.mesh, int(p), skinned ? index : -1, weights}, skinned ? &pose : nullptr);
            if (!drawn) continue;
            // Skinning has moved the vertices into the world already.
            const glm::mat4 world = skinned ? glm::mat4(1.0f) : glm::mat4(nodes_.world[size_t(index)]);
            scene_.instances.push_back({*drawn, world});
        }
    }

    /// The node's weights before the mesh's; empty where no primitive has targets.
    std::vector<float> morph_weights(const tinygltf::Node& node, const tinygltf::Mesh& mesh) {
        const bool morphed = std::ranges::any_of(mesh.primitives, [](const tinygltf::Primitive& p) { return !p.targets.empty(); });
        if (!morphed) return {};
        notices_.say_once("morph targets are drawn at their default weights");
        const std::vector<double>& weights = node.weights.empty() ? mesh.weights : node.weights;
        return {weights.begin(), weights.end()};
    }

    /// Which mesh of the scene a primitive becomes: nodes that draw it alike share it. (mesh, primitive, node if skinned, weights)
    using MeshKey = std::tuple<int, int, int, std::vector<float>>;

    std::optional<uint32_t> drawn_mesh(const MeshKey& key, const SkinPose* pose) {
        const auto [entry, is_new] = meshes_.try_emplace(key, std::nullopt);
        if (!is_new) return entry->second;
        const auto& [mesh, primitive, node, weights] = key;
        const int material = document_.model.meshes[size_t(mesh)].primitives[size_t(primitive)].material;
        const uint32_t drawn_material = material >= 0 ? uint32_t(material) : default_material();
        const PrimitiveRequest request{mesh, primitive, weights, pose, map_with_tangents(scene_.materials, drawn_material)};
        auto read = read_primitive(document_, accessors_, request, notices_);
        if (!read) return std::nullopt;
        tell_of_missing_coordinates(*read, drawn_material);
        read->material = drawn_material;
        entry->second = uint32_t(scene_.meshes.size());
        scene_.meshes.push_back(std::move(*read));
        return entry->second;
    }

    void tell_of_missing_coordinates(const shading::Mesh& mesh, uint32_t index) {
        const shading::Material& material = scene_.materials[index];
        if (material.layers) {
            tell_of_missing_coordinates(mesh, material.layers->mask);
            for (const uint32_t layer : material.layers->materials) tell_of_missing_coordinates(mesh, layer);
        } else if (!material.triplanar) {
            for (const shading::TextureMap& map : material.maps) tell_of_missing_coordinates(mesh, map);
        }
    }
    void tell_of_missing_coordinates(const shading::Mesh& mesh, const shading::TextureMap& map) {
        if (map.texture >= 0 && mesh.uv[size_t(map.uv_set)].empty())
            notices_.say_once("meshes without TEXCOORD_" + std::to_string(map.uv_set) +
                              " show one point of the textures that their materials put on it");
    }

    /// What primitives without a material are drawn with (glTF 2.0, 3.9.6), made when one is met.
    uint32_t default_material() {
        if (!default_material_) {
            default_material_ = uint32_t(scene_.materials.size());
            scene_.materials.emplace_back().name = "default";
        }
        return *default_material_;
    }

    const GltfDocument& document_;
    GltfNotices notices_;
    Accessors accessors_;
    GltfTextures textures_;
    GltfNodes nodes_;
    GltfCameraAnimations camera_animations_;
    shading::Scene scene_;
    std::map<MeshKey, std::optional<uint32_t>> meshes_;
    std::optional<uint32_t> default_material_;
};

/// The largest of each axis, without signs.
glm::dvec3 extent_of(const shading::Mesh& mesh) {
    glm::dvec3 extent(0.0);
    for (const glm::vec3& position : mesh.positions) extent = glm::max(extent, glm::dvec3(glm::abs(position)));
    return extent;
}

/// A bound on every coordinate of what is drawn, computed where single precision would overflow.
double scene_reach(const shading::Scene& scene) {
    std::vector<glm::dvec3> extents;
    for (const shading::Mesh& mesh : scene.meshes) extents.push_back(extent_of(mesh));
    double reach = 0.0;
    for (const shading::Instance& instance : scene.instances) {
        const glm::dmat4 world(instance.world_from_object);
        glm::dvec3 coordinates = glm::abs(glm::dvec3(world[3]));
        for (int i = 0; i < 3; ++i) coordinates += glm::abs(glm::dvec3(world[i])) * extents[instance.mesh][i];
        for (int axis = 0; axis < 3; ++axis) reach = std::max(reach, coordinates[axis]);
    }
    return reach;
}

}  // namespace

shading::Scene load_gltf(const std::string& path, const LoadOptions& options) try {
    const GltfDocument document = read_gltf_document(path, options);
    shading::Scene scene = SceneBuilder(document, options).build();
    const double reach = scene_reach(scene);
    if (!(reach < kMaxReach)) document.fail("the scene reaches " + print_short(reach) + " metres (allowed: below 1e15)");
    return scene;
} catch (const texunit::TextureError& error) {
    throw InputError(one_line(error.what()));
}

}  // namespace rawtexel::scenes
