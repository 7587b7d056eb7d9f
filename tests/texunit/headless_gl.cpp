#include "tests/texunit/headless_gl.h"

#include "tests/texunit/gl_context.h"

#include <utility>

namespace rawtexel::texunit {
namespace {

// From the Khronos registry (gl.xml): nothing of OpenGL need be installed to build the tests.
constexpr unsigned kTexture2D = 0x0DE1, kMinFilter = 0x2801, kMagFilter = 0x2800, kMaxLevel = 0x813D, kNearest = 0x2600;
constexpr unsigned kRenderbuffer = 0x8D41, kFramebuffer = 0x8D40, kColour0 = 0x8CE0, kComplete = 0x8CD5;
constexpr unsigned kRgba = 0x1908, kRgba32f = 0x8814, kFloat = 0x1406, kTriangles = 4, kRenderer = 0x1F01, kNoError = 0;
constexpr unsigned kVertexShader = 0x8B31, kFragmentShader = 0x8B30, kLinkStatus = 0x8B82;

/// One triangle that covers everything.
constexpr const char* kVertexSource =
    "#version 330\n"
    "void main() { gl_Position = vec4(vec2(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1), 0, 1); }\n";
constexpr const char* kFragmentSource =
    "#version 330\n"
    "uniform sampler2D image; out vec4 value;\n"
    "void main() { value = texelFetch(image, ivec2(gl_FragCoord.xy), 0); }\n";

}  // namespace

struct HeadlessGl::Functions {
    std::unique_ptr<GlContext> context;

    const unsigned char* (*get_string)(unsigned) = nullptr;
    unsigned (*get_error)() = nullptr;
    void (*gen_textures)(int, unsigned*) = nullptr;
    void (*bind_texture)(unsigned, unsigned) = nullptr;
    void (*delete_textures)(int, const unsigned*) = nullptr;
    void (*tex_parameter)(unsigned, unsigned, int) = nullptr;
    void (*compressed_image)(unsigned, int, unsigned, int, int, int, int, const void*) = nullptr;
    void (*gen_renderbuffers)(int, unsigned*) = nullptr;
    void (*bind_renderbuffer)(unsigned, unsigned) = nullptr;
    void (*delete_renderbuffers)(int, const unsigned*) = nullptr;
    void (*renderbuffer_storage)(unsigned, unsigned, int, int) = nullptr;
    void (*gen_framebuffers)(int, unsigned*) = nullptr;
    void (*bind_framebuffer)(unsigned, unsigned) = nullptr;
    void (*delete_framebuffers)(int, const unsigned*) = nullptr;
    void (*attach_renderbuffer)(unsigned, unsigned, unsigned, unsigned) = nullptr;
    unsigned (*framebuffer_status)(unsigned) = nullptr;
    void (*gen_vertex_arrays)(int, unsigned*) = nullptr;
    void (*bind_vertex_array)(unsigned) = nullptr;
    unsigned (*create_shader)(unsigned) = nullptr;
    void (*shader_source)(unsigned, int, const char* const*, const int*) = nullptr;
    void (*compile_shader)(unsigned) = nullptr;
    unsigned (*create_program)() = nullptr;
    void (*attach_shader)(unsigned, unsigned) = nullptr;
    void (*link_program)(unsigned) = nullptr;
    void (*program_status)(unsigned, unsigned, int*) = nullptr;
    void (*use_program)(unsigned) = nullptr;
    void (*viewport)(int, int, int, int) = nullptr;
    void (*draw_arrays)(unsigned, int, int) = nullptr;
    void (*read_pixels)(int, int, int, int, unsigned, unsigned, void*) = nullptr;

