#include "cli/vectors/suite_files.h"

#include "cli/json_text.h"
#include "cli/vectors/expectation.h"
#include "cli/vectors/hardware_report.h"
#include "cli/version.h"
#include "scenes/image_io.h"
#include "scenes/output_file.h"
#include "texunit/noise.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cstring>
#include <filesystem>
#include <limits>
#include <type_traits>

namespace rawtexel::cli {
namespace {

using Json = nlohmann::ordered_json;
using texunit::Format;
using texunit::Shape;

static_assert(std::endian::native == std::endian::little, "records are little-endian words");

Json fields_json(std::span<const RecordField> fields, size_t words) {
    Json list = Json::array();
    for (const RecordField& field : fields)
        list.push_back({{"name", field.name}, {"word", field.word}, {"type", to_string(field.type)}, {"count", field.count}});
    return {{"words", words}, {"fields", list}};
}

template <class Range>
Json names_of(const Range& range) {
    Json names = Json::array();
    for (const auto& each : range) names.push_back(each.name);
    return names;
}

Json enumerations_json() {
    Json ops = Json::array();
    for (int op = 0; op < kPortOps; ++op) ops.push_back(to_string(PortOp(op)));
    return {{"op", ops},
            {"wrap", {"repeat", "mirror", "clamp", "border", "mirror-once"}},
            {"kernel", names_of(texunit::all_kernels())},
            {"estimator", names_of(texunit::all_estimators())},
            {"mip", {"none", "nearest", "linear"}},
            {"lod_rule", {"d3d", "exact"}},
            {"noise", names_of(texunit::all_noises())},
            {"format", names_of(texunit::all_formats())}};
}

Json freedom_json(const PortFreedom& freedom) {
    return {{"coordinate_texels", freedom.coordinate},
            {"derivative_relative", freedom.derivative},
            {"lod", freedom.lod},
            {"number", freedom.number},
            {"value_relative", freedom.value}};
}

Json suite_json(const Suite& suite, const TextureTables& tables) {
    Json json = {{"format", "rawtexel vectors"},
                 {"version", kVectorVersion},
                 {"rawtexel", version()},
                 {"suite", suite.name},
                 {"about", suite.about},
                 {"cases", suite.cases.size()},
                 {"left_out", suite.left_out},
                 {"suite_words", suite.words.size()},
                 {"files",
                  {{"cases", kCasesFile},
                   {"expected", kExpectedFile},
                   {"textures", kTexturesFile},
                   {"texels", kTexelsFile},
                   {"words", kWordsFile}}}};
    json["records"] = {{"case", fields_json(case_fields(), 64)},
                       {"result", fields_json(result_fields(), kResultWords)},
                       {"texture", fields_json(texture_fields(), 32)},
                       {"expectation", {{"words", 64}, {"expected", 0}, {"least", 16}, {"most", 32}, {"judged", 48}}}};
    json["enumerations"] = enumerations_json();
    json["freedom"] = freedom_json({});
    json["freedom_of_exact_groups"] = freedom_json(kExactFreedom);
    json["groups"] = Json::array();
    for (const CaseGroup& group : suite.groups)
        json["groups"].push_back(
            {{"name", group.name}, {"about", group.about}, {"first", group.first}, {"count", group.count}, {"exact", group.exact}});
    json["textures"] = Json::array();
    for (size_t n = 0; n < suite.textures.size(); ++n) {
        const SuiteTexture& texture = suite.textures[n];
        const Shape& shape = texture.shape();
        json["textures"].push_back({{"name", texture.name()},
                                    {"format", texunit::info(texture.format()).name},
                                    {"width", shape.width},
                                    {"height", shape.height},
                                    {"depth", shape.depth},
                                    {"layers", shape.layers},
                                    {"cube", shape.cube},
                                    {"levels", shape.levels},
                                    {"first_texel", tables.records[n].first_texel[0]}});
    }
    return json;
}

template <class T>
void write_records(const std::string& path, const std::vector<T>& records) {
    scenes::write_file(path, std::as_bytes(std::span(records)));
}

[[noreturn]] void fail(const std::string& path, const std::string& what) { throw scenes::InputError(path + ": " + what); }

constexpr uint64_t kMostFileBytes = uint64_t{4} << 30;  ///< ten times the lookups of a large scene

template <class T>
std::vector<T> read_records(const std::string& path) {
    std::error_code unreadable;  // read_file says why
    if (const uint64_t size = std::filesystem::file_size(path, unreadable); !unreadable && size > kMostFileBytes)
        fail(path, std::to_string(size) + " bytes are more than a suite's file may have (" + std::to_string(kMostFileBytes) + ")");
    const std::vector<std::byte> bytes = scenes::read_file(path);
    if (bytes.size() % sizeof(T) != 0)
        fail(path, std::to_string(bytes.size()) + " bytes are no whole number of records (" + std::to_string(sizeof(T)) + " bytes each)");
    std::vector<T> records(bytes.size() / sizeof(T));
    if (!bytes.empty()) std::memcpy(records.data(), bytes.data(), bytes.size());
    return records;
}

SuiteTexture read_texture(const std::string& path, const std::string& name, const TextureRecord& record, const std::vector<float>& texels,
                          const std::vector<uint32_t>& words) {
    const auto within = [](uint32_t value) { return value >= 1 && value <= uint32_t(texunit::kMaxExtent); };
    if (!within(record.width) || !within(record.height) || !within(record.depth) || !within(record.layers) ||
        record.format >= texunit::kFormatCount)
        fail(path, "texture '" + name + "' has an extent or a format that there is not");
    Shape shape{.width = int(record.width),
                .height = int(record.height),
                .depth = int(record.depth),
                .layers = int(record.layers),
                .levels = texunit::full_level_count(int(record.width), int(record.height), int(record.depth)),
                .cube = record.cube != 0};
    if (shape.cube && (shape.layers % 6 != 0 || shape.width != shape.height || shape.depth > 1))
        fail(path, "texture '" + name + "' is no cube map");
    const auto format = Format(record.format);
    size_t bytes = 0;
    for (int level = 0; level < shape.levels; ++level) {
        bytes +=
            size_t(texunit::stored_bytes(format, texunit::level_extent(shape.width, level), texunit::level_extent(shape.height, level))) *
            size_t(slice_count(shape, level));
    }
    const bool in_texels = format == Format::RGBA32Float;
    const size_t first = in_texels ? size_t(record.first_texel[0]) * 16 : size_t(record.first_word) * 4;
    const size_t there = in_texels ? texels.size() * 4 : words.size() * 4;
    if (first > there || there - first < bytes) fail(path, "texture '" + name + "' has fewer texels than its extents ask for");
    std::vector<std::byte> stored(bytes);
    std::memcpy(stored.data(),
                (in_texels ? reinterpret_cast<const char*>(texels.data()) : reinterpret_cast<const char*>(words.data())) + first, bytes);
    return {name, format, shape, std::move(stored)};
}

/// A case that asks for what there is not would read beyond its suite.
void check_case(const std::string& path, const Suite& suite, const CaseRecord& record, size_t index) {
    const auto refuse = [&](const char* what) { fail(path, "case " + std::to_string(index) + ": " + what); };
    if (uint32_t(record.op) >= uint32_t(kPortOps)) refuse("an op that there is not");
    if (record.wrap_s > 4 || record.wrap_t > 4 || record.wrap_r > 4) refuse("a wrap that there is not (0 to 4)");
    const bool looks_up = record.op == PortOp::Sample || record.op == PortOp::Draw || record.op == PortOp::Mean ||
                          record.op == PortOp::Shade || record.op == PortOp::BlockTexel;
    if (looks_up && record.texture >= suite.textures.size()) refuse("a texture that there is not");
    if (suite.name == kHardwareSuite && !looks_up) refuse("no lookup, which is all that a device's texture unit is asked for");
    if (suite.name == kHardwareSuite && texunit::info(suite.textures[record.texture].format()).block_compressed) {
        const Shape& shape = suite.textures[record.texture].shape();
        const auto& texel = suite.expected[index].expected;
        if (texel.x < 0 || texel.x >= shape.width || texel.y < 0 || texel.y >= shape.height) refuse("expects a texel that there is not");
    }
    if (record.minify > 9 || record.magnify > 9 || record.estimator > 3 || record.mip > 2 || record.lod_rule > 1 || record.noise > 4)
        refuse("a kernel, estimator, mip mode, rule or noise that there is not");
    const texunit::SamplerState sampler = sampler_of(record);
    for (const texunit::Kernel& kernel : {sampler.minify, sampler.magnify}) {
        const bool gaussian = kernel.kind == texunit::KernelKind::Gaussian || kernel.kind == texunit::KernelKind::GaussianPoint;
        if (gaussian && !(kernel.b >= texunit::kLeastSigma && kernel.b <= texunit::kMostSigma)) refuse("a sigma that there is not");
        if (!(std::abs(kernel.b) <= texunit::kMostSigma && std::abs(kernel.c) <= texunit::kMostMitchell))
            refuse("parameters of a kernel that there are not");
        if (record.op == PortOp::Draw && !refusal(sampler.estimator, kernel).empty()) refuse("an estimator that refuses its kernel");
    }
    if (record.probes < 1 || record.probes > 64) refuse("a number of probes that there is not (1 to 64)");
    if (record.op == PortOp::Mean && (record.count < 1 || record.count > 1u << 20)) refuse("no draws, or too many");
    if (record.op == PortOp::SrgbDecode && (record.index < 0 || record.index > 255)) refuse("a code that there is not (0 to 255)");
    if (record.op == PortOp::WrapIndex && (record.extent < 1 || record.extent > 1 << 24)) refuse("an axis of no texels or more than 2^24");
    if (record.op == PortOp::WrapIndex && (record.index < -(1 << 30) || record.index > 1 << 30)) refuse("an index beyond 2^30");
    if (record.op == PortOp::BlockTexel) {
        const Shape& shape = suite.textures[record.texture].shape();
        if (record.index < 0 || record.index >= shape.width || record.extent < 0 || record.extent >= shape.height)
            refuse("a texel that there is not");
    }
}

/// Whether JSON's conversion would keep what `value` says.
template <class T>
bool holds(const nlohmann::json& value) {
    if constexpr (std::is_same_v<T, std::string>) {
        if (!value.is_string()) return false;
        return std::ranges::none_of(value.get_ref<const std::string&>(), [](unsigned char c) { return c < 0x20 || c == 0x7F; });
    } else if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) {
        return value.is_number_unsigned() && value.get<uint64_t>() <= uint64_t(std::numeric_limits<T>::max());
    } else {
        return true;
    }
}

template <class T>
T member(const std::string& path, const nlohmann::json& json, const char* name) {
    try {
        if (!holds<T>(json.at(name))) fail(path, std::string("\"") + name + "\" is out of range or of another kind");
        return json.at(name).get<T>();
    } catch (const nlohmann::json::exception&) {
        fail(path, std::string("\"") + name + "\" is missing or of another kind");
    }
}

}  // namespace

