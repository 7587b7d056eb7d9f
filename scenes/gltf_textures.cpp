#include "scenes/gltf_textures.h"

#include "scenes/encoded_bytes.h"
#include "scenes/gltf_policy.h"
#include "scenes/image_claim.h"
#include "scenes/image_codec.h"

#include "texunit/containers.h"

#include <cstring>

namespace rawtexel::scenes {
namespace {

using texunit::ContainerKind;

/// So many bytes tell what an image is.
constexpr uint64_t kSignatureBytes = 64;

/// KTX2 whose texels are Basis Universal: no format of its own, or BasisLZ supercompression (KTX 2.0, 3.1 and 3.9).
bool is_basis_universal(const texunit::ByteSource& bytes) {
    constexpr size_t kFormatOffset = 12, kSupercompressionOffset = 44;
    const std::vector<std::byte> ktx2 = leading_bytes(bytes, kSupercompressionOffset + 4);
    if (ktx2.size() < kSupercompressionOffset + 4) return false;
    uint32_t format, supercompression;
    std::memcpy(&format, ktx2.data() + kFormatOffset, sizeof format);
    std::memcpy(&supercompression, ktx2.data() + kSupercompressionOffset, sizeof supercompression);
    return format == 0 || supercompression == 1;
}

texunit::Wrap wrap_of(int code) {
    switch (code) {
        case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE: return texunit::Wrap::ClampToEdge;
        case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT: return texunit::Wrap::MirroredRepeat;
        default: return texunit::Wrap::Repeat;
    }
}

/// Minification filter codes name the kernel and what lies between levels.
void set_minification(int code, texunit::SamplerState& state) {
    using texunit::Kernel;
    using texunit::MipMode;
    switch (code) {
        case TINYGLTF_TEXTURE_FILTER_NEAREST: state.minify = Kernel::Nearest, state.mip = MipMode::None; break;
        case TINYGLTF_TEXTURE_FILTER_LINEAR: state.minify = Kernel::Bilinear, state.mip = MipMode::None; break;
        case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST: state.minify = Kernel::Nearest, state.mip = MipMode::Nearest; break;
        case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST: state.minify = Kernel::Bilinear, state.mip = MipMode::Nearest; break;
        case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR: state.minify = Kernel::Nearest, state.mip = MipMode::Linear; break;
        default: state.minify = Kernel::Bilinear, state.mip = MipMode::Linear; break;
    }
}

std::string_view mime_type_of(ContainerKind kind, std::string_view format) {
    if (kind == ContainerKind::Ktx2) return "image/ktx2";
    if (kind == ContainerKind::Dds) return "image/vnd-ms.dds";
    if (format == "png") return "image/png";
    if (format == "jpeg") return "image/jpeg";
    if (format == "webp") return "image/webp";
    return {};
}

std::string text_of(const shading::LookupPolicy& policy) {
    std::string text;
    for (const auto& [name, spelling] : policy_members(policy)) text += std::string(name) + " " + spelling + " ";
    return text;
}

int extension_source(const tinygltf::Texture& texture, const char* extension) {
    const auto found = texture.extensions.find(extension);
    if (found == texture.extensions.end() || !found->second.Has("source")) return -1;
    return found->second.Get("source").GetNumberAsInt();
}

}  // namespace

GltfTextures::GltfTextures(const GltfDocument& document, const LoadOptions& options, GltfNotices& notices)
    : document_(document), texture_options_(options.texture), file_options_(options.files), notices_(notices) {
    for (size_t i = 0; i < document.images.size(); ++i) {
        const GltfImage& image = document.images[i];
        check_image_claim(document.path + ": " + image.name, image.mime_type, image.file_name,
                          leading_bytes(*image.encoded, kSignatureBytes));
        // A texture that has a plain source does not need this one.
        if (texunit::container_kind(*image.encoded) == ContainerKind::Ktx2 && is_basis_universal(*image.encoded)) continue;
        open(int(i), false);
    }
    for (size_t i = 0; i < document.model.textures.size(); ++i)
        policies_.push_back(read_policy(document, "textures[" + std::to_string(i) + "]", document.model.textures[i].extras));
}

std::unique_ptr<texunit::TexelSource> GltfTextures::open(int index, bool srgb) const {
    const GltfImage& image = document_.images[size_t(index)];
    const std::string name = document_.path + ": " + image.name;
    const EncodedBytes bytes = part_of(name, image.encoded, 0, image.encoded->size());
    switch (texunit::container_kind(*bytes)) {
        case ContainerKind::Ktx2: return texunit::reinterpret_srgb(texunit::open_ktx2(bytes, file_options_), srgb);
        case ContainerKind::Dds: return texunit::reinterpret_srgb(texunit::open_dds(bytes, file_options_), srgb);
        default: return open_image(bytes, srgb, file_options_.max_texture_bytes);
    }
}

int GltfTextures::image_of(int index) {
    const tinygltf::Texture& texture = document_.model.textures[size_t(index)];
    const std::string what = "textures[" + std::to_string(index) + "]";
    if (const int dds = extension_source(texture, "MSFT_texture_dds"); dds >= 0) return dds;
    const int ktx2 = extension_source(texture, "KHR_texture_basisu");
    if (ktx2 < 0 && texture.source < 0) notices_.say_once(what + " has no image, it is white");
    if (ktx2 < 0) return texture.source;
    if (!is_basis_universal(*document_.images[size_t(ktx2)].encoded)) return ktx2;
    if (texture.source < 0)
        document_.fail(what + " is Basis Universal compressed (" + document_.images[size_t(ktx2)].name +
                       "; allowed: KTX2 of BC or plain texels, or a PNG or JPEG source beside it)");
    notices_.say_once("Basis Universal textures are left out where there is a plain source");
    return texture.source;
}

int GltfTextures::texture(int index, bool srgb) {
    const int image = image_of(index);
    if (image < 0) return image;
    const shading::LookupPolicy& policy = policies_[size_t(index)];
    const auto [entry, is_new] = known_.try_emplace({image, srgb, text_of(policy)}, int(textures_.size()));
    if (!is_new) return entry->second;
    // The texels are the same whatever the policy.
    const auto [texels, first] = texels_.try_emplace({image, srgb}, entry->second);
    textures_.push_back(first ? make(image, srgb) : textures_[size_t(texels->second)]);
    textures_.back().policy = policy;
    return entry->second;
}

shading::SceneTexture GltfTextures::make(int image, bool srgb) const {
    const GltfImage& source = document_.images[size_t(image)];
    shading::SceneTexture texture;
    texture.texture = std::make_shared<texunit::Texture>(source.name, open(image, srgb), texture_options_);
    texture.image_name = source.name;
    const std::string_view format = image_format(source.name, leading_bytes(*source.encoded, kSignatureBytes));
    texture.mime_type = mime_type_of(texunit::container_kind(*source.encoded), format);
    if (texture.mime_type.empty()) texture.mime_type = source.mime_type;
    texture.srgb = srgb;
    texture.encoded = source.encoded;
    return texture;
}

texunit::SamplerState GltfTextures::sampler(int index) const {
    texunit::SamplerState state;
    const int sampler = document_.model.textures[size_t(index)].sampler;
    if (sampler < 0) return state;
    const tinygltf::Sampler& source = document_.model.samplers[size_t(sampler)];
    state.wrap_s = wrap_of(source.wrapS);
    state.wrap_t = wrap_of(source.wrapT);
    state.magnify = source.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST ? texunit::Kernel::Nearest : texunit::Kernel::Bilinear;
    set_minification(source.minFilter, state);
    return state;
}

}  // namespace rawtexel::scenes
