#include "tests/benchmarks/peer/opengl_frame.h"

#include "shading/camera.h"
#include "shading/view_rays.h"
#include "tests/benchmarks/peer/opengl_shaders.h"
#include "tests/texunit/gl_context.h"
#include "texunit/srgb.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

namespace rawtexel::peer {
namespace {

using shading::Image;
using shading::Material;
using shading::Mesh;
using shading::Scene;
using shading::SceneTexture;
using shading::TextureMap;

constexpr GLenum kMaxAnisotropy = 0x84FE;  ///< GL_TEXTURE_MAX_ANISOTROPY
constexpr std::array kMapNames = {"map0", "map1", "map2", "map3", "map4"};
static_assert(kMapNames.size() == shading::kMapSlots);

/// What a program is compiled for.
struct Variant {
    int maps = 0, uv1 = 0;
    bool unlit = false, alpha_test = false, normals = false, tangents = false;
    auto operator<=>(const Variant&) const = default;
};

Variant variant_of(const Material& material, const Mesh& mesh) {
    Variant variant{.unlit = material.unlit,
                    .alpha_test = material.alpha_mode != shading::AlphaMode::Opaque,
                    .normals = !mesh.normals.empty(),
                    .tangents = !mesh.tangents.empty()};
    for (size_t slot = 0; slot < material.maps.size(); ++slot) {
        variant.maps |= int(material.maps[slot].texture >= 0) << slot;
        variant.uv1 |= int(material.maps[slot].uv_set == 1) << slot;
    }
    return variant;
}

GLuint compile(Filter filter, const Variant& variant) {
    const int kind = filter == Filter::Cubic16Taps ? 1 : filter == Filter::CubicOneTap ? 2 : 0;
    const std::string head = "#version 430" + [&] {
        std::string lines;
        for (const auto& [name, value] : {std::pair{"FILTER", kind},
                                          {"MAPS", variant.maps},
                                          {"UV1", variant.uv1},
                                          {"UNLIT", int(variant.unlit)},
                                          {"ALPHA_TEST", int(variant.alpha_test)},
                                          {"NORMALS", int(variant.normals)},
                                          {"TANGENTS", int(variant.tangents)}})
            lines += std::string("\n#define ") + name + ' ' + std::to_string(value);
        return lines + '\n';
    }();
    const GLuint program = glCreateProgram();
    for (const auto& [stage, source] : {std::pair{GL_VERTEX_SHADER, kVertexShader}, {GL_FRAGMENT_SHADER, kFragmentShader}}) {
        const GLuint shader = glCreateShader(GLenum(stage));
        const std::string text = head + source;
        const char* const pointer = text.c_str();
        glShaderSource(shader, 1, &pointer, nullptr);
        glCompileShader(shader);
        GLint compiled = 0;
        glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
        if (compiled == 0) {
            std::array<char, 1024> log{};
            glGetShaderInfoLog(shader, GLsizei(log.size()), nullptr, log.data());
            throw std::runtime_error(std::string("a shader does not compile: ") + log.data());
        }
        glAttachShader(program, shader);
        glDeleteShader(shader);
    }
    glLinkProgram(program);
    GLint linked = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked == 0) throw std::runtime_error("the shaders do not link");
    return program;
}

/// A texture with the levels that ours has, in 8 bits where ours has those.
GLuint upload(const SceneTexture& from) {
    texunit::Texture& texture = *from.texture;
    const bool bytes = from.srgb || texture.texel_layout().storage == texunit::StorageClass::Packed32;
    GLuint name = 0;
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (int level = 0; level < texture.shape().levels; ++level) {
        const int width = texture.levels().width[size_t(level)], height = texture.levels().height[size_t(level)];
        std::vector<float> floats;
        std::vector<uint8_t> codes;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const std::array<float, 4> texel = texture.texel(level, 0, x, y);
                for (size_t c = 0; c < 4; ++c) {
                    if (!bytes) {
                        floats.push_back(texel[c]);
                    } else if (from.srgb && c < 3) {
                        codes.push_back(texunit::encode_srgb8(texel[c]));
                    } else {
                        codes.push_back(uint8_t(std::lround(std::clamp(texel[c], 0.0f, 1.0f) * 255.0f)));
                    }
                }
            }
        }
        const GLint format = !bytes ? GL_RGBA16F : from.srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8;
        glTexImage2D(GL_TEXTURE_2D, level, format, width, height, 0, GL_RGBA, bytes ? GL_UNSIGNED_BYTE : GL_FLOAT,
                     bytes ? static_cast<const void*>(codes.data()) : floats.data());
    }
    return name;
}

