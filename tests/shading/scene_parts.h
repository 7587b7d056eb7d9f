// Small scenes for the tests of the frame pipeline, put together in code.
#pragma once

#include "shading/render.h"
#include "shading/scene.h"

#include <glm/glm.hpp>

#include <functional>
#include <memory>

namespace rawtexel::shading::test {

/// A float RGBA texture with texel (x, y) = color(x, y).
SceneTexture make_texture(int width, int height, const std::function<glm::vec4(int x, int y)>& color);
/// Fields of well-mixed values in [0, 1], alpha too.
SceneTexture make_noise_texture(int width, int height, uint32_t seed);

/// Two triangles with corners p, p + right, p + up; uv from (0, uv.y) at p to (uv.x, 0) opposite. No normals.
Mesh make_quad(const glm::vec3& p, const glm::vec3& right, const glm::vec3& up, const glm::vec2& uv = glm::vec2(1.0f));
/// A latitude-longitude sphere of radius 1 with normals and uv.
Mesh make_sphere(int columns, int rows);

/// Adds the parts of one more object and returns the instance.
uint32_t add_object(Scene& scene, Mesh mesh, const Material& material, const glm::mat4& world_from_object = glm::mat4(1.0f));

/// An unlit material of one colour.
Material unlit(const glm::vec4& color, AlphaMode mode = AlphaMode::Opaque);

/// Looks along -Z at [-1, 1]^2, which fills the frame. Near plane at z = 10, far plane at -10.
Camera square_camera();

/// A bit of everything: a textured floor to the horizon, a normal-mapped sphere, a mirrored double-sided one, MASK and BLEND quads in
/// front.
Scene make_busy_scene();
Camera busy_camera();
/// Its light, with a shadow map and an environment.
Lighting busy_lighting(const Scene& scene, Executor& executor);

}  // namespace rawtexel::shading::test
