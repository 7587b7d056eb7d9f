#include "cli/profile_page.h"

#include "cli/image_output.h"
#include "cli/reports/page.h"
#include "cli/residency.h"
#include "shading/display.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

namespace rawtexel::cli {
namespace {

using Json = nlohmann::ordered_json;
using shading::Image;
using shading::PixelCount;

// Counts are whole; means of levels and ratios keep three digits behind the point.
double units_of(PixelCount count) { return count == PixelCount::Level || count == PixelCount::Anisotropy ? 1024.0 : 1.0; }

// A number a pixel in 24 bits, for scripts to read back: red is the upper byte.
std::vector<uint8_t> number_codes(const Image& values, double units) {
    std::vector<uint8_t> codes;
    codes.reserve(values.values.size() * 3);
    for (const float value : values.values) {
        const auto code = uint32_t(std::clamp(std::round(double(value) * units), 0.0, double((1 << 24) - 1)));
        codes.insert(codes.end(), {uint8_t(code >> 16), uint8_t(code >> 8), uint8_t(code)});
    }
    return codes;
}

/// Pictures are made last, side by side.
class Pictures {
  public:
    /// `make` gives the address that is put at `place`, which stays where it is.
    void add(Json& place, std::function<std::string()> make) { jobs_.push_back({&place, std::move(make)}); }
    void make_all(shading::Executor& executor) {
        executor.parallel_for(int64_t(jobs_.size()),
                              [&](int64_t index, int) { *jobs_[size_t(index)].place = jobs_[size_t(index)].make(); });
    }

  private:
    struct Job {
        Json* place;
        std::function<std::string()> make;
    };
    std::vector<Job> jobs_;
};

void add_layers(Json& json, const shading::FrameFetches& fetches, Pictures& pictures) {
    Json& layers = json["layers"] = Json::array();
    // Places stay: the list never grows beyond what is reserved.
    layers.get_ref<Json::array_t&>().reserve(shading::kPixelCounts);
    for (int i = 0; i < shading::kPixelCounts; ++i) {
        const auto count = PixelCount(i);
        const Image& image = fetches.pixel(count);
        if (image.width == 0) continue;
        layers.push_back({{"name", to_string(count)}, {"units", units_of(count)}, {"source", ""}});
        pictures.add(layers.back()["source"],
                     [&image, count] { return picture_address(image.width, image.height, 3, number_codes(image, units_of(count))); });
    }
}

void add_residency(Json& json, const shading::FrameFetches& fetches, Pictures& pictures) {
    Json& list = json["residency"] = Json::array();
    list.get_ref<Json::array_t&>().reserve(fetches.textures.size());
    for (size_t i = 0; i < fetches.textures.size(); ++i) {
        const std::vector<LevelResidency> levels = residency(fetches, i);
        const ResidencyPicture picture = draw_residency(levels);
        Json entry{{"name", fetches.textures[i]->name()}, {"width", picture.width}, {"height", picture.height}, {"levels", Json::array()}};
        uint64_t touched = 0;
        for (const LevelResidency& level : levels) {
            entry["levels"].push_back({{"blocks_touched", level.blocks_touched()}, {"blocks", level.touched.size()}});
            touched += level.blocks_touched();
        }
        list.push_back(std::move(entry));
        if (touched > 0)
            pictures.add(list.back()["source"], [picture] { return picture_address(picture.width, picture.height, 4, picture.codes); });
    }
}

}  // namespace

std::vector<uint8_t> display_codes(const Image& radiance, const ToneOptions& tone) {
    const shading::DisplayOptions display = display_options(tone);
    return shading::encode_8bit(shading::tone_mapped(radiance, display), display.transfer);
}

std::string profile_page(const ProfileRuns& runs, Json profile, shading::Executor& executor) {
    const RunRecord& own = runs.frame.record;
    profile["camera"] = own.view;
    profile["origin"] = {own.request.crop.x, own.request.crop.y};
    Pictures pictures;
    Json& settings = profile["settings"] = Json::array();
    settings.get_ref<Json::array_t&>().reserve(1 + runs.compared.size());
    const auto add_setting = [&](const ProfiledFrame& frame) {
        Json& setting = settings.emplace_back(Json{{"options", frame.options}, {"picture", ""}});
        add_layers(setting, *frame.record.result.fetches, pictures);
        add_residency(setting, *frame.record.result.fetches, pictures);
        const Image& radiance = frame.record.result.radiance;
        pictures.add(setting["picture"], [&] {
            return picture_address(radiance.width, radiance.height, 3, display_codes(radiance, frame.record.request.tone));
        });
    };
    add_setting(runs.frame);
    for (const ProfiledFrame& frame : runs.compared) add_setting(frame);
    pictures.make_all(executor);
    return report_page("profile.html", std::move(profile));
}

}  // namespace rawtexel::cli
