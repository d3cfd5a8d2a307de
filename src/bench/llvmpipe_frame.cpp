#include "src/bench/llvmpipe_frame.h"

#ifdef NINEBIT_HAS_EGL
#include <array>
#include <glm/gtc/type_ptr.hpp>
#include <tuple>
#include <utility>

#include "src/bench/gl_program.h"
#include "src/bench/llvmpipe_shaders.h"
#include "src/bench/meshes.h"
#endif
#include "src/bench/egl_context.h"

namespace ninebit::bench {

#ifdef NINEBIT_HAS_EGL
namespace {

Diagnostic fault(std::string message) {
  return Diagnostic{.message = std::move(message)};
}

class Frame final : public LlvmpipeFrame {
 public:
  Frame(std::unique_ptr<EglContext> context, const Scene& scene, const RenderSettings& settings,
        const IndexCubeRenderer& ours)
      : context_(std::move(context)),
        gl_(*context_),
        settings_(settings),
        light_(scene.lights[0].position),
        camera_projection_(ours.camera_projection()),
        face_projections_(ours.face_projections()) {}

  Status set_up(const Scene& scene, const IndexCubeRenderer& ours) {
    const DriverCode driver_code;
    if (renderer().find("llvmpipe") == std::string::npos)
      return fault("the OpenGL renderer is not llvmpipe: " + renderer());
    for (const auto& [pass, vertex, fragment] :
         {std::tuple{&map_, std::string(shaders::kMapVertex), shaders::kMapFragment},
          std::tuple{&depth_, std::string(shaders::kCameraPosition) + shaders::kDepthVertex, shaders::kDepthFragment},
          std::tuple{&compare_, std::string(shaders::kCameraPosition) + shaders::kCompareVertex,
                     shaders::kCompareFragment},
          std::tuple{&lit_, std::string(shaders::kCameraPosition) + shaders::kShadeVertex, shaders::kShadeFragment}}) {
      if (Status linked = link(vertex, fragment, *pass); !linked) return linked;
    }
    shadow_ = lit_;
    upload(scene, ours);
    if (Status made = make_targets(); !made) return made;
    if (settings_.cull_face != CullFace::none) {
      gl_.Enable(GL_CULL_FACE);
      gl_.CullFace(settings_.cull_face == CullFace::back ? GL_BACK : GL_FRONT);
    }
    gl_.Enable(GL_DEPTH_TEST);
    return {};
  }

  void draw() override {
    const DriverCode driver_code;
    draw_maps();
    gl_.BindFramebuffer(GL_FRAMEBUFFER, frame_);
    gl_.Viewport(0, 0, settings_.width, settings_.height);
    const auto& b = CameraFrame::kBackground;
    gl_.ClearColor(static_cast<float>(b[0]) / 255.0F, static_cast<float>(b[1]) / 255.0F,
                   static_cast<float>(b[2]) / 255.0F, 1.0F);
    gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);

    gl_.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    draw_pass(depth_, camera_projection_);

    gl_.DepthFunc(GL_EQUAL);
    gl_.DepthMask(GL_FALSE);
    gl_.Enable(GL_STENCIL_TEST);
    gl_.StencilFunc(GL_ALWAYS, 1, 0xFF);
    gl_.StencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    draw_pass(compare_, camera_projection_);

    gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl_.StencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    gl_.StencilFunc(GL_EQUAL, 0, 0xFF);
    draw_pass(lit_, camera_projection_);
    gl_.StencilFunc(GL_EQUAL, 1, 0xFF);
    draw_pass(shadow_, camera_projection_);
    gl_.Finish();
  }

  [[nodiscard]] std::string renderer() const override { return renderer_of(gl_); }

