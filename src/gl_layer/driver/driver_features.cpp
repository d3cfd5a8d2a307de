#include "src/gl_layer/driver/driver_features.h"

#include <cstdio>
#include <cstring>
#include <optional>
#include <string>

#include "src/gl_layer/driver/driver.h"
#include "src/gl_layer/driver/log.h"
#include "src/gl_layer/driver/lookups.h"

namespace ninebit::gl_layer {
namespace {

const char* text_of(GLenum name) {
  const auto* const text = reinterpret_cast<const char*>(found_driver.GetString(name));
  return text != nullptr ? text : "";
}

struct Version {
  int major = 0, minor = 0;
  [[nodiscard]] bool at_least(int a, int b) const { return major > a || (major == a && minor >= b); }
};

Version version_of(const char* text) {
  Version version;
  if (std::sscanf(text, "%d.%d", &version.major, &version.minor) != 2) return {};
  return version;
}

// Whether the context has fixed functions.
bool is_compatible(const Version& version) {
  GLint bits = 0;
  if (version.at_least(3, 2)) {
    found_driver.GetIntegerv(GL_CONTEXT_PROFILE_MASK, &bits);
    return (bits & GL_CONTEXT_CORE_PROFILE_BIT) == 0;
  }
  if (!version.at_least(3, 0)) return true;
  found_driver.GetIntegerv(GL_CONTEXT_FLAGS, &bits);
  if ((bits & GL_CONTEXT_FLAG_FORWARD_COMPATIBLE_BIT) != 0) return false;
  return !version.at_least(3, 1) || has_word(text_of(GL_EXTENSIONS), "GL_ARB_compatibility");
}

bool refused(const std::string& missing) {
  log_once(std::string(text_of(GL_RENDERER)) + ", OpenGL " + text_of(GL_VERSION) + ": " + missing +
           "; the program runs without register combiners");
  return false;
}

bool is_enough(const char* version_text) {
  const Driver& driver = find_driver();
  const Version version = version_of(version_text);
  if (std::strncmp(version_text, "OpenGL ES", 9) == 0) return false;  // these programs never ask for combiners
  const Version language = version.at_least(2, 0) ? version_of(text_of(GL_SHADING_LANGUAGE_VERSION)) : Version{};
  if (!language.at_least(1, 30)) return refused("GLSL 1.30, which has integers, is missing");
  if (!is_compatible(version)) return refused("it is a core profile, and fixed functions are missing");
#define NINEBIT_CHECK(name) \
  if (driver.name == nullptr) return refused("the function gl" #name " is missing");
  NINEBIT_CORE_FUNCTIONS(NINEBIT_CHECK)
  NINEBIT_CHECK(ActiveTexture)
  NINEBIT_CHECK(AttachShader)
  NINEBIT_CHECK(CompileShader)
  NINEBIT_CHECK(CreateProgram)
  NINEBIT_CHECK(CreateShader)
  NINEBIT_CHECK(DeleteProgram)
  NINEBIT_CHECK(DeleteShader)
  NINEBIT_CHECK(DetachShader)
  NINEBIT_CHECK(GetProgramInfoLog)
  NINEBIT_CHECK(GetProgramiv)
  NINEBIT_CHECK(GetShaderInfoLog)
  NINEBIT_CHECK(GetShaderiv)
  NINEBIT_CHECK(GetUniformLocation)
  NINEBIT_CHECK(LinkProgram)
  NINEBIT_CHECK(ShaderSource)
  NINEBIT_CHECK(Uniform1i)
  NINEBIT_CHECK(Uniform2fv)
  NINEBIT_CHECK(Uniform3fv)
  NINEBIT_CHECK(Uniform4fv)
  NINEBIT_CHECK(Uniform4iv)
  NINEBIT_CHECK(UseProgram)
#undef NINEBIT_CHECK
  return true;
}

// What NV_vertex_program's translation needs of ARB_vertex_program.
bool holds_vertex_programs() {
#define NINEBIT_CHECK(name) \
  if (found_driver.name == nullptr) return false;
  NINEBIT_VERTEX_PROGRAM_FUNCTIONS(NINEBIT_CHECK)
#undef NINEBIT_CHECK
  const auto at_least = [](GLenum limit, GLint least) {
    GLint value = 0;
    found_driver.GetProgramivARB(GL_VERTEX_PROGRAM_ARB, limit, &value);
    return value >= least;
  };
  return at_least(GL_MAX_PROGRAM_ENV_PARAMETERS_ARB, 96) && at_least(GL_MAX_PROGRAM_PARAMETERS_ARB, 100) &&
         at_least(GL_MAX_PROGRAM_TEMPORARIES_ARB, 14) && at_least(GL_MAX_PROGRAM_ATTRIBS_ARB, 16) &&
         at_least(GL_MAX_PROGRAM_INSTRUCTIONS_ARB, 256) && driver_integer(GL_MAX_TEXTURE_COORDS) >= 8;
}

// The extension that another one adds to: the layer adds both, or none. It stands before the other in the list.
std::optional<Extra> extended(Extra extra) {
  if (extra == Extra::vertex_program1_1) return Extra::vertex_program;
  if (extra == Extra::shared_texture_palette) return Extra::paletted_texture;
  return std::nullopt;
}

}  // namespace

bool has_word(const char* list, const char* word) {
  const std::size_t length = std::strlen(word);
  for (const char* at = std::strstr(list, word); at != nullptr; at = std::strstr(at + length, word)) {
    const bool begins = at == list || at[-1] == ' ', ends = at[length] == ' ' || at[length] == '\0';
    if (begins && ends) return true;
  }
  return false;
}

DriverFeatures find_features() {
  DriverFeatures features;
  if (find_driver().GetString == nullptr) return features;
  features.enough = is_enough(text_of(GL_VERSION));
  if (!features.enough) return features;
  const char* const extensions = text_of(GL_EXTENSIONS);
  features.fragment_program = has_word(extensions, "GL_ARB_fragment_program");
  features.vertex_program = has_word(extensions, "GL_ARB_vertex_program");
  features.rectangle = has_word(extensions, "GL_ARB_texture_rectangle") ||
                       has_word(extensions, "GL_NV_texture_rectangle") ||
                       has_word(extensions, "GL_EXT_texture_rectangle");
  features.texture_shader_formats = has_word(extensions, "GL_EXT_texture_snorm") &&
                                    has_word(extensions, "GL_ARB_texture_rg") &&
                                    has_word(extensions, "GL_ARB_texture_float");
  for (const ExtraExtension& one : kExtraExtensions) {
    if (has_word(extensions, one.name.data())) note_drivers_own(one.extra);
    const bool is_vertex_program = one.extra == Extra::vertex_program || one.extra == Extra::vertex_program1_1;
    if (!wanted_extras().have(one.extra) || has_word(extensions, one.name.data())) continue;
    if (is_vertex_program && !(features.vertex_program && holds_vertex_programs())) {
      log_once(std::string(one.name) +
               " needs GL_ARB_vertex_program with 96 parameters and 8 texture coordinates: it is not added");
    } else if (const auto base = extended(one.extra); base && !features.extras.have(*base)) {
      log_once(std::string(one.name) + " is not added to the driver's own extension that it extends");
    } else {
      features.extras.add(one.extra);
    }
  }
  features.texture_storage = has_word(extensions, "GL_ARB_texture_storage");
  return features;
}

}  // namespace ninebit::gl_layer
