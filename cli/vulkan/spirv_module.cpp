#include "cli/vulkan/spirv_module.h"

#include "scenes/image_io.h"

#include <cstring>

namespace rawtexel::cli {
namespace {

// Numbers of the SPIR-V specification, sections 2.3 and 3.
constexpr uint32_t kMagic = 0x07230203, kEntryPoint = 15, kExecutionMode = 16, kDecorate = 71;
constexpr uint32_t kComputeModel = 5, kLocalSizeMode = 17, kBindingDecoration = 33, kSetDecoration = 34;
constexpr size_t kHeaderWords = 5;

[[noreturn]] void fail(const std::string& path, const std::string& what) { throw scenes::InputError(path + ": " + what); }

}  // namespace

SpirvModule parse_spirv(const std::string& path, std::span<const std::byte> bytes) {
    if (bytes.size() % 4 != 0 || bytes.size() < 4 * kHeaderWords)
        fail(path, "not SPIR-V (its size is no whole number of words, at least 5)");
    SpirvModule module;
    module.words.resize(bytes.size() / 4);
    std::memcpy(module.words.data(), bytes.data(), bytes.size());
    const std::vector<uint32_t>& words = module.words;
    if (words[0] != kMagic) fail(path, "not SPIR-V (it does not begin with the magic number 0x07230203)");
    int entries = 0;
    for (size_t at = kHeaderWords; at < words.size();) {
        const uint32_t op = words[at] & 0xFFFF, length = words[at] >> 16;
        if (length == 0 || length > words.size() - at)
            fail(path, "not SPIR-V (an instruction of " + std::to_string(length) + " words at word " + std::to_string(at) + ")");
        const auto operand = [&](uint32_t n) { return n < length ? words[at + n] : 0; };
        if (op == kEntryPoint && operand(1) == kComputeModel) {
            ++entries;
            const auto* const text = reinterpret_cast<const char*>(words.data() + at + 3);
            module.entry_point.assign(text, strnlen(text, length > 3 ? 4 * (length - 3) : 0));
        } else if (op == kExecutionMode && operand(2) == kLocalSizeMode) {
            module.group_size = operand(3);
            if (operand(3) == 0 || operand(4) != 1 || operand(5) != 1)
                fail(path, "its workgroup is " + std::to_string(operand(3)) + "x" + std::to_string(operand(4)) + "x" +
                               std::to_string(operand(5)) + " (allowed: Nx1x1)");
        } else if (op == kDecorate && operand(2) == kBindingDecoration) {
            module.bindings.insert(operand(3));
        } else if (op == kDecorate && operand(2) == kSetDecoration && operand(3) != 0) {
            fail(path, "it uses descriptor set " + std::to_string(operand(3)) + " (allowed: 0)");
        }
        at += length;
    }
    if (entries != 1) fail(path, "it has " + std::to_string(entries) + " compute shaders (allowed: one)");
    for (const uint32_t binding : module.bindings) {
        if (binding >= kBindings)
            fail(path, "it uses binding " + std::to_string(binding) + " (allowed: 0 to " + std::to_string(kBindings - 1) + ")");
    }
    return module;
}

}  // namespace rawtexel::cli
