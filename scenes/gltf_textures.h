// The textures of a glTF: each image once per use as colour or as data, and once more per policy.
#pragma once

#include "scenes/gltf_document.h"
#include "scenes/gltf_notices.h"
#include "scenes/load.h"

#include "shading/scene.h"

#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace rawtexel::scenes {

class GltfTextures {
  public:
    /// Opens every image of the document, used or not. Throws InputError and TextureError.
    GltfTextures(const GltfDocument& document, const LoadOptions& options, GltfNotices& notices);

    /// Index into `textures()` of glTF texture `texture` read as sRGB-encoded colour or as data; -1 when it has no image, as glTF allows.
    /// Throws InputError and TextureError.
    int texture(int texture, bool srgb);
    /// Its sampler; silent properties are bilinear, linear between levels, and repeat.
    texunit::SamplerState sampler(int texture) const;

    std::vector<shading::SceneTexture> take() { return std::move(textures_); }

  private:
    int image_of(int texture);  ///< -1: none
    shading::SceneTexture make(int image, bool srgb) const;
    std::unique_ptr<texunit::TexelSource> open(int image, bool srgb) const;

    const GltfDocument& document_;
    texunit::TextureOptions texture_options_;
    texunit::ContainerOptions file_options_;
    GltfNotices& notices_;
    std::vector<shading::SceneTexture> textures_;
    std::vector<shading::LookupPolicy> policies_;              ///< of the document's textures
    std::map<std::tuple<int, bool, std::string>, int> known_;  ///< (image, srgb, policy as text) to index
    std::map<std::pair<int, bool>, int> texels_;               ///< (image, srgb) to the first of those that share its texels
};

}  // namespace rawtexel::scenes
