#include "src/bench/llvmpipe_mesh.h"

#ifdef NINEBIT_HAS_EGL
#include <utility>

#include "src/bench/gl_program.h"
#include "src/bench/meshes.h"
#endif
#include "src/bench/egl_context.h"

namespace ninebit::bench {

#ifdef NINEBIT_HAS_EGL
namespace {

constexpr const char* kMeshVertex =
    "#version 330 core\nlayout(location = 0) in vec3 position;\nlayout(location = 1) in vec4 color;\n"
    "flat out vec4 own;\nvoid main() { gl_Position = vec4(position, 1.0); own = color; }\n";
constexpr const char* kMeshFragment =
    "#version 330 core\nflat in vec4 own;\nlayout(location = 0) out vec4 color;\nvoid main() { color = own; }\n";

class MeshInGl final : public LlvmpipeMesh {
 public:
  MeshInGl(std::unique_ptr<EglContext> context, int width, int height)
      : context_(std::move(context)), gl_(*context_), width_(width), height_(height) {}

  Status set_up() {
    const DriverCode driver_code;
    if (renderer().find("llvmpipe") == std::string::npos) {
      return Diagnostic{.message = "the OpenGL renderer is not llvmpipe: " + renderer()};
    }
    const auto program = link_program(gl_, kMeshVertex, kMeshFragment);
    if (!program) return program.error();
    gl_.UseProgram(*program);
    GLuint frame = 0;
    gl_.GenFramebuffers(1, &frame);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, frame);
    attach(GL_COLOR_ATTACHMENT0, GL_RGBA8);
    attach(GL_DEPTH_STENCIL_ATTACHMENT, GL_DEPTH24_STENCIL8);
    if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
      return Diagnostic{.message = "GL cannot draw into a framebuffer of this size"};
    }
    gl_.Viewport(0, 0, width_, height_);
    gl_.ClearColor(0.0F, 0.0F, 0.0F, 0.0F);
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthFunc(GL_LESS);
    return {};
  }

  void prepare(const Mesh& mesh) override {
    const DriverCode driver_code;
    const ProvokingVertices flat = provoking_vertices(mesh.triangles, mesh.colors, mesh.positions.size());
    std::vector<glm::vec3> positions;
    for (const std::uint32_t v : flat.source) positions.push_back(mesh.positions[v]);
    indices_ = static_cast<GLsizei>(3 * flat.triangles.size());
    GLuint vertices = 0;
    gl_.GenVertexArrays(1, &vertices);
    gl_.BindVertexArray(vertices);
    upload(GL_ELEMENT_ARRAY_BUFFER, flat.triangles);
    upload(GL_ARRAY_BUFFER, positions);
    gl_.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    gl_.EnableVertexAttribArray(0);
    upload(GL_ARRAY_BUFFER, flat.colors);
    gl_.VertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, 0, nullptr);
    gl_.EnableVertexAttribArray(1);
  }

  void clear() override {
    const DriverCode driver_code;
    gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    gl_.Finish();
  }

  void draw() override {
    const DriverCode driver_code;
    gl_.DrawElements(GL_TRIANGLES, indices_, GL_UNSIGNED_INT, nullptr);
    gl_.Finish();
  }

  [[nodiscard]] std::string renderer() const override { return renderer_of(gl_); }

  [[nodiscard]] Result<std::vector<std::uint8_t>> picture() override { return picture_of(gl_, width_, height_); }

 private:
  void attach(GLenum attachment, GLenum format) {
    GLuint name = 0;
    gl_.GenRenderbuffers(1, &name);
    gl_.BindRenderbuffer(GL_RENDERBUFFER, name);
    gl_.RenderbufferStorage(GL_RENDERBUFFER, format, width_, height_);
    gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, name);
  }

  template <class T>
  void upload(GLenum target, const std::vector<T>& data) {
    GLuint name = 0;
    gl_.GenBuffers(1, &name);
    gl_.BindBuffer(target, name);
    gl_.BufferData(target, static_cast<GLsizeiptr>(data.size() * sizeof(T)), data.data(), GL_STATIC_DRAW);
  }

  std::unique_ptr<EglContext> context_;
  Gl gl_;
  int width_, height_;
  GLsizei indices_ = 0;
};

}  // namespace
#endif

Result<std::unique_ptr<LlvmpipeMesh>> LlvmpipeMesh::make(int width, int height, int threads) {
  auto context = EglContext::make(threads);
  if (!context) return context.error();
#ifdef NINEBIT_HAS_EGL
  auto mesh = std::make_unique<MeshInGl>(std::move(*context), width, height);
  if (Status ready = mesh->set_up(); !ready) return ready.error();
  return std::unique_ptr<LlvmpipeMesh>(std::move(mesh));
#else
  static_cast<void>(width), static_cast<void>(height);
  return Diagnostic{.message = "built without EGL"};
#endif
}

}  // namespace ninebit::bench