  [[nodiscard]] Result<std::vector<std::uint8_t>> stencil() override {
    const DriverCode driver_code;
    std::vector<std::uint8_t> values(static_cast<std::size_t>(settings_.width) *
                                     static_cast<std::size_t>(settings_.height));
    gl_.BindFramebuffer(GL_FRAMEBUFFER, frame_);
    gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl_.ReadPixels(0, 0, settings_.width, settings_.height, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, values.data());
    if (const GLenum error = gl_.GetError(); error != GL_NO_ERROR) return fault("GL error " + std::to_string(error));
    return values;
  }

 private:
  struct Pass {
    GLuint program = 0;
    GLint projection = -1;
    GLint light = -1;
    GLuint vertices = 0;  // the vertex array object
  };

  void draw_pass(const Pass& pass, const glm::mat4& projection) {
    gl_.UseProgram(pass.program);
    gl_.UniformMatrix4fv(pass.projection, 1, GL_FALSE, glm::value_ptr(projection));
    if (pass.light >= 0) gl_.Uniform3fv(pass.light, 1, glm::value_ptr(light_));
    gl_.BindVertexArray(pass.vertices);
    gl_.DrawElements(GL_TRIANGLES, indices_, GL_UNSIGNED_INT, nullptr);
  }

  void draw_maps() {
    gl_.Viewport(0, 0, settings_.map_size, settings_.map_size);
    gl_.Disable(GL_STENCIL_TEST);
    gl_.DepthFunc(GL_LESS);
    gl_.DepthMask(GL_TRUE);
    gl_.ClearColor(0.0F, 0.0F, 0.0F, 0.0F);
    for (std::size_t i = 0; i < 6; ++i) {
      gl_.BindFramebuffer(GL_FRAMEBUFFER, faces_[i]);
      gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
      draw_pass(map_, face_projections_[i]);
    }
  }

  Status link(const std::string& vertex, const std::string& fragment, Pass& pass) {
    const auto program =
        link_program(gl_, std::string(shaders::kHeader) + vertex, std::string(shaders::kHeader) + fragment);
    if (!program) return program.error();
    pass.program = *program;
    pass.projection = gl_.GetUniformLocation(pass.program, "projection");
    pass.light = gl_.GetUniformLocation(pass.program, "light");
    return {};
  }

  template <class T>
  GLuint buffer(const std::vector<T>& data) {
    GLuint name = 0;
    gl_.GenBuffers(1, &name);
    gl_.BindBuffer(GL_ARRAY_BUFFER, name);
    gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(data.size() * sizeof(T)), data.data(), GL_STATIC_DRAW);
    return name;
  }