GLint wrap_mode(texunit::Wrap wrap) {
    return wrap == texunit::Wrap::Repeat ? GL_REPEAT : wrap == texunit::Wrap::MirroredRepeat ? GL_MIRRORED_REPEAT : GL_CLAMP_TO_EDGE;
}
int wrap_number(texunit::Wrap wrap) { return wrap == texunit::Wrap::Repeat ? 0 : wrap == texunit::Wrap::MirroredRepeat ? 1 : 2; }

GLuint make_sampler(const texunit::SamplerState& state, Filter filter) {
    GLuint name = 0;
    glGenSamplers(1, &name);
    glSamplerParameteri(name, GL_TEXTURE_WRAP_S, wrap_mode(state.wrap_s));
    glSamplerParameteri(name, GL_TEXTURE_WRAP_T, wrap_mode(state.wrap_t));
    const bool levels = filter == Filter::Trilinear || filter == Filter::Anisotropic16;
    glSamplerParameteri(name, GL_TEXTURE_MIN_FILTER, levels ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
    glSamplerParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    if (filter == Filter::Anisotropic16) glSamplerParameterf(name, kMaxAnisotropy, 16.0f);
    return name;
}

struct GlMesh {
    GLuint vertices = 0;
    GLsizei indices = 0;
    uint32_t material = 0;
    Variant variant;
};

template <class T>
void add_attribute(GLuint location, const std::vector<T>& values, std::initializer_list<float> otherwise) {
    if (values.empty()) {
        glVertexAttrib4f(location, otherwise.begin()[0], otherwise.begin()[1], otherwise.begin()[2], otherwise.begin()[3]);
        return;
    }
    GLuint buffer = 0;
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(values.size() * sizeof(T)), values.data(), GL_STATIC_DRAW);
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, GLint(sizeof(T) / sizeof(float)), GL_FLOAT, GL_FALSE, 0, nullptr);
}

GlMesh upload(const Mesh& mesh, const Material& material) {
    GlMesh uploaded;
    uploaded.indices = GLsizei(mesh.indices.size());
    uploaded.material = mesh.material;
    uploaded.variant = variant_of(material, mesh);
    glGenVertexArrays(1, &uploaded.vertices);
    glBindVertexArray(uploaded.vertices);
    add_attribute(0, mesh.positions, {0, 0, 0, 1});
    add_attribute(1, mesh.normals, {0, 0, 1, 0});
    add_attribute(2, mesh.tangents, {1, 0, 0, 1});
    add_attribute(3, mesh.uv[0], {0, 0, 0, 0});
    add_attribute(4, mesh.uv[1], {0, 0, 0, 0});
    add_attribute(5, mesh.colors, {1, 1, 1, 1});
    GLuint buffer = 0;
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(mesh.indices.size() * sizeof(uint32_t)), mesh.indices.data(), GL_STATIC_DRAW);
    return uploaded;
}

