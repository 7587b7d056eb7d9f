#include "tests/texunit/headless_gl.h"

#include <dlfcn.h>

#include <utility>

namespace rawtexel::texunit {
namespace {

// From the Khronos registries (egl.xml and gl.xml): nothing of OpenGL need be installed to build the tests.
namespace egl {
using Display = void*;
using Context = void*;
constexpr unsigned kSurfacelessMesa = 0x31DD, kOpenGlApi = 0x30A2;
constexpr int kMajor = 0x3098, kMinor = 0x30FB, kProfile = 0x30FD, kCore = 1, kNone = 0x3038;
}  // namespace egl

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
    void* library = nullptr;
    egl::Display display = nullptr;
    egl::Context context = nullptr;

    void* (*get_proc)(const char*) = nullptr;
    unsigned (*destroy_context)(egl::Display, egl::Context) = nullptr;
    unsigned (*make_current)(egl::Display, void*, void*, egl::Context) = nullptr;
    unsigned (*terminate)(egl::Display) = nullptr;

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

    ~Functions() {
        if (context) make_current(display, nullptr, nullptr, nullptr), destroy_context(display, context);
        if (display) terminate(display);
        // The library stays: drivers keep threads and exit handlers of their own.
    }

    template <class Function>
    bool find(Function& function, const char* name) {
        function = reinterpret_cast<Function>(get_proc(name));
        return function != nullptr;
    }

    std::string open_display();
    std::string make_context();
    bool find_all();
    bool use_fetching_program();
};

std::string HeadlessGl::Functions::open_display() {
    library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!library) return "libEGL.so.1 is not installed";
    get_proc = reinterpret_cast<decltype(get_proc)>(dlsym(library, "eglGetProcAddress"));
    if (!get_proc) return "libEGL.so.1 has no eglGetProcAddress";
    egl::Display (*platform_display)(unsigned, void*, const intptr_t*) = nullptr;
    unsigned (*initialize)(egl::Display, int*, int*) = nullptr;
    if (!find(platform_display, "eglGetPlatformDisplayEXT") || !find(initialize, "eglInitialize") || !find(terminate, "eglTerminate"))
        return "EGL lacks platform displays";
    egl::Display opened = platform_display(egl::kSurfacelessMesa, nullptr, nullptr);
    if (!opened || !initialize(opened, nullptr, nullptr)) return "EGL has no surfaceless Mesa display";
    display = opened;
    return "";
}

std::string HeadlessGl::Functions::make_context() {
    unsigned (*bind_api)(unsigned) = nullptr;
    egl::Context (*create_context)(egl::Display, void*, egl::Context, const int*) = nullptr;
    if (!find(bind_api, "eglBindAPI") || !find(create_context, "eglCreateContext") || !find(make_current, "eglMakeCurrent") ||
        !find(destroy_context, "eglDestroyContext"))
        return "EGL lacks contexts";
    bind_api(egl::kOpenGlApi);
    const int attributes[] = {egl::kMajor, 3, egl::kMinor, 3, egl::kProfile, egl::kCore, egl::kNone};
    context = create_context(display, nullptr, nullptr, attributes);
    if (!context) return "EGL makes no OpenGL 3.3 core context";
    return make_current(display, nullptr, nullptr, context) ? "" : "the context needs a surface";
}

bool HeadlessGl::Functions::find_all() {
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
    why_not = functions->open_display();
    if (why_not.empty()) why_not = functions->make_context();
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
