#include "scenes/export_materials.h"

#include "scenes/gltf_policy.h"
#include "scenes/image_io.h"

#include <algorithm>
#include <cmath>

namespace rawtexel::scenes {
namespace {

using nlohmann::json;

template <class Vector>
json numbers(const Vector& v) {
    json array = json::array();
    for (int c = 0; c < int(Vector::length()); ++c) array.push_back(double(v[c]));
    return array;
}

const glm::mat3x2 kIdentity{1, 0, 0, 1, 0, 0};

/// KHR_texture_transform: translation * rotation * scale. Without rotation every number is exact.
json texture_transform(const glm::mat3x2& m, const std::string& what) {
    json transform = {{"offset", numbers(m[2])}};
    if (m[0].y == 0.0f && m[1].x == 0.0f) {
        transform["scale"] = json::array({double(m[0].x), double(m[1].y)});
        return transform;
    }
    // Columns (c sx, -s sx) and (s sy, c sy).
    const glm::dvec2 u(m[0]), v(m[1]);
    const double rotation = std::atan2(-u.y, u.x), c = std::cos(rotation), s = std::sin(rotation);
    const double skew = std::abs(glm::dot(u, v)), size = glm::length(u) * glm::length(v);
    if (!(skew <= 1e-6 * size)) throw OutputError(what + " has a skewed texture transform (glTF knows offset, rotation and scale)");
    transform["rotation"] = rotation;
    transform["scale"] = json::array({glm::length(u), s * v.x + c * v.y});
    return transform;
}

/// Writes the maps of one material.
class MaterialExport {
  public:
    MaterialExport(const shading::Material& material, const std::string& path, ExportTextures& textures, ExportExtensions& extensions)
        : material_(material), what_(path + ": material \"" + material.name + "\""), textures_(textures), extensions_(extensions) {}

    json run() {
        json pbr = {{"baseColorFactor", numbers(material_.base_color)},
                    {"metallicFactor", double(material_.metallic)},
                    {"roughnessFactor", double(material_.roughness)}};
        json exported = {{"name", material_.name}};
        add_map(pbr, "baseColorTexture", shading::kBaseColor, true);
        add_map(pbr, "metallicRoughnessTexture", shading::kMetallicRoughness, false);
        exported["pbrMetallicRoughness"] = std::move(pbr);
        if (json* map = add_map(exported, "normalTexture", shading::kNormal, false)) (*map)["scale"] = double(material_.normal_scale);
        if (json* map = add_map(exported, "occlusionTexture", shading::kOcclusion, false))
            (*map)["strength"] = double(material_.occlusion_strength);
        add_map(exported, "emissiveTexture", shading::kEmissive, true);
        add_emission(exported);
        add_modes(exported);
        add_branches(exported);
        add_policy(exported);
        return exported;
    }

  private:
    json* add_map(json& object, const char* name, shading::MapSlot slot, bool color) {
        const shading::TextureMap& map = material_.maps[slot];
        return map.texture < 0 ? nullptr : &(object[name] = texture_info(map, color));
    }

    json texture_info(const shading::TextureMap& map, bool color) {
        json info = {{"index", textures_.texture(map.texture, map.sampler, color)}};
        if (map.uv_set != 0) info["texCoord"] = map.uv_set;
        if (map.uv_from_vertex != kIdentity) {
            info["extensions"]["KHR_texture_transform"] = texture_transform(map.uv_from_vertex, what_);
            require("KHR_texture_transform");
        }
        return info;
    }

    void add_policy(json& exported) {
        if (material_.policy != shading::LookupPolicy()) exported["extras"]["rawtexel"]["policy"] = policy_json(material_.policy);
    }

    void add_branches(json& exported) {
        if (const auto& triplanar = material_.triplanar)
            exported["extras"]["rawtexel"]["triplanar"] = {{"scale", double(triplanar->scale)}, {"sharpness", triplanar->sharpness}};
        if (!material_.layers) return;
        json& layers = exported["extras"]["rawtexel"]["layers"];
        layers["materials"] = material_.layers->materials;
        if (material_.layers->mask.texture >= 0) layers["mask"] = texture_info(material_.layers->mask, false);
    }

    /// A factor of at most 1 and a strength that is a power of two, so that their product is exact.
    void add_emission(json& exported) {
        const glm::vec3& emission = material_.emission;
        const float largest = std::max({emission.x, emission.y, emission.z});
        const float strength = largest > 1.0f ? std::exp2(std::ceil(std::log2(largest))) : 1.0f;
        if (emission != glm::vec3(0.0f)) exported["emissiveFactor"] = numbers(emission / strength);
        if (strength != 1.0f) {
            exported["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = double(strength);
            extensions_.used.insert("KHR_materials_emissive_strength");
        }
    }

    void add_modes(json& exported) {
        if (material_.alpha_mode == shading::AlphaMode::Mask) {
            exported["alphaMode"] = "MASK";
            exported["alphaCutoff"] = double(material_.alpha_cutoff);
        } else if (material_.alpha_mode == shading::AlphaMode::Blend) {
            exported["alphaMode"] = "BLEND";
        }
        if (material_.double_sided) exported["doubleSided"] = true;
        if (material_.unlit) {
            exported["extensions"]["KHR_materials_unlit"] = json::object();
            extensions_.used.insert("KHR_materials_unlit");
        }
    }

    void require(const std::string& extension) {
        extensions_.used.insert(extension);
        extensions_.required.insert(extension);
    }

    const shading::Material& material_;
    std::string what_;
    ExportTextures& textures_;
    ExportExtensions& extensions_;
};

}  // namespace

json export_material(const shading::Material& material, const std::string& path, ExportTextures& textures, ExportExtensions& extensions) {
    return MaterialExport(material, path, textures, extensions).run();
}

}  // namespace rawtexel::scenes
