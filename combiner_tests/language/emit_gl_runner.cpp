#include "combiner_tests/language/emit_gl_runner.h"

#ifdef NINEBIT_HAS_EGL
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>

#include <array>
#include <cstdint>
#include <cstdlib>

// A function of the leak sanitizer, where the program is built with it.
extern "C" {
__attribute__((weak)) void __lsan_disable();  // NOLINT(bugprone-reserved-identifier): its name for it
__attribute__((weak)) void __lsan_enable();   // NOLINT(bugprone-reserved-identifier)
}
#endif

namespace ninebit::test {

#ifndef NINEBIT_HAS_EGL

std::unique_ptr<GlRunner> GlRunner::make(PixelLanguage, std::string& why_not) {
  why_not = "built without EGL (install libegl-dev and libgl-dev)";
  return nullptr;
}

#else
namespace {

using Pixel = std::array<std::int32_t, 4>;

// A version of GLSL and of the GL that is asked to compile it.
struct GlOf {
  const char* version;  // the line that begins a shader
  bool es;
  EGLint major, minor;
};
GlOf gl_of(PixelLanguage language) {
  switch (language) {
    case PixelLanguage::glsl_130:
      return {"#version 130\n", false, 3, 0};
    case PixelLanguage::glsl_450:
      return {"#version 450 core\n", false, 4, 5};
    case PixelLanguage::es_300:
      return {"#version 300 es\n", true, 3, 0};
    default:
      return {"#version 330 core\n", false, 3, 3};
  }
}

constexpr int kMostFragments = 1024;
constexpr int kMostFunctions = 16;
constexpr int kArguments = 8;  // seven registers, then spare0's alpha

// Memory that Mesa allocates in here and keeps for good is not a leak of ours.
class DriverCode {
 public:
  DriverCode() {
    if (__lsan_disable != nullptr) __lsan_disable();
  }
  ~DriverCode() {
    if (__lsan_enable != nullptr) __lsan_enable();
  }
  DriverCode(const DriverCode&) = delete;
  DriverCode& operator=(const DriverCode&) = delete;
};

// A function of GL by its name.
struct EntryPoint {
  const char* name;
  template <class Function>
  operator Function() const {  // NOLINT(google-explicit-constructor): it takes the type of what it is given to
    return reinterpret_cast<Function>(eglGetProcAddress(name));
  }
};

// The entry points, as GL itself names them.
struct Gl {
  PFNGLCREATESHADERPROC CreateShader = EntryPoint{"glCreateShader"};
  PFNGLSHADERSOURCEPROC ShaderSource = EntryPoint{"glShaderSource"};
  PFNGLCOMPILESHADERPROC CompileShader = EntryPoint{"glCompileShader"};
  PFNGLGETSHADERIVPROC GetShaderiv = EntryPoint{"glGetShaderiv"};
  PFNGLGETSHADERINFOLOGPROC GetShaderInfoLog = EntryPoint{"glGetShaderInfoLog"};
  PFNGLDELETESHADERPROC DeleteShader = EntryPoint{"glDeleteShader"};
  PFNGLCREATEPROGRAMPROC CreateProgram = EntryPoint{"glCreateProgram"};
  PFNGLATTACHSHADERPROC AttachShader = EntryPoint{"glAttachShader"};
  PFNGLLINKPROGRAMPROC LinkProgram = EntryPoint{"glLinkProgram"};
  PFNGLGETPROGRAMIVPROC GetProgramiv = EntryPoint{"glGetProgramiv"};
  PFNGLUSEPROGRAMPROC UseProgram = EntryPoint{"glUseProgram"};
  PFNGLDELETEPROGRAMPROC DeleteProgram = EntryPoint{"glDeleteProgram"};
  PFNGLGENTEXTURESPROC GenTextures = EntryPoint{"glGenTextures"};
  PFNGLBINDTEXTUREPROC BindTexture = EntryPoint{"glBindTexture"};
  PFNGLTEXIMAGE2DPROC TexImage2D = EntryPoint{"glTexImage2D"};
  PFNGLTEXSUBIMAGE2DPROC TexSubImage2D = EntryPoint{"glTexSubImage2D"};
  PFNGLTEXPARAMETERIPROC TexParameteri = EntryPoint{"glTexParameteri"};
  PFNGLGENFRAMEBUFFERSPROC GenFramebuffers = EntryPoint{"glGenFramebuffers"};
  PFNGLBINDFRAMEBUFFERPROC BindFramebuffer = EntryPoint{"glBindFramebuffer"};
  PFNGLFRAMEBUFFERTEXTURE2DPROC FramebufferTexture2D = EntryPoint{"glFramebufferTexture2D"};
  PFNGLCHECKFRAMEBUFFERSTATUSPROC CheckFramebufferStatus = EntryPoint{"glCheckFramebufferStatus"};
  PFNGLGENVERTEXARRAYSPROC GenVertexArrays = EntryPoint{"glGenVertexArrays"};
  PFNGLBINDVERTEXARRAYPROC BindVertexArray = EntryPoint{"glBindVertexArray"};
  PFNGLVIEWPORTPROC Viewport = EntryPoint{"glViewport"};
  PFNGLDRAWARRAYSPROC DrawArrays = EntryPoint{"glDrawArrays"};
  PFNGLREADPIXELSPROC ReadPixels = EntryPoint{"glReadPixels"};
  PFNGLCLEARBUFFERIVPROC ClearBufferiv = EntryPoint{"glClearBufferiv"};
  PFNGLGETERRORPROC GetError = EntryPoint{"glGetError"};
  PFNGLGETSTRINGPROC GetString = EntryPoint{"glGetString"};
};

class EglRunner final : public GlRunner {
 public:
  explicit EglRunner(PixelLanguage language) : gl_of_(gl_of(language)) {}
  ~EglRunner() override {
    if (display_ == EGL_NO_DISPLAY) return;
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
    eglTerminate(display_);
  }
  EglRunner(const EglRunner&) = delete;
  EglRunner& operator=(const EglRunner&) = delete;

