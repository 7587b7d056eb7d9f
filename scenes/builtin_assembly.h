// Putting a built-in scene together: textures from surfaces, materials from textures, meshes placed.
#pragma once

#include "scenes/procedural_surface.h"
#include "shading/scene.h"

#include <string>

namespace rawtexel::scenes {

class SceneAssembly {
  public:
    SceneAssembly(std::string name, texunit::TextureOptions options);

    /// Index of a new texture.
    int add_texture(std::string name, std::unique_ptr<texunit::TexelSource> source);

    /// Index of a new material that uses colour, finish (occlusion, roughness, metallic) and normal map of `surface`.
    uint32_t add_surface_material(const std::string& name, Surface surface);
    /// The same without the normal map.
    uint32_t add_flat_material(const std::string& name, Surface surface);
    /// Index of a new material with the surface's colour (and alpha) alone, dielectric.
    uint32_t add_color_material(const std::string& name, Surface surface, float roughness);
    uint32_t add_material(shading::Material material);
    shading::Material& material(uint32_t index) { return scene_.materials[index]; }

    /// Turns everything placed from now on about the y axis, so that the built-in sun stands at `azimuth` degrees: 0 is +Z, 90 is +X.
    void turn_to_sun(float azimuth);

    /// Index of a new mesh; tangents are dropped where the material has no normal map.
    uint32_t add_mesh(std::string name, uint32_t material, shading::Mesh mesh);
    const shading::Mesh& mesh(uint32_t index) const { return scene_.meshes[index]; }
    void place(uint32_t mesh, const glm::mat4& world_from_object = glm::mat4(1.0f));

    /// A camera at `eye` that sees `target` in the middle; `vertical_fov` in degrees.
    void add_camera(const std::string& name, glm::vec3 eye, glm::vec3 target, float vertical_fov);
    void add_camera(shading::Camera camera);
    void add_light(shading::Light light);
    /// The built-in sky and its sun.
    void add_sky_and_sun();
    void set_environment(shading::EnvironmentRequest environment) { scene_.environment = environment; }

    shading::Scene take() { return std::move(scene_); }

  private:
    uint32_t add_finish_material(const std::string& name, SurfaceMaps& maps);

    shading::Scene scene_;
    texunit::TextureOptions options_;
    glm::mat4 world_from_design_{1.0f};
};

/// A map of `texture` with the sampler that most materials want: repeat, trilinear.
shading::TextureMap repeating_map(int texture);

/// World from camera: at `eye`, looking at `target`, +Y up.
glm::mat4 looking_at(glm::vec3 eye, glm::vec3 target);

/// Linear light of an sRGB-encoded colour.
glm::vec3 linear_color(glm::vec3 srgb);
/// An sRGB-encoded colour from its usual hexadecimal spelling, 0xRRGGBB.
glm::vec3 hex(uint32_t rgb);

}  // namespace rawtexel::scenes
