#ifdef RAWTEXEL_HAS_VULKAN
#include "cli/vulkan/port_runner.h"

#include "cli/vulkan/child_process.h"
#include "cli/vulkan/port_dispatch.h"
#include "scenes/image_io.h"

#include <cassert>
#include <chrono>
#include <cstring>
#include <span>

namespace rawtexel::cli {
namespace {

// A run as bytes, from the process that made it to the one that judges it: how it ended, then the results or what was thrown.

enum class Ending : uint8_t { Ran, NoVulkan, Refused };

struct RunHead {
    Ending ending;
    uint32_t text_bytes, results, unsupported;
};

template <class T>
void append(std::vector<std::byte>& bytes, std::span<const T> values) {
    const auto added = std::as_bytes(values);
    bytes.insert(bytes.end(), added.begin(), added.end());
}

std::vector<std::byte> packed(Ending ending, const std::string& text, const PortRun& run = {}) {
    const RunHead head{ending, uint32_t(text.size()), uint32_t(run.results.size()), uint32_t(run.unsupported.size())};
    std::vector<std::byte> bytes;
    append(bytes, std::span(&head, 1));
    append(bytes, std::span<const char>(text));
    append(bytes, std::span<const PortResult>(run.results));
    append(bytes, std::span<const uint32_t>(run.unsupported));
    return bytes;
}

/// Throws what was thrown.
PortRun unpacked(std::span<const std::byte> bytes) {
    const auto take = [&](void* to, size_t count) {
        assert(count <= bytes.size());
        if (count > 0) std::memcpy(to, bytes.data(), count);
        bytes = bytes.subspan(count);
    };
    RunHead head;
    take(&head, sizeof(head));
    std::string text(head.text_bytes, '\0');
    take(text.data(), text.size());
    if (head.ending == Ending::NoVulkan) throw NoVulkan(text);
    if (head.ending == Ending::Refused) throw scenes::InputError(text);
    PortRun run{text, std::vector<PortResult>(head.results), std::vector<uint32_t>(head.unsupported)};
    take(run.results.data(), run.results.size() * sizeof(PortResult));
    take(run.unsupported.data(), run.unsupported.size() * sizeof(uint32_t));
    return run;
}

constexpr std::chrono::minutes kPatience{10};  ///< for all dispatches of a suite; each by itself may take a minute

}  // namespace

PortRun run_port(const Suite& suite, const SpirvModule& module, const std::string& path, const std::string& name) {
    const ChildOutcome outcome = run_in_child(
        [&] {
            try {
                const PortRun run = dispatch_port(suite, module, path, name);
                return packed(Ending::Ran, run.device, run);
            } catch (const NoVulkan& missing) {
                return packed(Ending::NoVulkan, missing.what());
            } catch (const std::exception& error) {
                return packed(Ending::Refused, error.what());
            }
        },
        kPatience);
    if (outcome.end == ChildOutcome::End::Died)
        throw scenes::InputError(path + ": the driver crashed on it (signal " + std::to_string(outcome.signal) +
                                 "); spirv-val tells whether it is damaged");
    if (outcome.end == ChildOutcome::End::Hung)
        throw scenes::InputError(path + ": no answer within " + std::to_string(kPatience.count()) + " minutes");
    return unpacked(outcome.bytes);
}

}  // namespace rawtexel::cli
#endif