  bool open(std::string& why_not) {
    const DriverCode driver_code;
    // Every run compiles for itself and leaves nothing in the user's home.
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    // The thread sanitizer does not see how Mesa's threads agree; a picture this small needs none.
    setenv("LP_NUM_THREADS", "0", 1);
    setenv("GALLIVM_PERF", "nopt", 1);  // llvmpipe's own optimizer takes longer than it saves
    display_ = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display_ == EGL_NO_DISPLAY || eglInitialize(display_, nullptr, nullptr) == EGL_FALSE) {
      display_ = EGL_NO_DISPLAY;
      why_not = "EGL has no surfaceless platform here (install libegl1, libegl-mesa0 and libgl1-mesa-dri)";
      return false;
    }
    const std::array<EGLint, 5> attributes{EGL_CONTEXT_MAJOR_VERSION, gl_of_.major, EGL_CONTEXT_MINOR_VERSION,
                                           gl_of_.minor, EGL_NONE};
    eglBindAPI(gl_of_.es ? EGL_OPENGL_ES_API : EGL_OPENGL_API);
    context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    if (context_ == EGL_NO_CONTEXT || eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) {
      why_not = std::string("EGL gives no context of OpenGL ") + (gl_of_.es ? "ES " : "") +
                std::to_string(gl_of_.major) + '.' + std::to_string(gl_of_.minor);
      return false;
    }
    gl_.emplace();
    inputs_ = integer_texture(kArguments, kMostFragments);
    const GLuint target = integer_texture(kMostFunctions, kMostFragments);
    GLuint name = 0;
    gl_->GenFramebuffers(1, &name);
    gl_->BindFramebuffer(GL_FRAMEBUFFER, name);
    gl_->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target, 0);
    if (gl_->CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
      why_not = "GL does not render to integers";
      return false;
    }
    gl_->GenVertexArrays(1, &name);
    gl_->BindVertexArray(name);
    gl_->BindTexture(GL_TEXTURE_2D, inputs_);
    return true;
  }

  [[nodiscard]] std::string renderer() const override {
    return std::string(reinterpret_cast<const char*>(gl_->GetString(GL_RENDERER))) + ", " +
           reinterpret_cast<const char*>(gl_->GetString(GL_VERSION));
  }

  std::optional<Colors> run(const std::string& source, const std::vector<std::string>& functions,
                            const std::vector<RegisterFile>& inputs, std::string& message) override {
    const DriverCode driver_code;
    const GLuint program = link(source + main_of(functions), message);
    if (program == 0) return std::nullopt;
    upload(inputs);
    gl_->UseProgram(program);
    const auto width = static_cast<GLsizei>(functions.size()), height = static_cast<GLsizei>(inputs.size());
    const std::array<GLint, 4> nothing{-9999, -9999, -9999, -9999};
    gl_->ClearBufferiv(GL_COLOR, 0, nothing.data());
    gl_->Viewport(0, 0, width, height);
    gl_->DrawArrays(GL_TRIANGLES, 0, 3);
    std::vector<Pixel> pixels(functions.size() * inputs.size());
    gl_->ReadPixels(0, 0, width, height, GL_RGBA_INTEGER, GL_INT, pixels.data());
    gl_->DeleteProgram(program);
    if (const GLenum error = gl_->GetError(); error != GL_NO_ERROR) {
      message = "GL error " + std::to_string(error);
      return std::nullopt;
    }
    Colors colors(functions.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const Pixel& p = pixels[i];
      colors[i % functions.size()].push_back(
          {static_cast<s9>(p[0]), static_cast<s9>(p[1]), static_cast<s9>(p[2]), static_cast<s9>(p[3])});
    }
    return colors;
  }

