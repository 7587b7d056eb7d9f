#include "tests/texunit/gl_context.h"

#include <dlfcn.h>

#include <cstdint>

namespace rawtexel::texunit {
namespace {

// From the Khronos registry (egl.xml): nothing of EGL need be installed to build.
constexpr unsigned kSurfacelessMesa = 0x31DD, kOpenGlApi = 0x30A2;
constexpr int kMajor = 0x3098, kMinor = 0x30FB, kProfile = 0x30FD, kCore = 1, kNone = 0x3038;

}  // namespace

std::unique_ptr<GlContext> GlContext::make(int major, int minor, std::string& why_not) {
    std::unique_ptr<GlContext> context(new GlContext);
    why_not = context->open_display();
    if (why_not.empty()) why_not = context->make_current(major, minor);
    if (!why_not.empty()) return nullptr;
    return context;
}

GlContext::~GlContext() {
    if (context_) make_current_(display_, nullptr, nullptr, nullptr), destroy_context_(display_, context_);
    if (display_) terminate_(display_);
    // The library stays: drivers keep threads and exit handlers of their own.
}

std::string GlContext::open_display() {
    void* const library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!library) return "libEGL.so.1 is not installed";
    get_proc_ = reinterpret_cast<decltype(get_proc_)>(dlsym(library, "eglGetProcAddress"));
    if (!get_proc_) return "libEGL.so.1 has no eglGetProcAddress";
    void* (*platform_display)(unsigned, void*, const intptr_t*) = nullptr;
    unsigned (*initialize)(void*, int*, int*) = nullptr;
    if (!find(platform_display, "eglGetPlatformDisplayEXT") || !find(initialize, "eglInitialize") || !find(terminate_, "eglTerminate"))
        return "EGL lacks platform displays";
    void* const opened = platform_display(kSurfacelessMesa, nullptr, nullptr);
    if (!opened || !initialize(opened, nullptr, nullptr)) return "EGL has no surfaceless Mesa display";
    display_ = opened;
    return "";
}

std::string GlContext::make_current(int major, int minor) {
    unsigned (*bind_api)(unsigned) = nullptr;
    void* (*create_context)(void*, void*, void*, const int*) = nullptr;
    if (!find(bind_api, "eglBindAPI") || !find(create_context, "eglCreateContext") || !find(make_current_, "eglMakeCurrent") ||
        !find(destroy_context_, "eglDestroyContext"))
        return "EGL lacks contexts";
    bind_api(kOpenGlApi);
    const int attributes[] = {kMajor, major, kMinor, minor, kProfile, kCore, kNone};
    context_ = create_context(display_, nullptr, nullptr, attributes);
    if (!context_) return "EGL makes no OpenGL " + std::to_string(major) + '.' + std::to_string(minor) + " core context";
    return make_current_(display_, nullptr, nullptr, context_) ? "" : "the context needs a surface";
}

}  // namespace rawtexel::texunit
