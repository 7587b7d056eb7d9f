#include "texunit/cache_spec.h"

#include <bit>
#include <charconv>
#include <utility>

namespace rawtexel::texunit {
namespace {

/// The text before the first `separator`, and what follows it; nullopt where there is none.
std::pair<std::string_view, std::optional<std::string_view>> split(std::string_view text, char separator) {
    const size_t at = text.find(separator);
    if (at == std::string_view::npos) return {text, std::nullopt};
    return {text.substr(0, at), text.substr(at + 1)};
}

std::optional<uint64_t> parse_number(std::string_view text) {
    uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

std::optional<uint64_t> parse_bytes(std::string_view text) {
    uint64_t unit = 1;
    if (text.ends_with('K')) unit = 1024;
    if (text.ends_with('M')) unit = 1024 * 1024;
    if (unit != 1) text.remove_suffix(1);
    const auto value = parse_number(text);
    if (!value || *value > kMostCacheBytes / unit) return std::nullopt;
    return *value * unit;
}

std::optional<CacheContent> parse_content(std::string_view text) {
    if (text == "decoded") return CacheContent::Decoded;
    if (text == "stored") return CacheContent::Stored;
    return std::nullopt;
}

bool set_level(std::string_view value, CacheLevelSpec& level) {
    const auto [bytes_text, ways_text] = split(value, ':');
    const auto bytes = parse_bytes(bytes_text);
    if (!bytes) return false;
    level.bytes = *bytes;
    if (!ways_text) return true;
    const auto ways = *ways_text == "full" ? std::optional<uint64_t>(0) : parse_number(*ways_text);
    if (!ways || *ways > kMostCacheBytes || (*ways == 0 && *ways_text != "full")) return false;
    level.ways = int(*ways);
    return true;
}

bool set_contents(std::string_view value, CacheSpec& spec) {
    const auto [first_text, second_text] = split(value, ':');
    const auto first = parse_content(first_text), second = parse_content(second_text.value_or(first_text));
    if (!first || !second) return false;
    spec.l1_holds = *first;
    spec.l2_holds = *second;
    return true;
}

bool set_count(std::string_view value, uint64_t most, int& count) {
    const auto number = parse_number(value);
    if (!number || *number < 1 || *number > most) return false;
    count = int(*number);
    return true;
}

bool set_field(std::string_view name, std::string_view value, CacheSpec& spec) {
    if (name == "line") return set_count(value, 4096, spec.line_bytes);
    if (name == "sectors") return set_count(value, kMostSectors, spec.sectors);
    if (name == "l1") return set_level(value, spec.l1);
    if (name == "l2") return set_level(value, spec.l2);
    if (name == "cores") return set_count(value, kMostCores, spec.cores);
    return set_contents(value, spec);
}

bool is_field(std::string_view name) {
    return name == "line" || name == "sectors" || name == "l1" || name == "l2" || name == "cores" || name == "holds";
}

/// What is wrong with one level, or nothing.
std::string check_level(std::string_view name, const CacheLevelSpec& level, int line_bytes) {
    const uint64_t set_bytes = uint64_t(line_bytes) * uint64_t(level.ways == 0 ? 1 : level.ways);
    if (level.bytes > 0 && level.bytes % set_bytes == 0) return {};
    std::string text(name);
    text.append(" of ").append(std::to_string(level.bytes)).append(" bytes is not a whole number of sets (");
    return text.append(std::to_string(set_bytes)).append(" bytes each)");
}

std::string check(const CacheSpec& spec) {
    if (!std::has_single_bit(unsigned(spec.line_bytes)) || spec.line_bytes < 16)
        return std::to_string(spec.line_bytes).append(" bytes a line is not a power of two from 16 to 4096");
    if (!std::has_single_bit(unsigned(spec.sectors)) || spec.line_bytes / spec.sectors < 16)
        return std::to_string(spec.sectors)
            .append(" sectors do not divide lines of ")
            .append(std::to_string(spec.line_bytes))
            .append(" bytes into powers of two of 16 or more");
    const std::string first = check_level("l1", spec.l1, spec.line_bytes);
    return first.empty() ? check_level("l2", spec.l2, spec.line_bytes) : first;
}

std::string print_level(const CacheLevelSpec& level) {
    std::string text = std::to_string(level.bytes % 1024 == 0 ? level.bytes / 1024 : level.bytes);
    return text.append(level.bytes % 1024 == 0 ? "K:" : ":").append(level.ways == 0 ? "full" : std::to_string(level.ways));
}

std::string_view print_content(CacheContent content) { return content == CacheContent::Decoded ? "decoded" : "stored"; }

}  // namespace

std::optional<CacheSpec> parse_cache_spec(std::string_view text, std::string& error) {
    CacheSpec spec;
    for (std::optional<std::string_view> rest = text; rest;) {
        const auto [field, next] = split(*rest, ',');
        rest = next;
        const auto [name, value] = split(field, '=');
        if (!is_field(name)) {
            error = std::string("unknown field '").append(name).append("' (line sectors l1 l2 cores holds)");
            return std::nullopt;
        }
        if (!value || !set_field(name, *value, spec)) {
            error = std::string("'").append(field).append("' is malformed or out of range");
            return std::nullopt;
        }
    }
    error = check(spec);
    if (!error.empty()) return std::nullopt;
    return spec;
}

std::string to_string(const CacheSpec& spec) {
    std::string text("line=");
    text.append(std::to_string(spec.line_bytes)).append(",sectors=").append(std::to_string(spec.sectors));
    text.append(",l1=").append(print_level(spec.l1)).append(",l2=").append(print_level(spec.l2));
    text.append(",cores=").append(std::to_string(spec.cores));
    return text.append(",holds=").append(print_content(spec.l1_holds)).append(":").append(print_content(spec.l2_holds));
}

}  // namespace rawtexel::texunit