 private:
  GLuint integer_texture(GLsizei width, GLsizei height) {
    GLuint name = 0;
    gl_->GenTextures(1, &name);
    gl_->BindTexture(GL_TEXTURE_2D, name);
    gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32I, width, height, 0, GL_RGBA_INTEGER, GL_INT, nullptr);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return name;
  }

  // Column i of the picture is function i, row k its result for the arguments k.
  static std::string main_of(const std::vector<std::string>& functions) {
    std::string text =
        "\nuniform highp isampler2D arguments;\nout highp ivec4 color;\n"
        "ivec4 argument(int i) { return texelFetch(arguments, ivec2(i, int(gl_FragCoord.y)), 0); }\n"
        "void main() {\n  int column = int(gl_FragCoord.x);\n";
    for (std::size_t i = 0; i < functions.size(); ++i) {
      text += "  if (column == " + std::to_string(i) + ") color = " + functions[i] +
              "(argument(0), argument(1), argument(2), argument(3),\n"
              "      argument(4), argument(5), argument(6), argument(7).a);\n";
    }
    return text + "}\n";
  }

  GLuint compile_shader(GLenum kind, const std::string& text, std::string& message) {
    const GLuint shader = gl_->CreateShader(kind);
    const char* const start = text.c_str();
    gl_->ShaderSource(shader, 1, &start, nullptr);
    gl_->CompileShader(shader);
    GLint done = GL_FALSE;
    gl_->GetShaderiv(shader, GL_COMPILE_STATUS, &done);
    if (done == GL_TRUE) return shader;
    std::array<char, 4096> log{};
    gl_->GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    gl_->DeleteShader(shader);
    message = std::string(log.data()) + '\n' + text;
    return 0;
  }

  GLuint link(const std::string& fragment_text, std::string& message) {
    // One triangle that covers everything.
    const GLuint vertex = compile_shader(GL_VERTEX_SHADER,
                                         std::string(gl_of_.version) +
                                             "void main() {\n"
                                             "  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0,\n"
                                             "                     gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);\n}\n",
                                         message);
    const GLuint fragment = compile_shader(GL_FRAGMENT_SHADER, fragment_text, message);
    if (vertex == 0 || fragment == 0) return 0;
    const GLuint program = gl_->CreateProgram();
    gl_->AttachShader(program, vertex);
    gl_->AttachShader(program, fragment);
    gl_->LinkProgram(program);
    gl_->DeleteShader(vertex);
    gl_->DeleteShader(fragment);
    GLint done = GL_FALSE;
    gl_->GetProgramiv(program, GL_LINK_STATUS, &done);
    if (done == GL_TRUE) return program;
    message = "the program does not link\n" + fragment_text;
    gl_->DeleteProgram(program);
    return 0;
  }

  void upload(const std::vector<RegisterFile>& inputs) {
    constexpr std::array kOrder{Register::primary,  Register::secondary, Register::fog,      Register::texture0,
                                Register::texture1, Register::texture2,  Register::texture3, Register::spare0};
    std::vector<std::int32_t> texels;
    for (const RegisterFile& registers : inputs) {
      for (const Register r : kOrder) texels.insert(texels.end(), registers[r].begin(), registers[r].end());
    }
    gl_->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, kArguments, static_cast<GLsizei>(inputs.size()), GL_RGBA_INTEGER, GL_INT,
                       texels.data());
  }

  GlOf gl_of_;
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
  std::optional<Gl> gl_;
  GLuint inputs_ = 0;
};

}  // namespace

std::unique_ptr<GlRunner> GlRunner::make(PixelLanguage language, std::string& why_not) {
  auto runner = std::make_unique<EglRunner>(language);
  if (!runner->open(why_not)) return nullptr;
  return runner;
}
#endif

std::unique_ptr<GlRunner> GlRunner::make(GlslVersion version, std::string& why_not) {
  return make(version == GlslVersion::glsl_130   ? PixelLanguage::glsl_130
              : version == GlslVersion::glsl_330 ? PixelLanguage::glsl_330
                                                 : PixelLanguage::es_300,
              why_not);
}

}  // namespace ninebit::test
