// Whether ports can be run here, and where they are.
#pragma once

#include <string>

namespace rawtexel::test {

/// "" or why no port can be run: no Vulkan device, no glslangValidator, a build with sanitizers. Lets Mesa's drivers compile shaders
/// without optimising them, which takes longer than to run them once.
std::string why_no_ports();

/// Lets lavapipe compile for narrow vectors, in half the time: for tests that compile many shaders, each for one run.
void compile_for_narrow_vectors();

/// Skips with the reason; where RAWTEXEL_REQUIRE_VULKAN is set, as in continuous integration, fails instead.
#define RAWTEXEL_NEED_PORTS()                                                                         \
    do {                                                                                              \
        const std::string why_not = rawtexel::test::why_no_ports();                                   \
        if (!why_not.empty() && std::getenv("RAWTEXEL_REQUIRE_VULKAN") != nullptr) FAIL() << why_not; \
        if (!why_not.empty()) GTEST_SKIP() << why_not;                                                \
    } while (false)

/// The port of a suite.
inline std::string port_of(const std::string& suite) { return std::string(RAWTEXEL_SHADERS) + "/glsl/" + suite + ".comp"; }

}  // namespace rawtexel::test
