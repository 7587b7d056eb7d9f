// A court in the south on a summer afternoon: arcades, cobbles, a fountain, plants; every kind of material that the renderer knows.
#include "scenes/builtin_courtyard.h"

#include "scenes/builtin_makers.h"
#include "scenes/procedural_masonry.h"
#include "scenes/procedural_matter.h"
#include "scenes/procedural_plants.h"

#include "texunit/memory_source.h"

#include <cmath>
#include <vector>

namespace rawtexel::scenes {
namespace {

/// Occlusion 0..1 from left to right: a vertex picks its value by its second texture coordinates.
std::unique_ptr<texunit::TexelSource> openness_ramp() {
    constexpr int kWidth = 256, kHeight = 4;
    std::vector<std::byte> texels;
    for (int i = 0; i < kWidth * kHeight; ++i) {
        const auto value = std::byte(i % kWidth);
        texels.insert(texels.end(), {value, value, value, std::byte{255}});
    }
    return texunit::make_memory_source(texunit::Format::RGBA8Unorm, kWidth, kHeight, std::move(texels));
}

}  // namespace

Courtyard::Courtyard(SceneAssembly& assembly) : assembly_(assembly), openness_ramp_(assembly.add_texture("openness", openness_ramp())) {
    materials_.cobbles = surface("cobbles", cobblestones());
    materials_.ashlar = surface("ashlar", ashlar());
    materials_.limestone = surface("limestone", limestone());
    materials_.plaster = surface("plaster", worn_plaster());
    materials_.roof = surface("roof clay", roof_clay());
    materials_.terracotta = surface("terracotta", terracotta());
    materials_.soil = surface("soil", garden_soil());
    materials_.oak = surface("oak", oak_planks());
    materials_.shutter = surface("painted shutters", painted_planks());
    materials_.iron = surface("wrought iron", wrought_iron());
    materials_.bronze = surface("bronze", aged_bronze());
    materials_.tiles = surface("glazed tiles", glazed_tiles());
    materials_.bark = surface("bark", bark());
    materials_.olive = foliage("olive leaves", olive_spray());
    materials_.ivy = foliage("ivy", ivy_spray());
    materials_.blossom = foliage("bougainvillea", blossom_spray());
    materials_.leaves = foliage("orange leaves", leaf_spray());

    materials_.water = surface("water", rippled_water());
    assembly_.material(materials_.water).alpha_mode = shading::AlphaMode::Blend;
    add_plain_materials();
}

uint32_t Courtyard::surface(const std::string& name, Surface surface) {
    const uint32_t index = assembly_.add_surface_material(name, std::move(surface));
    shading::TextureMap& occlusion = assembly_.material(index).maps[shading::kOcclusion];
    occlusion.texture = openness_ramp_;
    occlusion.uv_set = 1;
    occlusion.sampler = {texunit::Wrap::ClampToEdge, texunit::Wrap::ClampToEdge, texunit::Kernel::Bilinear, texunit::Kernel::Bilinear,
                         texunit::MipMode::None};
    return index;
}

uint32_t Courtyard::foliage(const std::string& name, Surface surface) {
    const uint32_t index = assembly_.add_color_material(name, std::move(surface), 0.65f);
    shading::Material& material = assembly_.material(index);
    material.alpha_mode = shading::AlphaMode::Mask;
    texunit::SamplerState& sampler = material.maps[shading::kBaseColor].sampler;
    sampler.wrap_s = sampler.wrap_t = texunit::Wrap::ClampToEdge;
    return index;
}

void Courtyard::add_plain_materials() {
    // Brick-red voussoirs from the maps of the roof's clay.
    shading::Material brick = assembly_.material(materials_.roof);
    brick.name = "red voussoirs";
    brick.base_color = glm::vec4(0.85f, 0.72f, 0.68f, 1.0f);
    materials_.brick = assembly_.add_material(brick);
    // Single tiles: one sees their undersides along the eaves.
    assembly_.material(materials_.roof).double_sided = true;

    const auto plain = [&](const char* name, glm::vec3 srgb, float roughness) {
        shading::Material material;
        material.name = name;
        material.base_color = glm::vec4(linear_color(srgb), 1.0f);
        material.metallic = 0.0f;
        material.roughness = roughness;
        return material;
    };
    shading::Material glass = plain("lantern glass", hex(0xE8D9A8), 0.08f);
    glass.base_color.a = 0.28f;
    glass.alpha_mode = shading::AlphaMode::Blend;
    glass.double_sided = true;
    materials_.glass = assembly_.add_material(glass);
    shading::Material flame = plain("flame", hex(0xFFB347), 0.9f);
    flame.emission = {16.0f, 8.0f, 2.0f};
    materials_.flame = assembly_.add_material(flame);
    materials_.fruit = assembly_.add_material(plain("oranges", hex(0xF08A1D), 0.42f));
    materials_.dark = assembly_.add_material(plain("window glass", hex(0x20282E), 0.06f));
}

uint32_t Courtyard::add(const std::string& name, uint32_t material, shading::Mesh mesh, const Openness& openness) {
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        mesh.uv[1].emplace_back(glm::clamp(openness(mesh.positions[i], mesh.normals[i]), 0.0f, 1.0f), 0.5f);
    }
    return assembly_.add_mesh(name, material, std::move(mesh));
}

void Courtyard::add_and_place(const std::string& name, uint32_t material, shading::Mesh mesh, const Openness& openness) {
    place(add(name, material, std::move(mesh), openness));
}

shading::Scene make_courtyard(const texunit::TextureOptions& options) {
    SceneAssembly assembly("courtyard", options);
    assembly.turn_to_sun(52.0f);
    Courtyard court(assembly);
    build_court_floor(court);
    build_arcades(court);
    build_upper_storey(court);
    build_garden_wall(court);
    build_fountain(court);
    build_garden(court);
    assembly.add_camera("afternoon", {4.35f, 1.62f, 6.5f}, {-1.2f, 1.92f, -3.2f}, 46.0f);
    assembly.add_sky_and_sun();
    return assembly.take();
}

}  // namespace rawtexel::scenes