class LlvmpipeFrame final : public OpenglFrame {
  public:
    LlvmpipeFrame(std::unique_ptr<texunit::GlContext> context, const Scene& scene, const Setting& setting)
        : context_(std::move(context)),
          width_(setting.width),
          height_(setting.height),
          instances_(scene.instances),
          materials_(scene.materials) {
        for (const SceneTexture& texture : scene.textures) textures_.push_back(upload(texture));
        for (const Mesh& mesh : scene.meshes) {
            meshes_.push_back(upload(mesh, materials_[mesh.material]));
            GLuint& program = programs_[meshes_.back().variant];
            if (program == 0) program = compile(setting.filter, meshes_.back().variant);
        }
        for (const Material& material : materials_)
            for (const TextureMap& map : material.maps)
                samplers_.push_back(map.texture < 0 ? 0 : make_sampler(map.sampler, setting.filter));
        make_target();
        for (const auto& [variant, program] : programs_) set_frame_uniforms(program, setting);
        check("the scene");
    }

    std::string name() const override {
        // "llvmpipe (LLVM …)" and "4.5 (Core Profile) Mesa …": the words that name them.
        const std::string renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
        const std::string version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
        const size_t mesa = version.find("Mesa");
        return renderer.substr(0, renderer.find(" (")) + ", " + (mesa == std::string::npos ? version : version.substr(mesa));
    }

    void draw(int frame) override {
        for (const auto& [variant, program] : programs_) {
            glUseProgram(program_ = program);
            glUniform1ui(place("frame"), GLuint(frame));
        }
        glClearColor(0, 0, 0, 0);
        glClearDepth(0);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        uint32_t bound = ~0u;
        glUseProgram(program_ = 0);
        for (const shading::Instance& instance : instances_) {
            const GlMesh& mesh = meshes_[instance.mesh];
            const GLuint program = programs_.at(mesh.variant);
            if (program != program_ || mesh.material != bound) {
                glUseProgram(program_ = program);
                bind_material(bound = mesh.material);
            }
            const glm::mat4& m = instance.world_from_object;
            const glm::mat3 normal_matrix = glm::transpose(glm::inverse(glm::mat3(m)));
            glUniformMatrix4fv(place("world_from_object"), 1, GL_FALSE, glm::value_ptr(m));
            glUniformMatrix3fv(place("normal_from_object"), 1, GL_FALSE, glm::value_ptr(normal_matrix));
            glFrontFace(glm::determinant(glm::mat3(m)) < 0 ? GL_CW : GL_CCW);
            glBindVertexArray(mesh.vertices);
            glDrawElements(GL_TRIANGLES, mesh.indices, GL_UNSIGNED_INT, nullptr);
        }
        glFinish();
        check("a frame");
    }

