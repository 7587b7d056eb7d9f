#include "tests/benchmarks/tools/peer_lookup.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/texture.h>

#include <stdexcept>

namespace rawtexel::tools {
namespace {

class TextureSystemSampler final : public PeerSampler {
  public:
    TextureSystemSampler(const Pyramid& pyramid, int probes, const std::string& folder)
        : system_(OIIO::TextureSystem::create(false)), file_(folder + "/anisotropy.tx") {
        OIIO::ImageBuf image(OIIO::ImageSpec(pyramid.extent, pyramid.extent, 1, OIIO::TypeDesc::UINT16));
        image.set_pixels(image.roi(), OIIO::TypeDesc::UINT16, pyramid.level[0].data());
        OIIO::ImageSpec settings;
        settings.tile_width = settings.tile_height = 64;
        settings.attribute("maketx:filtername", "box");
        if (!OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture, image, file_.string(), settings)) {
            throw std::runtime_error("cannot write " + file_.string() + ": " + OIIO::geterror());
        }
        system_->attribute("max_memory_MB", 2048.0f);
        options_.mipmode = OIIO::TextureOpt::MipModeAniso;
        options_.interpmode = OIIO::TextureOpt::InterpBilinear;
        options_.swrap = options_.twrap = OIIO::TextureOpt::WrapPeriodic;
        options_.anisotropic = probes;
    }
    ~TextureSystemSampler() override { OIIO::TextureSystem::destroy(system_); }

    std::string name() const override { return std::string("OpenImageIO ") + OIIO_VERSION_STRING; }

    std::vector<double> look_up(const std::vector<texunit::reference::Lookup>& lookups, double scale) override {
        std::vector<double> values;
        const auto by = [&](float derivative) { return float(double(derivative) * scale); };
        for (const texunit::reference::Lookup& at : lookups) {
            OIIO::TextureOpt options = options_;
            float value = 0;
            if (!system_->texture(file_, options, at.u, at.v, by(at.dudx), by(at.dvdx), by(at.dudy), by(at.dvdy), 1, &value)) {
                throw std::runtime_error(system_->geterror());
            }
            values.push_back(value);
        }
        return values;
    }

  private:
    OIIO::TextureSystem* system_;
    OIIO::ustring file_;
    OIIO::TextureOpt options_;
};

}  // namespace

std::vector<double> read_red_channel(const std::string& path, int extent) {
    OIIO::ImageBuf image(path);
    if (!image.read(0, 0, true, OIIO::TypeDesc::DOUBLE)) throw std::runtime_error(path + ": " + image.geterror());
    if (image.spec().width != extent || image.spec().height != extent) {
        throw std::runtime_error(path + ": not " + std::to_string(extent) + " texels a side");
    }
    std::vector<double> red(size_t(extent) * size_t(extent));
    image.get_pixels(OIIO::ROI(0, extent, 0, extent, 0, 1, 0, 1), OIIO::TypeDesc::DOUBLE, red.data());
    return red;
}

std::unique_ptr<PeerSampler> make_texture_system_sampler(const Pyramid& pyramid, int probes, const std::string& folder) {
    return std::make_unique<TextureSystemSampler>(pyramid, probes, folder);
}

}  // namespace rawtexel::tools
