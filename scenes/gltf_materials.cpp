#include "scenes/gltf_materials.h"

#include "scenes/gltf_policy.h"
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
        material.policy = read_policy(document_, "materials[" + std::to_string(index) + "]", source.extras);
        if (source.extras.Has("rawtexel")) set_branches(source.extras.Get("rawtexel"), material);
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

    void set_branches(const Value& own, shading::Material& material) {
        if (own.Has("triplanar")) {
            const Value& from = own.Get("triplanar");
            shading::Triplanar& triplanar = material.triplanar.emplace();
            triplanar.scale = float(number(from, "scale", triplanar.scale));
            triplanar.sharpness = int(number(from, "sharpness", triplanar.sharpness));
        }
        if (!own.Has("layers")) return;
        const Value& from = own.Get("layers");
        shading::LayerBlend& layers = material.layers.emplace();
        const Value& materials = from.Get("materials");
        for (size_t i = 0; i < materials.ArrayLen(); ++i) layers.materials.push_back(uint32_t(materials.Get(int(i)).GetNumberAsInt()));
        if (from.Has("mask")) layers.mask = map(texture_info(from.Get("mask")), false);
    }

    static tinygltf::TextureInfo texture_info(const Value& value) {
        tinygltf::TextureInfo info;
        info.index = value.Get("index").GetNumberAsInt();
        info.texCoord = int(number(value, "texCoord", 0));
        if (value.Has("extensions")) info.extensions = value.Get("extensions").Get<Value::Object>();
        return info;
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

/// What the schema cannot say of materials that blend.
class BranchCheck {
  public:
    BranchCheck(const GltfDocument& document, const std::vector<shading::Material>& materials)
        : document_(document), materials_(materials) {}

    void run(size_t index) const {
        const shading::Material& material = materials_[index];
        if (!material.triplanar && !material.layers) return;
        const std::string place = "materials[" + std::to_string(index) + "].";
        if (material.alpha_mode != shading::AlphaMode::Opaque)
            document_.fail(place + "alphaMode is not OPAQUE (which extras.rawtexel's triplanar and layers ask for)");
        if (material.triplanar && material.layers)
            document_.fail(place + "extras.rawtexel has triplanar and layers (allowed: one of them)");
        if (material.layers) check_layers(*material.layers, place + "extras.rawtexel.layers.materials");
    }

  private:
    void check_layers(const shading::LayerBlend& layers, const std::string& place) const {
        const size_t count = layers.materials.size();
        if (count < shading::kFewestLayers || count > shading::kMostLayers)
            document_.fail(place + " is an array of " + std::to_string(count) + " (allowed: 2 to 4)");
        const bool unlit = materials_[layers.materials[0]].unlit;
        for (size_t k = 0; k < count; ++k) {
            const shading::Material& layer = materials_[layers.materials[k]];
            const std::string found = place + "[" + std::to_string(k) + "] is " + std::to_string(layers.materials[k]) + ", a material ";
            if (layer.layers) document_.fail(found + "with layers of its own (which is not allowed)");
            if (layer.alpha_mode != shading::AlphaMode::Opaque) document_.fail(found + "that is not OPAQUE (as layers are)");
            if (layer.unlit != unlit) document_.fail(found + "that is " + (layer.unlit ? "unlit" : "lit") + " (allowed: all are, or none)");
        }
    }

    const GltfDocument& document_;
    const std::vector<shading::Material>& materials_;
};

}  // namespace

std::vector<shading::Material> read_materials(const GltfDocument& document, GltfTextures& textures, GltfNotices& notices) {
    MaterialReader reader(document, textures, notices);
    std::vector<shading::Material> materials;
    for (const tinygltf::Material& source : document.model.materials) materials.push_back(reader.read(source, materials.size()));
    for (size_t i = 0; i < materials.size(); ++i) BranchCheck(document, materials).run(i);
    return materials;
}

}  // namespace rawtexel::scenes
