#include "cli/vectors/verdict_report.h"

#include "texunit/sampler.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>

namespace rawtexel::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kShownOfGroup = 3;

std::string print(float value) {
    std::array<char, 32> text;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end.ptr};
}

template <class T, class Record>
T word_of(const Record& record, size_t word) {
    T value;
    std::memcpy(&value, reinterpret_cast<const char*>(&record) + 4 * word, 4);
    return value;
}

template <class Record>
std::string word_text(const Record& record, size_t word, WordType type) {
    switch (type) {
        case WordType::Int: return std::to_string(word_of<int32_t>(record, word));
        case WordType::Uint: return std::to_string(word_of<uint32_t>(record, word));
        case WordType::Float: break;
    }
    return print(word_of<float>(record, word));
}

Json word_json(const PortResult& result, size_t word, WordType type) {
    if (type == WordType::Int) return word_of<int32_t>(result, word);
    if (type == WordType::Uint) return word_of<uint32_t>(result, word);
    const float value = word_of<float>(result, word);
    // JSON has no infinities.
    return std::isfinite(value) ? Json(value) : Json(print(value));
}

/// The field's name, with the channel of values.
std::string name_of(const RecordField& field, size_t word) {
    if (field.count == 1) return std::string(field.name);
    return std::string(field.name) + "[" + std::to_string(word - size_t(field.word)) + "]";
}

template <class Use>
void for_each_word(const CaseFailure& failure, const Use& use) {
    for (const RecordField& field : result_fields()) {
        for (auto word = size_t(field.word); word < size_t(field.word + field.count); ++word) {
            if ((failure.words & judges(word)) != 0) use(field, word);
        }
    }
}

std::string failure_text(const Suite& suite, const CaseFailure& failure) {
    std::string text = "    case " + std::to_string(failure.index) + ": " + case_text(suite, suite.cases[failure.index]) + "\n";
    const Expectation& e = suite.expected[failure.index];
    for_each_word(failure, [&](const RecordField& field, size_t word) {
        const auto of = [&](const PortResult& result) { return word_text(result, word, field.type); };
        text += "      " + name_of(field, word) + ": expected " + of(e.expected) + ", legal " + of(e.least) + " to " + of(e.most) +
                ", came " + of(failure.came) + "\n";
    });
    return text + "      likeliest cause: " + (failure.cause.empty() ? "unknown" : failure.cause) + "\n";
}

/// The failures of one group, and how often each cause was found.
std::string group_text(const Suite& suite, const CaseGroup& group, std::span<const CaseFailure> failures) {
    std::string text = "  " + group.name + ": " + std::to_string(failures.size()) + " of " + std::to_string(group.count) +
                       " cases are not legal\n    tried: " + group.about + "\n";
    std::map<std::string, int> causes;
    for (const CaseFailure& failure : failures) {
        if (!failure.cause.empty()) ++causes[failure.cause];
    }
    const auto most = std::ranges::max_element(causes, {}, [](const auto& each) { return each.second; });
    if (most != causes.end())
        text += "    likeliest cause: " + most->first + " (explains " + std::to_string(most->second) + " of " +
                std::to_string(std::min<size_t>(failures.size(), kDiagnosedOfGroup)) + " looked into)\n";
    for (size_t n = 0; n < std::min(failures.size(), kShownOfGroup); ++n) text += failure_text(suite, failures[n]);
    if (failures.size() > kShownOfGroup) text += "    and " + std::to_string(failures.size() - kShownOfGroup) + " more\n";
    return text;
}

std::span<const CaseFailure> failures_of(const CaseGroup& group, std::span<const CaseFailure> all) {
    const auto first = std::ranges::lower_bound(all, size_t(group.first), {}, &CaseFailure::index);
    const auto end = std::ranges::lower_bound(all, size_t(group.first) + group.count, {}, &CaseFailure::index);
    return all.subspan(size_t(first - all.begin()), size_t(end - first));
}

}  // namespace

std::string case_text(const Suite& suite, const CaseRecord& record) {
    std::string text(to_string(record.op));
    static const CaseRecord plain;
    const bool textured = record.op == PortOp::Sample || record.op == PortOp::Draw || record.op == PortOp::Mean ||
                          record.op == PortOp::Shade || record.op == PortOp::BlockTexel;
    if (textured) text += ", texture '" + suite.textures[record.texture].name() + "'";
    for (const RecordField& field : case_fields()) {
        if (field.name == "op" || field.name == "texture") continue;
        const auto first = size_t(field.word), bytes = 4 * size_t(field.count);
        if (std::memcmp(reinterpret_cast<const char*>(&record) + 4 * first, reinterpret_cast<const char*>(&plain) + 4 * first, bytes) == 0)
            continue;
        text += ", " + std::string(field.name) + " ";
        if (field.name.starts_with("wrap_")) {
            text += to_string(texunit::Wrap(word_of<uint32_t>(record, first)));
        } else if (field.name == "minify" || field.name == "magnify") {
            text += texunit::all_kernels()[word_of<uint32_t>(record, first)].name;
        } else if (field.name == "estimator") {
            text += to_string(texunit::Estimator(record.estimator));
        } else if (field.name == "mip") {
            text += to_string(texunit::MipMode(record.mip));
        } else {
            for (size_t n = 0; n < size_t(field.count); ++n) text += (n > 0 ? "," : "") + word_text(record, first + n, field.type);
        }
    }
    return text;
}

std::string verdict_text(const Suite& suite, const SuiteVerdict& verdict, const std::string& source) {
    std::string text = suite.name + " (" + source + "): ";
    const std::string cases = std::to_string(suite.cases.size()) + " cases";
    if (verdict.holds()) return text + cases + ", all legal\n";
    text += std::to_string(verdict.failures.size()) + " of " + cases + " are not legal\n";
    for (const CaseGroup& group : suite.groups) {
        const auto failures = failures_of(group, verdict.failures);
        if (!failures.empty()) text += group_text(suite, group, failures);
    }
    return text;
}

Json verdict_json(const Suite& suite, const SuiteVerdict& verdict, const std::string& source) {
    Json json = {{"suite", suite.name},
                 {"source", source},
                 {"cases", suite.cases.size()},
                 {"failed", verdict.failures.size()},
                 {"failures", Json::array()}};
    for (const CaseFailure& failure : verdict.failures) {
        Json one = {{"case", failure.index},
                    {"group", suite.group_of(failure.index).name},
                    {"inputs", case_text(suite, suite.cases[failure.index])},
                    {"cause", failure.cause.empty() ? Json(nullptr) : Json(failure.cause)},
                    {"fields", Json::array()}};
        const Expectation& e = suite.expected[failure.index];
        for_each_word(failure, [&](const RecordField& field, size_t word) {
            one["fields"].push_back({{"field", name_of(field, word)},
                                     {"expected", word_json(e.expected, word, field.type)},
                                     {"legal", {word_json(e.least, word, field.type), word_json(e.most, word, field.type)}},
                                     {"came", word_json(failure.came, word, field.type)}});
        });
        json["failures"].push_back(std::move(one));
    }
    return json;
}

}  // namespace rawtexel::cli
