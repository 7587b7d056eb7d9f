// Lights and cameras that hang on glTF nodes.
#pragma once

#include "scenes/gltf_document.h"

#include "shading/scene.h"

namespace rawtexel::scenes {

/// Throws InputError when any light of the document, shown or not, is none that KHR_lights_punctual knows, or a spot whose inner cone is
/// not smaller than its outer one.
void check_lights(const GltfDocument& document);

/// Light `light` of KHR_lights_punctual, on a node with the world matrix `world`; check_lights has passed.
shading::Light read_light(const GltfDocument& document, int light, const glm::dmat4& world);

/// Camera `camera` (glTF 2.0, 3.10) on such a node; the matrix's scale and shear play no part. Throws InputError.
shading::Camera read_camera(const GltfDocument& document, int camera, const glm::dmat4& world);

}  // namespace rawtexel::scenes
