// Affine shading: converged renders against the double-precision reference renderer.
#include "tests/reference/shading/unlit_reference.h"
#include "tests/stress/worst_case.h"

#include "frame_bits.h"
#include "scene_parts.h"
#include "shading/camera.h"
#include "shading/render.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace rawtexel::shading {
namespace {

using namespace test;

struct Difference {
    double worst = 0;
    int x = 0, y = 0;
};

/// The largest difference between the render and the reference's mean over the same sample points.
Difference compare(const Scene& scene, const RenderOptions& options) {
    const std::unique_ptr<Executor> executor = make_executor(ExecutorKind::Threads, 1);
    const Image image = render(scene, Lighting{}, options, *executor).radiance;
    const glm::dvec3 background(options.background.value_or(glm::vec3(0.0f)));
    Difference difference;
    for (int y = 0; y < options.height; ++y) {
        for (int x = 0; x < options.width; ++x) {
            glm::dvec3 sum(0.0);
            for (int sample = 0; sample < options.spp; ++sample) {
                const raster::SampleOffset at =
                    sample_offset(options.pixel_filter, options.pixel_jitter, uint32_t(sample), uint32_t(x), uint32_t(y), options.seed);
                sum += reference::unlit_radiance(scene, options.camera, options.width, options.height,
                                                 x + double(at.x) / raster::kSampleOne, y + double(at.y) / raster::kSampleOne, background);
            }
            for (int c = 0; c < 3; ++c) {
                const double error = std::abs(sum[c] / options.spp - double(image.pixel(x, y)[c]));
                if (error > difference.worst) difference = {error, x, y};
            }
        }
    }
    return difference;
}

void expect_close(const Scene& scene, const RenderOptions& options, const std::string& what) {
    const Difference difference = compare(scene, options);
    EXPECT_LT(difference.worst, 1e-5) << what << " at pixel " << difference.x << "," << difference.y;
    tell_worst_case(what, difference.worst);
}

RenderOptions converged() {
    RenderOptions options;
    options.width = 24;
    options.height = 16;
    options.spp = 256;
    options.background = glm::vec3(0.25f, 0.5f, 0.125f);
    return options;
}

/// A textured floor that fills the frame in perspective, its texels from magnified to minified about four times.
Scene make_floor(const texunit::SamplerState& sampler) {
    Scene scene;
    scene.textures = {make_noise_texture(32, 24, 9)};
    Material material = unlit({0.9f, 0.8f, 1.0f, 1.0f});
    material.maps[kBaseColor].texture = 0;
    material.maps[kBaseColor].sampler = sampler;
    material.maps[kBaseColor].uv_from_vertex = {1.0f, 0.25f, -0.125f, 0.75f, 0.3f, -0.2f};
    add_object(scene, make_quad({-40, 0, 10}, {80, 0, 0}, {0, 0, -80}, {8, 8}), material);
    return scene;
}

Camera floor_camera() { return look_at_camera({{-2, 0, -2}, {2, 1, 2}}, {0.2f, 1.5f, 3.0f}, {-0.3f, 0.0f, 0.5f}, 40.0f); }

TEST(UnlitRender, EqualsTheReferenceInPerspective) {
    RenderOptions options = converged();
    options.camera = floor_camera();
    using texunit::Kernel, texunit::MipMode, texunit::Wrap;
    expect_close(make_floor({}), options, "trilinear, repeated");
    expect_close(make_floor({.wrap_s = Wrap::MirroredRepeat, .wrap_t = Wrap::MirroredRepeat, .mip = MipMode::None}), options,
                 "bilinear, mirrored");
    expect_close(make_floor({.wrap_s = Wrap::ClampToEdge, .wrap_t = Wrap::Repeat}), options, "trilinear, clamped across");
}

TEST(UnlitRender, EqualsTheReferenceWithEveryPixelFilterAndJitter) {
    RenderOptions options = converged();
    options.spp = 64;
    options.camera = floor_camera();
    for (const PixelFilter filter : {PixelFilter::Box, PixelFilter::Tent, PixelFilter::Gaussian}) {
        for (const PixelJitter jitter : {PixelJitter::Frame, PixelJitter::Pixel}) {
            options.pixel_filter = filter;
            options.pixel_jitter = jitter;
            expect_close(make_floor({}), options, std::string(to_string(filter)) + " " + std::string(to_string(jitter)));
        }
    }
}

/// Silhouettes whose corners lie on the 1/256 pixel grid are exact (and these pass through no sample point); the upper triangle hides
/// part of the lower one.
TEST(UnlitRender, EqualsTheReferenceOnSilhouettes) {
    RenderOptions options = converged();
    options.width = options.height = 32;
    options.camera = square_camera();
    Scene scene;
    const auto triangle = [](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        Mesh mesh;
        for (const glm::vec3& pixels : {a, b, c}) mesh.positions.push_back({pixels.x / 16.0f - 1.0f, 1.0f - pixels.y / 16.0f, pixels.z});
        mesh.colors = {{1, 0, 0.5f, 1}, {0, 1, 0.25f, 1}, {0.5f, 0.75f, 1, 1}};
        mesh.indices = {0, 1, 2};
        return mesh;
    };
    add_object(scene, triangle({2.50390625f, 3.28515625f, 0}, {10.74609375f, 30.51171875f, 0}, {29.23828125f, 12.12890625f, 0}),
               unlit(glm::vec4(1.0f)));
    add_object(scene, triangle({20.52734375f, 1.48828125f, 1}, {6.11328125f, 18.62109375f, 1}, {25.55078125f, 27.06640625f, 1}),
               unlit({0.5f, 1.5f, 1, 1}));
    expect_close(scene, options, "two triangles");
}

/// Who asks for layers has everything interpolated; who does not, in blocks that one triangle fills, coordinates alone.
TEST(UnlitRender, IsTheSameWhateverElseIsInterpolated) {
    RenderOptions plain = converged();
    plain.width = 93;
    plain.height = 61;
    plain.spp = 4;
    plain.camera = floor_camera();
    std::map<std::string, RenderOptions> cases;
    cases["plain"] = plain;
    (cases["points of pixels' own"] = plain).pixel_jitter = PixelJitter::Pixel;
    (cases["quads"] = plain).footprint.derivatives = Derivatives::Quad;
    (cases["footprints of samples"] = plain).footprint.area = FootprintArea::Sample;
    (cases["coordinates jittered"] = plain).filtering.texture_jitter = TextureJitter::Affine;
    (cases["drawn texels"] = plain).filtering.estimator = texunit::Estimator::Reservoir;

    const std::unique_ptr<Executor> executor = make_executor(ExecutorKind::Threads, 1);
    const auto image = [&](const Scene& scene, RenderOptions options, std::vector<Aov> aovs) {
        options.aovs = std::move(aovs);
        return render(scene, Lighting{}, options, *executor).radiance;
    };
    for (const auto& [name, options] : cases) {
        for (const bool colored : {false, true}) {
            Scene scene = make_floor({.wrap_s = texunit::Wrap::ClampToEdge, .wrap_t = texunit::Wrap::MirroredRepeat});
            if (colored) scene.meshes[0].colors = {{1, 0, 0.5f, 1}, {0, 1, 0.25f, 1}, {0.5f, 0.75f, 1, 1}, {0.25f, 0.5f, 0, 1}};
            const Image alone = image(scene, options, {});
            EXPECT_TRUE(same_bits(alone, image(scene, options, {Aov::Normal}))) << name << colored;
            EXPECT_TRUE(same_bits(alone, image(scene, options, {Aov::Lod}))) << name << colored;
        }
    }
    Scene untextured = make_floor({});
    untextured.materials[0].maps[kBaseColor].texture = -1;
    EXPECT_TRUE(same_bits(image(untextured, plain, {}), image(untextured, plain, {Aov::Normal})));

    // Vertex colours have the rest interpolated too.
    plain.aovs = {Aov::Normal, Aov::Depth, Aov::Uv};
    Scene white = make_floor({}), colored = make_floor({});
    colored.meshes[0].colors.assign(4, glm::vec4(1.0f));
    const RenderResult of_white = render(white, Lighting{}, plain, *executor), of_colored = render(colored, Lighting{}, plain, *executor);
    for (size_t i = 0; i < plain.aovs.size(); ++i)
        EXPECT_TRUE(same_bits(of_white.layers[i].image, of_colored.layers[i].image)) << of_white.layers[i].name;
}

TEST(UnlitRender, EqualsTheReferenceFarFromTheTextureOrigin) {
    RenderOptions options = converged();
    options.camera = floor_camera();
    Scene scene = make_floor({});
    for (glm::vec2& uv : scene.meshes[0].uv[0]) uv += glm::vec2(4096.0f, -2048.0f);
    // The shear would mix the two shifts' rounding; the plain mapping keeps them.
    scene.materials[0].maps[kBaseColor].uv_from_vertex = {1, 0, 0, 1, 0, 0};
    expect_close(scene, options, "uv shifted by 4096");
}

}  // namespace
}  // namespace rawtexel::shading
