#include "tests/benchmarks/tools/peer_lookup.h"
#include "tests/texunit/gl_context.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

#include <cstdlib>
#include <stdexcept>
#include <utility>

namespace rawtexel::tools {
namespace {

constexpr GLenum kMaxAnisotropy = 0x84FE;  ///< GL_TEXTURE_MAX_ANISOTROPY

/// Every lookup is a block of this many pixels a side, for llvmpipe takes one footprint for the lanes of a vector, by their differences.
constexpr int kBlock = 4;
constexpr int kColumns = 64;  ///< blocks a row

/// Half of the viewport, which is four times as large as the target: a triangle that needs no clipping has no edge within the target, where
/// pixels outside would lend their differences without having read their lookups.
constexpr const char* kVertexShader = R"(#version 430
void main() { gl_Position = vec4(gl_VertexID == 1 ? 1 : -1, gl_VertexID == 2 ? 1 : -1, 0, 1); })";
constexpr int kViewportScale = 4;

constexpr const char* kFragmentShader = R"(#version 430
struct Lookup { vec2 uv, ddx, ddy; };
layout(std430, binding = 0) readonly buffer Lookups { Lookup lookups[]; };
layout(binding = 0) uniform sampler2D image;
layout(location = 0) out float value;
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy), block = pixel / 4;
    Lookup at = lookups[min(block.y * 64 + block.x, lookups.length() - 1)];
    value = texture(image, at.uv + float(pixel.x & 1) * at.ddx + float(pixel.y & 1) * at.ddy).r;
})";

GLuint compile() {
    const GLuint program = glCreateProgram();
    for (const auto& [kind, source] : {std::pair{GL_VERTEX_SHADER, kVertexShader}, {GL_FRAGMENT_SHADER, kFragmentShader}}) {
        const GLuint shader = glCreateShader(GLenum(kind));
        glShaderSource(shader, 1, &source, nullptr);
        glCompileShader(shader);
        glAttachShader(program, shader);
    }
    glLinkProgram(program);
    GLint linked = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked == 0) throw std::runtime_error("the lookup shaders do not compile");
    return program;
}

class OpenglSampler final : public PeerSampler {
  public:
    OpenglSampler(std::unique_ptr<texunit::GlContext> context, const Pyramid& pyramid, int probes)
        : context_(std::move(context)), program_(compile()) {
        GLuint texture = 0;
        glGenTextures(1, &texture);
        glBindTexture(GL_TEXTURE_2D, texture);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        for (size_t level = 0; level < pyramid.level.size(); ++level) {
            const int extent = pyramid.extent >> level;
            // Floats, so that filtering is not quantised.
            const std::vector<float> texels(pyramid.level[level].begin(), pyramid.level[level].end());
            glTexImage2D(GL_TEXTURE_2D, GLint(level), GL_R32F, extent, extent, 0, GL_RED, GL_FLOAT, texels.data());
        }
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        glTexParameterf(GL_TEXTURE_2D, kMaxAnisotropy, float(probes));
    }

    std::string name() const override {
        // "llvmpipe (LLVM …)" and "4.5 (Core Profile) Mesa …": the words that name them.
        const std::string renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
        const std::string version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
        const size_t mesa = version.find("Mesa");
        return renderer.substr(0, renderer.find(" (")) + ", " + (mesa == std::string::npos ? version : version.substr(mesa));
    }

    std::vector<double> look_up(const std::vector<texunit::reference::Lookup>& lookups, double scale) override {
        std::vector<float> packed;
        for (const texunit::reference::Lookup& at : lookups) {
            packed.insert(packed.end(), {at.u, at.v});
            for (const float derivative : {at.dudx, at.dvdx, at.dudy, at.dvdy}) packed.push_back(float(double(derivative) * scale));
        }
        const int rows = (int(lookups.size()) + kColumns - 1) / kColumns;
        const std::vector<float> pixels = draw(packed, kColumns * kBlock, rows * kBlock);
        std::vector<double> values;
        for (int i = 0; i < int(lookups.size()); ++i) {
            const int x = i % kColumns * kBlock, y = i / kColumns * kBlock;
            values.push_back(double(pixels[size_t(y * kColumns * kBlock + x)]) / 65535);
        }
        return values;
    }

  private:
    std::vector<float> draw(const std::vector<float>& lookups, int width, int height) {
        GLuint buffer = 0, target = 0, framebuffer = 0, vertices = 0;
        glGenBuffers(1, &buffer);
        glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffer);
        glBufferData(GL_SHADER_STORAGE_BUFFER, GLsizeiptr(lookups.size() * sizeof(float)), lookups.data(), GL_STATIC_DRAW);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer);
        glGenRenderbuffers(1, &target);
        glBindRenderbuffer(GL_RENDERBUFFER, target);
        glRenderbufferStorage(GL_RENDERBUFFER, GL_R32F, width, height);
        glGenFramebuffers(1, &framebuffer);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, target);
        glGenVertexArrays(1, &vertices);
        glBindVertexArray(vertices);
        glViewport(0, 0, width * kViewportScale, height * kViewportScale);
        glUseProgram(program_);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        std::vector<float> pixels(size_t(width) * size_t(height));
        glReadPixels(0, 0, width, height, GL_RED, GL_FLOAT, pixels.data());
        glDeleteVertexArrays(1, &vertices);
        glDeleteFramebuffers(1, &framebuffer);
        glDeleteRenderbuffers(1, &target);
        glDeleteBuffers(1, &buffer);
        if (glGetError() != GL_NO_ERROR) throw std::runtime_error("OpenGL refused the lookups");
        return pixels;
    }

    std::unique_ptr<texunit::GlContext> context_;
    GLuint program_;
};

}  // namespace

std::unique_ptr<PeerSampler> make_opengl_sampler(const Pyramid& pyramid, int probes) {
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    std::string why_not;
    auto context = texunit::GlContext::make(4, 3, why_not);
    if (!context) return nullptr;
    return std::make_unique<OpenglSampler>(std::move(context), pyramid, probes);
}

}  // namespace rawtexel::tools
