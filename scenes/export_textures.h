// Textures of an exported file: images keep their own bytes, generated ones become PNG.
#pragma once

#include "scenes/export_buffer.h"
#include "shading/scene.h"

#include <nlohmann/json.hpp>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace rawtexel::scenes {

class ExportTextures {
  public:
    /// Both must outlive this. `path` is named in errors.
    ExportTextures(const shading::Scene& scene, std::string path, ExportBuffer& buffer)
        : scene_(scene), path_(std::move(path)), buffer_(buffer) {}

    /// Index of the glTF texture of scene texture `texture` seen through `sampler`. `color`: it is used where glTF reads sRGB.
    /// Throws OutputError where PNG cannot hold the texels, and TextureError where they are damaged.
    int texture(int texture, const texunit::SamplerState& sampler, bool color);

    const nlohmann::json& textures() const { return textures_.array; }
    const nlohmann::json& images() const { return images_; }
    const nlohmann::json& samplers() const { return samplers_.array; }
    /// Extensions without which the textures cannot be read.
    const std::set<std::string>& extensions() const { return extensions_; }

  private:
    /// Elements of which no two are equal.
    struct DistinctElements {
        nlohmann::json array = nlohmann::json::array();
        std::map<nlohmann::json, int> index;

        int index_of(nlohmann::json element);
    };

    int image(int texture, bool color);

    const shading::Scene& scene_;
    std::string path_;
    ExportBuffer& buffer_;
    nlohmann::json images_ = nlohmann::json::array();
    DistinctElements textures_, samplers_;
    std::set<std::string> extensions_;
    std::map<const void*, int> image_of_;  // by encoded bytes, or by texture where it was generated
};

}  // namespace rawtexel::scenes
