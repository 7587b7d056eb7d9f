#include "cli/bench/sweep_file.h"

#include "cli/usage_error.h"
#include "cli/version.h"
#include "cli/word_list.h"
#include "scenes/image_io.h"
#include "scenes/output_file.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <span>

namespace rawtexel::cli {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

Json header(const GivenOptions& settings) {
    Json list = Json::array();
    for (const auto& [name, value] : settings) list.push_back({name, value});
    return {{"sweep", "rawtexel " + std::string(version())}, {"settings", std::move(list)}};
}

std::vector<std::string> lines_of(const std::string& path) {
    const std::vector<std::byte> bytes = scenes::read_file(path);
    std::vector<std::string> lines = split({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, '\n');
    if (!lines.empty() && lines.back().empty()) lines.pop_back();
    return lines;
}

std::string print(const std::pair<std::string, std::string>& option) {
    return option.second.empty() ? option.first : option.first + " " + option.second;
}

/// "--size 96x54, asked for --size 64x36": the first options by which the two differ.
std::string difference(const GivenOptions& found, const GivenOptions& asked) {
    const auto lacking = [](const GivenOptions& all, const GivenOptions& others) {
        const auto one = std::ranges::find_if(all, [&](const auto& each) { return std::ranges::find(others, each) == others.end(); });
        return one == all.end() ? std::string("no such option") : print(*one);
    };
    return "found " + lacking(found, asked) + ", asked for " + lacking(asked, found);
}

std::vector<SceneFile> as_they_are(const std::vector<std::string>& paths) {
    std::vector<SceneFile> files;
    for (const std::string& path : paths) {
        std::error_code unknown;
        const uintmax_t bytes = fs::file_size(path, unknown);
        const auto changed = fs::last_write_time(path, unknown).time_since_epoch();
        files.push_back({path, unknown ? 0 : uint64_t(bytes), std::chrono::duration_cast<std::chrono::nanoseconds>(changed).count()});
    }
    return files;
}

}  // namespace

SweepFile::SweepFile(std::string path, GivenOptions settings) : path_(std::move(path)) { note(header(settings)); }

bool SweepFile::is_interrupted(const std::string& path) {
    std::error_code error;
    if (!fs::is_regular_file(path, error)) return false;
    const std::vector<std::string> lines = lines_of(path);
    return lines.size() > 1 && !lines.back().starts_with("{\"end\"");
}

SweepFile SweepFile::resumed(std::string path, GivenOptions settings) {
    std::error_code error;
    if (!fs::exists(path, error)) throw UsageError("--resume: there is no sweep to go on with ('" + path + "' is missing)");
    SweepFile file;
    file.path_ = path;
    size_t number = 0;
    try {
        for (const std::string& text : lines_of(path)) {
            ++number;
            const Json line = Json::parse(text);
            if (number == 1) {
                const Json asked = header(settings);
                if (line.at("sweep") != asked.at("sweep"))
                    throw UsageError("--resume: the sweep there is of another version (found " + line.at("sweep").get<std::string>() +
                                     ", this is " + asked.at("sweep").get<std::string>() + ")");
                if (line.at("settings") != asked.at("settings"))
                    throw UsageError("--resume: the sweep there has other settings (" +
                                     difference(line.at("settings").get<GivenOptions>(), settings) + ")");
            }
            if (line.contains("end")) continue;
            file.read_line(line);
            file.text_ += text + "\n";
        }
    } catch (const Json::exception&) {
        throw scenes::InputError(path + ": line " + std::to_string(number) + " is not what a sweep wrote");
    }
    if (number == 0) throw scenes::InputError(path + ": is empty");
    return file;
}

void SweepFile::read_line(const Json& line) {
    if (line.contains("truth")) {
        truths_.push_back(truth_from(line.at("truth")));
    } else if (line.contains("configuration")) {
        measurements_.push_back(measurement_from(line.at("configuration")));
    } else if (line.contains("files")) {
        SceneFiles scene{line.at("scene"), {}};
        for (const Json& one : line.at("files")) scene.files.push_back({one.at(0), one.at(1), one.at(2)});
        scenes_.push_back(std::move(scene));
    } else {
        line.at("settings");
    }
}

const Truth* SweepFile::truth(const std::string& scene, const std::string& filter) const {
    const auto found = std::ranges::find_if(truths_, [&](const Truth& one) { return one.scene == scene && one.filter == filter; });
    return found == truths_.end() ? nullptr : &*found;
}

const Measurement* SweepFile::measurement(const std::string& scene, const std::string& options) const {
    const auto found =
        std::ranges::find_if(measurements_, [&](const Measurement& one) { return one.scene == scene && one.options == options; });
    return found == measurements_.end() ? nullptr : &*found;
}

void SweepFile::note(const Json& line) { text_ += line.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n"; }

void SweepFile::write() const { scenes::write_file(path_, std::as_bytes(std::span(text_))); }

void SweepFile::begin() { write(); }

void SweepFile::add(Truth truth) {
    note({{"truth", to_json(truth)}});
    write();
    truths_.push_back(std::move(truth));
}

void SweepFile::add(Measurement measurement) {
    note({{"configuration", to_json(measurement)}});
    write();
    measurements_.push_back(std::move(measurement));
}

void SweepFile::check_files(const std::string& scene, const std::vector<std::string>& paths) {
    const std::vector<SceneFile> files = as_they_are(paths);
    const auto found = std::ranges::find(scenes_, scene, &SceneFiles::scene);
    if (found != scenes_.end()) {
        const auto changed =
            std::ranges::find_if(files, [&](const SceneFile& one) { return std::ranges::find(found->files, one) == found->files.end(); });
        if (changed != files.end())
            throw UsageError("'" + changed->path + "' has changed since the sweep began: what is finished was measured of another scene");
        return;
    }
    Json list = Json::array();
    for (const SceneFile& one : files) list.push_back({one.path, one.bytes, one.changed});
    note({{"scene", scene}, {"files", std::move(list)}});
    scenes_.push_back({scene, files});
}

void SweepFile::end() {
    note({{"end", true}});
    write();
}

}  // namespace rawtexel::cli
