#include "src/bench/llvmpipe_effect.h"

#ifdef NINEBIT_HAS_EGL
#include <utility>
#include <variant>

#include "src/bench/gl_program.h"
#endif
#include "src/bench/egl_context.h"

namespace ninebit::bench {

#ifdef NINEBIT_HAS_EGL
namespace {

constexpr const char* kRectangleVertex =
    "#version 330 core\nout vec2 uv;\nvoid main() {\n"
    "  vec2 corner = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);\n"
    "  uv = vec2(corner.x, 1.0 - corner.y);\n  gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);\n}\n";
constexpr const char* kFragmentHeader =
    "#version 330 core\nin vec2 uv;\nout vec4 color;\nuniform sampler2D tex0;\nuniform sampler2D tex1;\n"
    "uniform samplerCube cube1;\n";

class EffectInGl final : public LlvmpipeEffect {
 public:
  explicit EffectInGl(std::unique_ptr<EglContext> context) : context_(std::move(context)), gl_(*context_) {}

  Status prepare(const EffectWorkload& workload) override {
    const DriverCode driver_code;
    if (renderer().find("llvmpipe") == std::string::npos) {
      return Diagnostic{.message = "the OpenGL renderer is not llvmpipe: " + renderer()};
    }
    const auto program = link_program(gl_, kRectangleVertex, kFragmentHeader + workload.fragment);
    if (!program) return program.error();
    gl_.UseProgram(*program);
    for (std::size_t unit = 0; unit < workload.effect.textures.size(); ++unit) {
      const auto texture = workload_texture(workload, unit);
      if (!texture) return texture.error();
      const bool is_cube = texture->target == TextureTarget::cube_map;
      const std::string name = (is_cube ? "cube" : "tex") + std::to_string(unit);
      gl_.Uniform1i(gl_.GetUniformLocation(*program, name.c_str()), static_cast<GLint>(unit));
      add_texture(unit, *texture, workload.effect.textures[unit].sampler);
    }
    GLuint vertices = 0;
    gl_.GenVertexArrays(1, &vertices);
    gl_.BindVertexArray(vertices);
    width_ = workload.effect.width;
    height_ = workload.effect.height;
    return make_framebuffer();
  }

  void draw() override {
    const DriverCode driver_code;
    gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    gl_.Finish();
  }

  [[nodiscard]] std::string renderer() const override { return renderer_of(gl_); }

  [[nodiscard]] Result<std::vector<std::uint8_t>> picture() override { return picture_of(gl_, width_, height_); }

 private:
  // One byte after the other: the components that the texture stores, of ds and dt ds first.
  static std::vector<std::uint8_t> bytes_of(const Texture& texture, const TextureImage& image) {
    const auto& planes = std::get<std::array<Plane<const std::uint8_t>, 4>>(image.planes);
    const bool is_dsdt = texture.format == InternalFormat::dsdt8;
    const std::vector<std::size_t> order =
        is_dsdt ? std::vector<std::size_t>{2, 1}
                : std::vector<std::size_t>{0, 1, 2, texture.format == InternalFormat::rgba8 ? 3U : 2U};
    std::vector<std::uint8_t> bytes;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        for (const std::size_t k : order) bytes.push_back(planes[k].at(x, y));
      }
    }
    return bytes;
  }

  // As a GL program would: signed bytes as SNORM, three components padded to four.
  void add_texture(std::size_t unit, const Texture& texture, const Sampler& sampler) {
    GLuint name = 0;
    gl_.GenTextures(1, &name);
    gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    const bool is_cube = texture.target == TextureTarget::cube_map, is_dsdt = texture.format == InternalFormat::dsdt8;
    const bool is_signed = is_dsdt || sampler.is_signed[0];
    const GLenum target = is_cube ? GL_TEXTURE_CUBE_MAP : GL_TEXTURE_2D;
    gl_.BindTexture(target, name);
    const GLint format = is_dsdt ? GL_RG8_SNORM : is_signed ? GL_RGBA8_SNORM : GL_RGBA8;
    for (std::size_t face = 0; face < texture.face_count(); ++face) {
      const TextureImage& image = texture.faces[face][0];
      const std::vector<std::uint8_t> bytes = bytes_of(texture, image);
      const GLenum to = is_cube ? GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face) : GL_TEXTURE_2D;
      gl_.TexImage2D(to, 0, format, image.width, image.height, 0, is_dsdt ? GL_RG : GL_RGBA,
                     is_signed ? GL_BYTE : GL_UNSIGNED_BYTE, bytes.data());
    }
    const bool mipmaps = sampler.min_filter == MinFilter::linear_mipmap_linear;
    const GLint plain = sampler.mag_filter == MagFilter::nearest ? GL_NEAREST : GL_LINEAR;
    if (mipmaps) gl_.GenerateMipmap(target);
    gl_.TexParameteri(target, GL_TEXTURE_MIN_FILTER, mipmaps ? GL_LINEAR_MIPMAP_LINEAR : plain);
    gl_.TexParameteri(target, GL_TEXTURE_MAG_FILTER, plain);
    if (sampler.wrap_s != Wrap::clamp_to_edge) return;
    gl_.TexParameteri(target, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl_.TexParameteri(target, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  }

  Status make_framebuffer() {
    GLuint names[3] = {};
    gl_.GenRenderbuffers(2, names);
    gl_.GenFramebuffers(1, &names[2]);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, names[2]);
    gl_.BindRenderbuffer(GL_RENDERBUFFER, names[0]);
    gl_.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width_, height_);
    gl_.BindRenderbuffer(GL_RENDERBUFFER, names[1]);
    gl_.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, width_, height_);
    gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, names[0]);
    gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, names[1]);
    gl_.Viewport(0, 0, width_, height_);
    if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return {};
    return Diagnostic{.message = "GL cannot draw into a framebuffer of this size"};
  }

  std::unique_ptr<EglContext> context_;
  Gl gl_;
  int width_ = 0, height_ = 0;
};

}  // namespace

Result<std::unique_ptr<LlvmpipeEffect>> LlvmpipeEffect::make(int threads) {
  const DriverCode driver_code;
  auto context = EglContext::make(threads);
  if (!context) return context.error();
  return std::unique_ptr<LlvmpipeEffect>(std::make_unique<EffectInGl>(std::move(*context)));
}
#else
Result<std::unique_ptr<LlvmpipeEffect>> LlvmpipeEffect::make(int threads) {
  auto context = EglContext::make(threads);
  return context.error();
}
#endif

}  // namespace ninebit::bench
