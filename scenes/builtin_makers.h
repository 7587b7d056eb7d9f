// One function per built-in scene; builtin.cpp lists them.
#pragma once

#include "shading/scene.h"
#include "texunit/texture.h"

namespace rawtexel::scenes {

shading::Scene make_plane(const texunit::TextureOptions& options);
shading::Scene make_spheres(const texunit::TextureOptions& options);
shading::Scene make_magnify(const texunit::TextureOptions& options);
shading::Scene make_metal_edge(const texunit::TextureOptions& options);
shading::Scene make_bumps(const texunit::TextureOptions& options);
shading::Scene make_foliage(const texunit::TextureOptions& options);
shading::Scene make_triplanar(const texunit::TextureOptions& options);
shading::Scene make_layers(const texunit::TextureOptions& options);
shading::Scene make_font(const texunit::TextureOptions& options);
shading::Scene make_shadow(const texunit::TextureOptions& options);
shading::Scene make_courtyard(const texunit::TextureOptions& options);

}  // namespace rawtexel::scenes
