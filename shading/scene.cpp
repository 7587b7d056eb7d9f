#include "shading/scene.h"

#include <cmath>
#include <limits>

namespace rawtexel::shading {

uint64_t Scene::triangle_count() const {
    uint64_t count = 0;
    for (const Instance& instance : instances) count += meshes[instance.mesh].indices.size() / 3;
    return count;
}

Bounds Scene::bounds() const {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    Bounds bounds{glm::vec3(kInfinity), glm::vec3(-kInfinity)};
    bool any = false;
    for (const Instance& instance : instances) {
        const glm::mat4& world_from_object = instance.world_from_object;
        for (const glm::vec3& position : meshes[instance.mesh].positions) {
            const glm::vec3 world = glm::vec3(world_from_object * glm::vec4(position, 1.0f));
            // A broken vertex is dropped by the rasterizer; it must not move the camera either.
            if (!std::isfinite(world.x) || !std::isfinite(world.y) || !std::isfinite(world.z)) continue;
            bounds.lower = glm::min(bounds.lower, world);
            bounds.upper = glm::max(bounds.upper, world);
            any = true;
        }
    }
    return any ? bounds : Bounds{};
}

}  // namespace rawtexel::shading
