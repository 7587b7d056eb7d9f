#include "cli/vectors/suspect.h"

#include "cli/vectors/expectation.h"
#include "cli/vectors/judge.h"

#include <algorithm>
#include <cstring>

namespace rawtexel::cli {
namespace {

/// Whether an answer is the one that came: texels and codes exactly, floats as far as precision leaves them free.
bool explains(const Suspect& suspect, const PortResult& answer) {
    Expectation e = suspect.expectation;
    e.expected = answer;
    for (const RecordField& field : result_fields()) {
        for (auto word = size_t(field.word); word < size_t(field.word + field.count); ++word) {
            const auto at = 4 * word;
            char* const least = reinterpret_cast<char*>(&e.least) + at;
            char* const most = reinterpret_cast<char*>(&e.most) + at;
            const char* const from = reinterpret_cast<const char*>(&answer) + at;
            if (field.type != WordType::Float) {
                std::memcpy(least, from, 4), std::memcpy(most, from, 4);
                continue;
            }
            float value, low, high;
            std::memcpy(&value, from, 4), std::memcpy(&low, least, 4), std::memcpy(&high, most, 4);
            const float room = 0.75f * (high - low) + 1e-6f;
            low = value - room, high = value + room;
            std::memcpy(least, &low, 4), std::memcpy(most, &high, 4);
        }
    }
    return illegal_words(e, suspect.came) == 0;
}

}  // namespace

void Detective::try_answer(const std::string& name, const PortResult& answer) {
    // A fault that changes nothing here explains nothing.
    if (illegal_words(suspect_.expectation, answer) != 0 && explains(suspect_, answer)) keep(name);
}

void Detective::try_change(const std::string& name, const std::function<void(CaseRecord&)>& change) {
    CaseRecord record = suspect_.record;
    change(record);
    if (record == suspect_.record) return;
    if (record.op == PortOp::Draw) {
        const texunit::SamplerState sampler = sampler_of(record);
        if (!refusal(sampler.estimator, sampler.minify).empty() || !refusal(sampler.estimator, sampler.magnify).empty()) return;
    }
    try_answer(name, evaluate(suspect_.suite, record));
}

void Detective::keep(const std::string& name) {
    if (std::ranges::find(found_, name) == found_.end()) found_.push_back(name);
}

}  // namespace rawtexel::cli
