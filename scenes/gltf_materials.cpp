#include "scenes/gltf_materials.h"

#include "scenes/message_text.h"

#include <cmath>

namespace rawtexel::scenes {
namespace {

using tinygltf::Value;

const Value* find(const tinygltf::ExtensionMap& extensions, const char* name) {
    const auto found = extensions.find(name);
    return found == extensions.end() ? nullptr : &found->second;
}

double number(const Value& object, const char* name, double otherwise) {
    return object.Has(name) ? object.Get(name).GetNumberAsDouble() : otherwise;
}

glm::vec2 vector(const Value& object, const char* name, glm::vec2 otherwise) {
    if (!object.Has(name)) return otherwise;
    const Value& array = object.Get(name);
    return {float(array.Get(0).GetNumberAsDouble()), float(array.Get(1).GetNumberAsDouble())};
}

/// KHR_texture_transform: translation * rotation * scale, the rotation counter-clockwise as v runs down.
glm::mat3x2 texture_transform(const Value& transform) {
    const glm::vec2 offset = vector(transform, "offset", {0.0f, 0.0f}), scale = vector(transform, "scale", {1.0f, 1.0f});
    const double rotation = number(transform, "rotation", 0.0);
    const float c = float(std::cos(rotation)), s = float(std::sin(rotation));
    return {c * scale.x, -s * scale.x, s * scale.y, c * scale.y, offset.x, offset.y};
}

class MaterialReader {
  public:
    MaterialReader(const GltfDocument& document, GltfTextures& textures, GltfNotices& notices)
        : document_(document), textures_(textures), notices_(notices) {}

    shading::Material read(const tinygltf::Material& source, size_t index) {
        shading::Material material;
        material.name = source.name.empty() ? "material " + std::to_string(index) : one_line(source.name);
        const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
        for (int c = 0; c < 4; ++c) material.base_color[c] = float(pbr.baseColorFactor[size_t(c)]);
        material.metallic = float(pbr.metallicFactor);
        material.roughness = float(pbr.roughnessFactor);
        material.normal_scale = float(source.normalTexture.scale);
        material.occlusion_strength = float(source.occlusionTexture.strength);
        material.emission = emission(source);
        set_alpha(source, index, material);
        material.double_sided = source.doubleSided;
        material.unlit = find(source.extensions, "KHR_materials_unlit") != nullptr;
        material.maps[shading::kBaseColor] = map(pbr.baseColorTexture, true);
        material.maps[shading::kMetallicRoughness] = map(pbr.metallicRoughnessTexture, false);
        material.maps[shading::kNormal] = map(source.normalTexture, false);
        material.maps[shading::kOcclusion] = map(source.occlusionTexture, false);
        material.maps[shading::kEmissive] = map(source.emissiveTexture, true);
        return material;
    }

  private:
    static glm::vec3 emission(const tinygltf::Material& source) {
        const Value* extension = find(source.extensions, "KHR_materials_emissive_strength");
        const double strength = extension ? number(*extension, "emissiveStrength", 1.0) : 1.0;
        glm::vec3 emission(0.0f);
        for (int c = 0; c < 3; ++c) emission[c] = float(source.emissiveFactor[size_t(c)] * strength);
        return emission;
    }

    void set_alpha(const tinygltf::Material& source, size_t index, shading::Material& material) const {
        material.alpha_cutoff = float(source.alphaCutoff);
        if (source.alphaMode == "MASK")
            material.alpha_mode = shading::AlphaMode::Mask;
        else if (source.alphaMode == "BLEND")
            material.alpha_mode = shading::AlphaMode::Blend;
        else if (source.alphaMode != "OPAQUE")
            document_.fail("materials[" + std::to_string(index) + "].alphaMode is \"" + one_line(source.alphaMode) +
                           "\" (allowed: OPAQUE, MASK, BLEND)");
    }

    /// `Info` is any of tinygltf's texture references.
    template <class Info>
    shading::TextureMap map(const Info& info, bool srgb) {
        shading::TextureMap map;
        if (info.index < 0) return map;
        map.texture = textures_.texture(info.index, srgb);
        map.sampler = textures_.sampler(info.index);
        int uv_set = info.texCoord;
        if (const Value* transform = find(info.extensions, "KHR_texture_transform")) {
            map.uv_from_vertex = texture_transform(*transform);
            uv_set = int(number(*transform, "texCoord", uv_set));
        }
        if (uv_set > 1) {
            notices_.say_once("maps on texture coordinates beyond the second set use the first");
            uv_set = 0;
        }
        map.uv_set = uv_set;
        return map;
    }

    const GltfDocument& document_;
    GltfTextures& textures_;
    GltfNotices& notices_;
};

}  // namespace

std::vector<shading::Material> read_materials(const GltfDocument& document, GltfTextures& textures, GltfNotices& notices) {
    MaterialReader reader(document, textures, notices);
    std::vector<shading::Material> materials;
    for (const tinygltf::Material& source : document.model.materials) materials.push_back(reader.read(source, materials.size()));
    return materials;
}

}  // namespace rawtexel::scenes
