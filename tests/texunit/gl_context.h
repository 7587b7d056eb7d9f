// An OpenGL context without a window, from whatever EGL library is installed, loaded at run time.
#pragma once

#include <memory>
#include <string>

namespace rawtexel::texunit {

/// Surfaceless and of the core profile; current in the thread that made it, for as long as it lives. One at a time.
class GlContext {
  public:
    /// Null when there is none of this version, with the reason.
    static std::unique_ptr<GlContext> make(int major, int minor, std::string& why_not);
    ~GlContext();
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

    /// The function of that name; false where there is none.
    template <class Function>
    bool find(Function& function, const char* name) const {
        function = reinterpret_cast<Function>(get_proc_(name));
        return function != nullptr;
    }

  private:
    GlContext() = default;
    std::string open_display();
    std::string make_current(int major, int minor);

    void* (*get_proc_)(const char*) = nullptr;
    void* display_ = nullptr;
    void* context_ = nullptr;
    unsigned (*destroy_context_)(void* display, void* context) = nullptr;
    unsigned (*make_current_)(void* display, void* draw, void* read, void* context) = nullptr;
    unsigned (*terminate_)(void* display) = nullptr;
};

}  // namespace rawtexel::texunit
