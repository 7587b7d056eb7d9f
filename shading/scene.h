// The scene as data: meshes, materials, textures, lights, cameras. Loading it is another room's work.
#pragma once

#include "raster/mesh_clusters.h"
#include "shading/camera_animation.h"
#include "shading/lookup_policy.h"
#include "texunit/containers.h"
#include "texunit/sampler.h"
#include "texunit/texture.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rawtexel::shading {

/// One indexed triangle list with one material. Attribute arrays are empty or as long as `positions`.
/// Right-handed, +Y up, counter-clockwise front faces (glTF 3.7.2). Every index is below positions.size().
struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;            ///< unit; empty: flat, from the triangle
    std::vector<glm::vec4> tangents;           ///< xyz unit, w = sign of the bitangent; empty where no normal map needs them
    std::array<std::vector<glm::vec2>, 2> uv;  ///< texture coordinate sets 0 and 1
    std::vector<glm::vec4> colors;             ///< linear, multiplied with the base colour
    std::vector<uint32_t> indices;             ///< 3 per triangle
    uint32_t material = 0;
    /// Of these positions and indices (cluster_meshes); null: made anew for every frame.
    std::shared_ptr<const raster::MeshClusters> clusters = nullptr;
};

struct Instance {
    uint32_t mesh = 0;
    glm::mat4 world_from_object{1.0f};  ///< may mirror
};

/// One texture lookup of a material.
struct TextureMap {
    int texture = -1;  ///< index into Scene::textures; -1: the factor alone
    texunit::SamplerState sampler;
    int uv_set = 0;
    /// KHR_texture_transform: (u', v') = uv_from_vertex * (u, v, 1).
    glm::mat3x2 uv_from_vertex{1, 0, 0, 1, 0, 0};
};

/// The maps of a material, in the order in which they are looked up.
enum MapSlot { kBaseColor, kMetallicRoughness, kNormal, kOcclusion, kEmissive, kMapSlots };
/// The mask of layers, which is no map of a material's own.
inline constexpr MapSlot kLayerMask = kMapSlots;

/// Maps projected along the axes of the object's space, not mapped by texture coordinates. At each point the three planes weigh
/// |normal component|^sharpness, normalised.
struct Triplanar {
    float scale = 1.0f;  ///< repeats of the maps per metre of the object's space, > 0
    int sharpness = 4;   ///< 1..kMostSharpness
};
inline constexpr int kMostSharpness = 64;

/// Other materials, blended by weights that are normalised: channel k weighs layer k. Where all are 0 or less the first layer is seen.
struct LayerBlend {
    std::vector<uint32_t> materials;  ///< kFewestLayers..kMostLayers, in Scene::materials; none of them blends layers itself
    TextureMap mask;                  ///< without texture: the vertex colours weigh, and colour nothing
};
inline constexpr size_t kFewestLayers = 2, kMostLayers = 4;

enum class AlphaMode : uint8_t { Opaque, Mask, Blend };

/// glTF 2.0 metallic-roughness material (3.9).
struct Material {
    std::string name;
    glm::vec4 base_color{1.0f};  ///< linear
    float metallic = 1.0f, roughness = 1.0f;
    float normal_scale = 1.0f, occlusion_strength = 1.0f;
    glm::vec3 emission{0.0f};  ///< factor times KHR_materials_emissive_strength
    AlphaMode alpha_mode = AlphaMode::Opaque;
    float alpha_cutoff = 0.5f;
    bool double_sided = false;
    bool unlit = false;  ///< KHR_materials_unlit: base colour is the radiance
    std::array<TextureMap, kMapSlots> maps;
    LookupPolicy policy = {};  ///< of all its maps
    // Both ask for AlphaMode::Opaque, of layers too.
    std::optional<Triplanar> triplanar;
    std::optional<LayerBlend> layers;  ///< in place of all that is said above but double_sided; the layers are lit, all or none of them
};

/// KHR_lights_punctual. Directional: `intensity` in lux; point and spot: candela.
struct Light {
    enum class Type : uint8_t { Directional, Point, Spot };
    std::string name;
    Type type = Type::Directional;
    glm::vec3 color{1.0f};
    float intensity = 1.0f;
    glm::vec3 position{0.0f};                            ///< world
    glm::vec3 direction{0.0f, 0.0f, -1.0f};              ///< unit, the way the light travels
    float range = 0.0f;                                  ///< metres; 0: unlimited
    float inner_cone = 0.0f, outer_cone = 0.785398163f;  ///< radians from the axis
};

struct Camera {
    enum class Type : uint8_t { Perspective, Orthographic };
    std::string name;
    Type type = Type::Perspective;
    glm::mat4 world_from_camera{1.0f};  ///< looks along its -Z, +Y up; rigid
    float vertical_fov = 0.785398163f;  ///< radians
    float xmag = 1.0f, ymag = 1.0f;     ///< half extents, orthographic
    float znear = 0.01f, zfar = 0.0f;   ///< zfar 0: unlimited (perspective only)
};

/// A texture and, where it came from a file, where the file's own bytes are for lossless export.
struct SceneTexture {
    std::shared_ptr<texunit::Texture> texture;
    std::string image_name;
    std::string mime_type;  ///< "image/png", "image/jpeg", "image/ktx2", "image/vnd-ms.dds", …
    bool srgb = false;      ///< read as sRGB-encoded colour
    /// The encoded image; null when the texture was generated and must be encoded anew.
    std::shared_ptr<const texunit::ByteSource> encoded;
    LookupPolicy policy = {};  ///< of all lookups of it, over that of their materials
};

/// What a scene asks of its surroundings when the command line says nothing.
enum class EnvironmentRequest : uint8_t { Unspecified, None, Sky };

struct Bounds {
    glm::vec3 lower{0.0f}, upper{0.0f};
    glm::vec3 center() const { return 0.5f * (lower + upper); }
    float radius() const { return 0.5f * glm::length(upper - lower); }  ///< of the sphere around the box
};

struct Scene {
    std::string name;
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;  ///< in scene order
    std::vector<Material> materials;  ///< at least the one that every mesh names
    std::vector<SceneTexture> textures;
    std::vector<Light> lights;
    std::vector<Camera> cameras;
    /// Of the cameras that move, by their index; only where the loader was asked for them.
    std::map<size_t, CameraAnimation> camera_animations;
    EnvironmentRequest environment = EnvironmentRequest::Unspecified;

    uint64_t triangle_count() const;  ///< over all instances
    Bounds bounds() const;            ///< of all instances in the world; zero when there is no geometry
};

}  // namespace rawtexel::shading