    bool find_all();
    bool use_fetching_program();
};

bool HeadlessGl::Functions::find_all() {
    const auto find = [this](auto& function, const char* name) { return context->find(function, name); };
    return find(get_string, "glGetString") && find(get_error, "glGetError") && find(gen_textures, "glGenTextures") &&
           find(bind_texture, "glBindTexture") && find(delete_textures, "glDeleteTextures") && find(tex_parameter, "glTexParameteri") &&
           find(compressed_image, "glCompressedTexImage2D") && find(gen_renderbuffers, "glGenRenderbuffers") &&
           find(bind_renderbuffer, "glBindRenderbuffer") && find(delete_renderbuffers, "glDeleteRenderbuffers") &&
           find(renderbuffer_storage, "glRenderbufferStorage") && find(gen_framebuffers, "glGenFramebuffers") &&
           find(bind_framebuffer, "glBindFramebuffer") && find(delete_framebuffers, "glDeleteFramebuffers") &&
           find(attach_renderbuffer, "glFramebufferRenderbuffer") && find(framebuffer_status, "glCheckFramebufferStatus") &&
           find(gen_vertex_arrays, "glGenVertexArrays") && find(bind_vertex_array, "glBindVertexArray") &&
           find(create_shader, "glCreateShader") && find(shader_source, "glShaderSource") && find(compile_shader, "glCompileShader") &&
           find(create_program, "glCreateProgram") && find(attach_shader, "glAttachShader") && find(link_program, "glLinkProgram") &&
           find(program_status, "glGetProgramiv") && find(use_program, "glUseProgram") && find(viewport, "glViewport") &&
           find(draw_arrays, "glDrawArrays") && find(read_pixels, "glReadPixels");
}

bool HeadlessGl::Functions::use_fetching_program() {
    const unsigned program = create_program();
    for (const auto& [kind, source] : {std::pair{kVertexShader, kVertexSource}, {kFragmentShader, kFragmentSource}}) {
        const unsigned shader = create_shader(kind);
        shader_source(shader, 1, &source, nullptr);
        compile_shader(shader);
        attach_shader(program, shader);
    }
    link_program(program);
    int linked = 0;
    program_status(program, kLinkStatus, &linked);
    use_program(program);
    unsigned vertex_array = 0;
    gen_vertex_arrays(1, &vertex_array);
    bind_vertex_array(vertex_array);
    return linked != 0;
}

HeadlessGl::HeadlessGl(std::unique_ptr<Functions> functions) : gl_(std::move(functions)) {}
HeadlessGl::~HeadlessGl() = default;

std::unique_ptr<HeadlessGl> HeadlessGl::make(std::string& why_not) {
    auto functions = std::make_unique<Functions>();
    functions->context = GlContext::make(3, 3, why_not);
    if (why_not.empty() && !functions->find_all()) why_not = "OpenGL lacks functions of version 3.3";
    if (why_not.empty() && !functions->use_fetching_program()) why_not = "OpenGL links no program";
    if (!why_not.empty()) return nullptr;
    return std::unique_ptr<HeadlessGl>(new HeadlessGl(std::move(functions)));
}

std::string HeadlessGl::renderer() const { return reinterpret_cast<const char*>(gl_->get_string(kRenderer)); }

std::vector<float> HeadlessGl::texels(uint32_t internal_format, int width, int height, std::span<const std::byte> blocks) {
    unsigned texture = 0, target = 0, frame = 0;
    gl_->gen_textures(1, &texture);
    gl_->bind_texture(kTexture2D, texture);
    gl_->tex_parameter(kTexture2D, kMinFilter, int(kNearest));
    gl_->tex_parameter(kTexture2D, kMagFilter, int(kNearest));
    gl_->tex_parameter(kTexture2D, kMaxLevel, 0);
    gl_->compressed_image(kTexture2D, 0, internal_format, width, height, 0, int(blocks.size()), blocks.data());

    gl_->gen_renderbuffers(1, &target);
    gl_->bind_renderbuffer(kRenderbuffer, target);
    gl_->renderbuffer_storage(kRenderbuffer, kRgba32f, width, height);
    gl_->gen_framebuffers(1, &frame);
    gl_->bind_framebuffer(kFramebuffer, frame);
    gl_->attach_renderbuffer(kFramebuffer, kColour0, kRenderbuffer, target);

    std::vector<float> values;
    if (gl_->framebuffer_status(kFramebuffer) == kComplete) {
        values.resize(size_t(width) * size_t(height) * 4);
        gl_->viewport(0, 0, width, height);
        gl_->draw_arrays(kTriangles, 0, 3);
        gl_->read_pixels(0, 0, width, height, kRgba, kFloat, values.data());
    }
    if (gl_->get_error() != kNoError) values.clear();
    gl_->delete_framebuffers(1, &frame);
    gl_->delete_renderbuffers(1, &target);
    gl_->delete_textures(1, &texture);
    return values;
}

}  // namespace rawtexel::texunit