    Image read() const override {
        std::vector<uint8_t> codes(size_t(width_) * size_t(height_) * 4);
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, codes.data());
        Image image(width_, height_, 3);
        for (int y = 0; y < height_; ++y)
            for (int x = 0; x < width_; ++x)
                for (size_t c = 0; c < 3; ++c)
                    image.pixel(x, y)[c] = texunit::srgb8_table()[codes[(size_t(height_ - 1 - y) * size_t(width_) + size_t(x)) * 4 + c]];
        return image;
    }

  private:
    GLint place(const char* uniform) const { return glGetUniformLocation(program_, uniform); }

    static void check(const char* what) {
        if (glGetError() != GL_NO_ERROR) throw std::runtime_error(std::string("OpenGL refuses ") + what);
    }

    void make_target() {
        std::array<GLuint, 2> buffers{};
        glGenRenderbuffers(2, buffers.data());
        GLuint framebuffer = 0;
        glGenFramebuffers(1, &framebuffer);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        for (const auto& [buffer, format, attachment] :
             {std::tuple{buffers[0], GL_SRGB8_ALPHA8, GL_COLOR_ATTACHMENT0}, {buffers[1], GL_DEPTH_COMPONENT32F, GL_DEPTH_ATTACHMENT}}) {
            glBindRenderbuffer(GL_RENDERBUFFER, buffer);
            glRenderbufferStorage(GL_RENDERBUFFER, GLenum(format), width_, height_);
            glFramebufferRenderbuffer(GL_FRAMEBUFFER, GLenum(attachment), GL_RENDERBUFFER, buffer);
        }
        if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
            throw std::runtime_error("OpenGL has no target to draw to");
        glViewport(0, 0, width_, height_);
        glEnable(GL_FRAMEBUFFER_SRGB);
        glEnable(GL_DEPTH_TEST);
        // Depth falls from 1 to 0 with distance, as raster's does.
        glDepthFunc(GL_GREATER);
        glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    }

    void set_frame_uniforms(GLuint program, const Setting& setting) {
        glUseProgram(program_ = program);
        const glm::mat4 clip = shading::clip_from_world(setting.camera, float(width_) / float(height_));
        const glm::vec3 to_light = -setting.light.direction, light = setting.light.color * setting.light.intensity;
        const glm::vec3 eye = shading::make_view_rays(setting.camera, width_, height_).eye;
        glUniformMatrix4fv(place("clip_from_world"), 1, GL_FALSE, glm::value_ptr(clip));
        glUniform3fv(place("eye"), 1, glm::value_ptr(eye));
        glUniform3fv(place("to_light"), 1, glm::value_ptr(to_light));
        glUniform3fv(place("light"), 1, glm::value_ptr(light));
        glUniform1f(place("ambient"), setting.ambient);
        for (size_t slot = 0; slot < kMapNames.size(); ++slot) glUniform1i(place(kMapNames[slot]), GLint(slot));
    }

    void bind_material(uint32_t index) {
        const Material& material = materials_[index];
        std::array<glm::ivec2, shading::kMapSlots> wrap{};
        std::array<glm::mat3x2, shading::kMapSlots> transform{};
        for (size_t slot = 0; slot < material.maps.size(); ++slot) {
            const TextureMap& map = material.maps[slot];
            if (map.texture < 0) continue;
            wrap[slot] = {wrap_number(map.sampler.wrap_s), wrap_number(map.sampler.wrap_t)};
            transform[slot] = map.uv_from_vertex;
            glActiveTexture(GLenum(GL_TEXTURE0 + slot));
            glBindTexture(GL_TEXTURE_2D, textures_[size_t(map.texture)]);
            glBindSampler(GLuint(slot), samplers_[index * material.maps.size() + slot]);
        }
        glUniform2iv(place("wrap"), shading::kMapSlots, &wrap[0].x);
        glUniformMatrix3x2fv(place("uv_from_vertex"), shading::kMapSlots, GL_FALSE, &transform[0][0].x);
        glUniform4fv(place("base_color"), 1, glm::value_ptr(material.base_color));
        glUniform3fv(place("emission"), 1, glm::value_ptr(material.emission));
        glUniform1f(place("metallic"), material.metallic);
        glUniform1f(place("roughness"), material.roughness);
        glUniform1f(place("normal_scale"), material.normal_scale);
        glUniform1f(place("occlusion_strength"), material.occlusion_strength);
        const float cutoff = material.alpha_mode == shading::AlphaMode::Mask ? material.alpha_cutoff : 0.5f;
        glUniform1f(place("cutoff"), cutoff);
        if (material.double_sided) {
            glDisable(GL_CULL_FACE);
        } else {
            glEnable(GL_CULL_FACE);
        }
    }

    std::unique_ptr<texunit::GlContext> context_;
    int width_, height_;
    std::map<Variant, GLuint> programs_;
    GLuint program_ = 0;  ///< in use
    std::vector<shading::Instance> instances_;
    std::vector<Material> materials_;
    std::vector<GlMesh> meshes_;
    std::vector<GLuint> textures_, samplers_;
};

}  // namespace

std::unique_ptr<OpenglFrame> make_opengl_frame(const Scene& scene, const Setting& setting, std::string& why_not) {
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    setenv("GALLIUM_DRIVER", "llvmpipe", 1);
    setenv("LP_NUM_THREADS", std::to_string(setting.threads).c_str(), 1);
    std::unique_ptr<texunit::GlContext> context = texunit::GlContext::make(4, 5, why_not);
    if (!context) return nullptr;
    return std::make_unique<LlvmpipeFrame>(std::move(context), scene, setting);
}

}  // namespace rawtexel::peer
