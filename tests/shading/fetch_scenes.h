// Frames whose fetches are counted: a busy one, and stacks of quads.
#pragma once

#include "shading/render.h"

#include "tests/shading/executor_kinds.h"
#include "tests/shading/scene_parts.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace rawtexel::shading::test {

class FetchesTest : public testing::Test {
  protected:
    RenderResult render_with(const RenderOptions& options, ExecutorKind kind = ExecutorKind::Threads, int threads = 1) const {
        const std::unique_ptr<Executor> executor = make_executor(kind, threads);
        return render(scene_, lighting_, options, *executor);
    }
    static RenderOptions busy_options() {
        RenderOptions options;
        options.width = 165;
        options.height = 101;
        options.camera = busy_camera();
        options.spp = 2;
        options.fetches.count = true;
        return options;
    }

    std::unique_ptr<Executor> one_ = make_executor(ExecutorKind::Threads, 1);
    Scene scene_ = make_busy_scene();
    Lighting lighting_ = busy_lighting(scene_, *one_);
};

/// A stack of full-frame quads, the first the nearest, of 64x64 pixels.
class StackTest : public testing::Test {
  protected:
    StackTest() {
        options_.width = options_.height = 64;
        options_.camera = square_camera();
        options_.fetches.count = true;
    }
    /// Adds a quad at height z with a texture whose alpha is everywhere `alpha`.
    void add(float z, AlphaMode mode, float alpha = 1.0f) {
        scene_.textures.push_back(make_texture(8, 8, [alpha](int, int) { return glm::vec4(0.5f, 0.5f, 0.5f, alpha); }));
        Material material = unlit(glm::vec4(1.0f), mode);
        material.maps[kBaseColor].texture = int(scene_.textures.size()) - 1;
        add_object(scene_, make_quad({-1, -1, z}, {2, 0, 0}, {0, 2, 0}), material);
    }
    /// Lookups per pixel of every quad.
    std::vector<double> lookups(FetchModel model) {
        options_.fetches.model = model;
        const RenderResult result = render(scene_, Lighting{}, options_, *executor_);
        std::vector<double> per_pixel;
        for (const texunit::FetchCounts& counts : result.fetches->counts) per_pixel.push_back(double(counts.lookups) / (64 * 64));
        return per_pixel;
    }

    std::unique_ptr<Executor> executor_ = make_executor(ExecutorKind::Threads, 1);
    Scene scene_;
    RenderOptions options_;
};

}  // namespace rawtexel::shading::test
