// The parts of the courtyard, so that each file builds one.
#pragma once

#include "scenes/builtin_assembly.h"

#include <functional>

namespace rawtexel::scenes {

/// Metres. The court is the square |x|, |z| < kCourt; arcades run along z = -kCourt and x = -kCourt, a garden wall along x = +kCourt.
inline constexpr float kCourt = 6.0f, kArcadeDepth = 2.4f, kArcadeFloor = 0.12f, kUpperFloor = 3.87f, kCornice = 6.35f, kGardenWall = 2.5f;

/// Indices of the courtyard's materials.
struct CourtyardMaterials {
    uint32_t cobbles, ashlar, limestone, plaster, brick, roof, terracotta, soil, oak, shutter, iron, bronze, tiles, water, glass, flame;
    uint32_t olive, ivy, blossom, leaves, bark, fruit, dark;
};

/// How much of the sky a point sees, 0..1: what dims the light from all around, but not the sun.
using Openness = std::function<float(glm::vec3 position, glm::vec3 normal)>;

class Courtyard {
  public:
    explicit Courtyard(SceneAssembly& assembly);

    /// Index of a new mesh whose openness is stored in uv set 1, where the materials' occlusion map reads it.
    uint32_t add(const std::string& name, uint32_t material, shading::Mesh mesh, const Openness& openness);
    void place(uint32_t mesh, const glm::mat4& transform = glm::mat4(1.0f)) { assembly_.place(mesh, transform); }
    void add_and_place(const std::string& name, uint32_t material, shading::Mesh mesh, const Openness& openness);

    const CourtyardMaterials& materials() const { return materials_; }

  private:
    uint32_t surface(const std::string& name, Surface surface);
    uint32_t foliage(const std::string& name, Surface surface);
    void add_plain_materials();

    SceneAssembly& assembly_;
    int openness_ramp_;
    CourtyardMaterials materials_{};
};

void build_court_floor(Courtyard& court);
void build_arcades(Courtyard& court);
void build_upper_storey(Courtyard& court);
void build_garden_wall(Courtyard& court);
void build_fountain(Courtyard& court);
void build_garden(Courtyard& court);

}  // namespace rawtexel::scenes