  // A vertex array object with positions only.
  GLuint vertex_array(GLuint positions, GLuint indices) {
    GLuint name = 0;
    gl_.GenVertexArrays(1, &name);
    gl_.BindVertexArray(name);
    gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices);
    gl_.BindBuffer(GL_ARRAY_BUFFER, positions);
    gl_.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    gl_.EnableVertexAttribArray(0);
    return name;
  }

  // Each pass has a vertex array object with the attributes that it reads. Passes with flat colours need more vertices.
  // All passes begin a triangle at the same corner, so that its depths are the same.
  void upload(const Scene& scene, const IndexCubeRenderer& ours) {
    const ProvokingVertices flat = provoking_vertices(scene.triangles, ours.index_colors(), scene.positions.size());
    std::vector<glm::vec3> flat_positions;
    for (const std::uint32_t v : flat.source) flat_positions.push_back(scene.positions[v]);
    std::vector<glm::uvec3> smooth_triangles = flat.triangles;
    for (glm::uvec3& t : smooth_triangles) t = {flat.source[t.x], flat.source[t.y], flat.source[t.z]};
    indices_ = static_cast<GLsizei>(3 * flat.triangles.size());

    const GLuint flat_vertices = buffer(flat_positions), flat_indices = buffer(flat.triangles);
    const GLuint index_colors = buffer(flat.colors);
    map_.vertices = vertex_array(flat_vertices, flat_indices);
    gl_.BindBuffer(GL_ARRAY_BUFFER, index_colors);
    gl_.VertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, 0, nullptr);
    gl_.EnableVertexAttribArray(1);
    compare_.vertices = vertex_array(flat_vertices, flat_indices);
    gl_.BindBuffer(GL_ARRAY_BUFFER, index_colors);
    gl_.VertexAttribIPointer(1, 4, GL_UNSIGNED_BYTE, 0, nullptr);
    gl_.EnableVertexAttribArray(1);

    const GLuint vertices = buffer(scene.positions), indices = buffer(smooth_triangles);
    depth_.vertices = vertex_array(vertices, indices);
    for (const auto& [pass, colors] :
         {std::pair{&lit_, &ours.shading().lit}, std::pair{&shadow_, &ours.shading().shadowed}}) {
      const GLuint shades = buffer(*colors);
      pass->vertices = vertex_array(vertices, indices);
      gl_.BindBuffer(GL_ARRAY_BUFFER, shades);
      gl_.VertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, 0, nullptr);
      gl_.EnableVertexAttribArray(1);
    }
  }

  GLuint renderbuffer(GLenum format, int width, int height) {
    GLuint name = 0;
    gl_.GenRenderbuffers(1, &name);
    gl_.BindRenderbuffer(GL_RENDERBUFFER, name);
    gl_.RenderbufferStorage(GL_RENDERBUFFER, format, width, height);
    return name;
  }

  Status make_targets() {
    const int size = settings_.map_size;
    GLuint cube = 0;
    gl_.GenTextures(1, &cube);
    gl_.BindTexture(GL_TEXTURE_CUBE_MAP, cube);
    gl_.TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_.TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl_.TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl_.TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    const auto face = [](std::size_t i) { return GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(i); };
    for (std::size_t i = 0; i < 6; ++i) {
      gl_.TexImage2D(face(i), 0, GL_RGBA8, size, size, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    }
    const GLuint depth = renderbuffer(GL_DEPTH_COMPONENT24, size, size);
    gl_.GenFramebuffers(6, faces_.data());
    bool complete = true;
    for (std::size_t i = 0; i < 6; ++i) {
      gl_.BindFramebuffer(GL_FRAMEBUFFER, faces_[i]);
      gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, face(i), cube, 0);
      gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
      complete = complete && gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    }
    const GLuint color = renderbuffer(GL_RGBA8, settings_.width, settings_.height);
    const GLuint depth_stencil = renderbuffer(GL_DEPTH24_STENCIL8, settings_.width, settings_.height);
    gl_.GenFramebuffers(1, &frame_);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, frame_);
    gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
    gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, depth_stencil);
    complete = complete && gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    return complete ? Status() : fault("GL cannot draw into framebuffers of these sizes");
  }

  std::unique_ptr<EglContext> context_;
  Gl gl_;
  RenderSettings settings_;
  glm::vec3 light_;
  glm::mat4 camera_projection_;
  std::array<glm::mat4, 6> face_projections_;
  Pass map_, depth_, compare_, lit_, shadow_;
  GLsizei indices_ = 0;
  std::array<GLuint, 6> faces_{};
  GLuint frame_ = 0;
};

}  // namespace
#endif

Result<std::unique_ptr<LlvmpipeFrame>> LlvmpipeFrame::make(const Scene& scene, const RenderSettings& settings,
                                                           const IndexCubeRenderer& renderer, int threads) {
  auto context = EglContext::make(threads);
  if (!context) return context.error();
#ifdef NINEBIT_HAS_EGL
  auto frame = std::make_unique<Frame>(std::move(*context), scene, settings, renderer);
  if (Status ready = frame->set_up(scene, renderer); !ready) return ready.error();
  return std::unique_ptr<LlvmpipeFrame>(std::move(frame));
#else
  static_cast<void>(scene), static_cast<void>(settings), static_cast<void>(renderer);
  return Diagnostic{.message = "built without EGL"};
#endif
}

}  // namespace ninebit::bench
