// A stranger's program: samples a checker through the installed texture unit, without the rest of rawtexel.
#include "texunit/memory_source.h"
#include "texunit/sample.h"
#include "texunit/texture.h"

#include <cstdio>
#include <memory>
#include <vector>

using namespace rawtexel::texunit;

int main() {
    std::vector<std::byte> texels(2 * 2 * 4, std::byte{255});
    texels[0] = texels[12] = std::byte{0};  // red is 0 at (0,0) and (1,1), 1 elsewhere
    Texture texture("checker", make_memory_source(Format::RGBA8Unorm, 2, 2, std::move(texels)));
    auto at = std::make_unique<WaveCoordinates>();
    for (int i = 0; i < kWaveLanes; ++i) at->u[i] = at->v[i] = 0.5f;
    WaveColor color;
    sample_wave(texture, SamplerState{}, *at, kWaveFull, color);
    for (int i = 0; i < kWaveLanes; ++i) {
        if (color.channel[0][i] != 0.5f || color.channel[3][i] != 1.0f) {
            std::printf("lane %d: red %g, alpha %g\n", i, double(color.channel[0][i]), double(color.channel[3][i]));
            return 1;
        }
    }
    return 0;
}
