// A small fuzzer for compilers without one: damages the seed files for a few seconds times RAWTEXEL_STRESS. Every fourth input is kept to
// be damaged further. An input that ends the program is left in the working folder as crash-input.
#include "tests/stress_scale.h"
#include "tests/texunit/container_damage.h"

#include <fcntl.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <random>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace {

using rawtexel::texunit::test_files::Bytes;

constexpr int kSeconds = 3;
constexpr size_t kMostKept = 4096, kMostBytes = 1 << 16;

const uint8_t* current = nullptr;
size_t current_bytes = 0;

extern "C" void keep_input(int signal) {
    const int file = open("crash-input", O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (file >= 0 && write(file, current, current_bytes) >= 0) close(file);
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

}  // namespace

int main() {
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM}) std::signal(signal, keep_input);
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::seconds(kSeconds * rawtexel::stress_scale());
    std::vector<Bytes> inputs = rawtexel::texunit::test_files::seed_files();
    std::mt19937_64 random(std::random_device{}());
    uint64_t runs = 0;
    for (; Clock::now() < end; ++runs) {
        Bytes input = inputs[random() % inputs.size()];
        rawtexel::texunit::test_files::damage(input, random);
        current = reinterpret_cast<const uint8_t*>(input.data());
        current_bytes = input.size();
        alarm(20);  // one input that takes so long hangs
        LLVMFuzzerTestOneInput(current, current_bytes);
        if (runs % 4 == 0 && input.size() <= kMostBytes) {
            if (inputs.size() < kMostKept)
                inputs.push_back(std::move(input));
            else
                inputs[12 + random() % (kMostKept - 12)] = std::move(input);
        }
    }
    std::printf("%llu inputs\n", static_cast<unsigned long long>(runs));
    return 0;
}