void write_suite(const Suite& suite, const std::string& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error || !std::filesystem::is_directory(folder, error))
        throw scenes::OutputError(folder + ": cannot be made a folder (" + (error ? error.message() : "it is a file") + ")");
    const TextureTables tables = texture_tables(suite);
    const std::filesystem::path root(folder);
    write_records((root / kCasesFile).string(), suite.cases);
    write_records((root / kExpectedFile).string(), suite.expected);
    write_records((root / kTexturesFile).string(), tables.records);
    write_records((root / kTexelsFile).string(), tables.texels);
    write_records((root / kWordsFile).string(), tables.words);
    const std::string text = suite_json(suite, tables).dump(2) + "\n";
    scenes::write_file((root / kSuiteFile).string(), std::as_bytes(std::span(text)));
}

bool is_suite_folder(const std::string& folder) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(std::filesystem::path(folder) / kSuiteFile, ignored);
}

Suite read_suite(const std::string& folder) {
    const std::filesystem::path root(folder);
    const std::string path = (root / kSuiteFile).string();
    const nlohmann::json json = read_json(path);
    if (member<std::string>(path, json, "format") != "rawtexel vectors") fail(path, "not a suite of vectors");
    if (const int found = member<int>(path, json, "version"); found != kVectorVersion)
        fail(path, "version " + std::to_string(found) + " (this program reads version " + std::to_string(kVectorVersion) + ")");
    Suite suite;
    suite.name = member<std::string>(path, json, "suite");
    suite.about = member<std::string>(path, json, "about");
    suite.left_out = member<uint32_t>(path, json, "left_out");
    suite.cases = read_records<CaseRecord>((root / kCasesFile).string());
    suite.expected = read_records<Expectation>((root / kExpectedFile).string());
    if (suite.expected.size() != suite.cases.size() || suite.cases.empty())
        fail(path, "as many expectations as cases are needed, at least one");
    const auto records = read_records<TextureRecord>((root / kTexturesFile).string());
    const auto texels = read_records<float>((root / kTexelsFile).string());
    const auto words = read_records<uint32_t>((root / kWordsFile).string());
    const auto own_words = member<size_t>(path, json, "suite_words");
    if (own_words > words.size()) fail(path, "fewer words than \"suite_words\"");
    suite.words.assign(words.begin(), words.begin() + std::ptrdiff_t(own_words));
    const auto named = member<nlohmann::json>(path, json, "textures");
    if (!named.is_array()) fail(path, "\"textures\" is no list");
    if (named.size() != records.size()) fail(path, "as many textures as " + std::string(kTexturesFile) + " has are needed");
    for (size_t n = 0; n < records.size(); ++n)
        suite.textures.push_back(read_texture(path, member<std::string>(path, named[n], "name"), records[n], texels, words));
    uint64_t next = 0;
    const auto groups = member<nlohmann::json>(path, json, "groups");
    if (!groups.is_array()) fail(path, "\"groups\" is no list");
    for (const auto& group : groups) {
        suite.groups.push_back({member<std::string>(path, group, "name"), member<std::string>(path, group, "about"),
                                member<uint32_t>(path, group, "first"), member<uint32_t>(path, group, "count"),
                                member<bool>(path, group, "exact")});
        if (suite.groups.back().first != next) fail(path, "groups that do not follow each other");
        if (suite.groups.back().count == 0) fail(path, "a group without cases");
        next += suite.groups.back().count;
    }
    if (next != suite.cases.size()) fail(path, "groups that do not hold all cases");
    for (size_t n = 0; n < suite.cases.size(); ++n) check_case(path, suite, suite.cases[n], n);
    return suite;
}

}  // namespace rawtexel::cli
