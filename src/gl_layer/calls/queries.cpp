// Answers to a program's queries of a context: the extension string, and the values of the extensions' state.
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "src/gl_layer/context/context.h"
#include "src/gl_layer/draw/vertex_programs.h"
#include "src/gl_layer/driver/driver.h"
#include "src/gl_layer/driver/driver_features.h"

using namespace ninebit::gl_layer;  // NOLINT(google-build-using-namespace): these are OpenGL's names
namespace front = ninebit::gl;

namespace {

// The extensions that the layer adds. A driver that has one itself lists it already.
std::vector<const char*> added_extensions(const Context& context) {
  std::vector<const char*> names{"GL_NV_register_combiners"};
  if (context.combiners.profile().per_stage_constants) names.push_back("GL_NV_register_combiners2");
  if (context.combiners.profile().texture_shaders && context.features.texture_shader_formats) {
    names.push_back("GL_NV_texture_shader");
    names.push_back("GL_NV_texture_shader2");
  }
  for (const ExtraExtension& one : kExtraExtensions) {
    if (context.features.extras.have(one.extra)) names.push_back(one.name.data());
  }
  const auto* const listed = reinterpret_cast<const char*>(found_driver.GetString(GL_EXTENSIONS));
  std::erase_if(names, [&](const char* name) { return listed != nullptr && has_word(listed, name); });
  return names;
}

const GLubyte* extension_string(Context& context) {
  const auto* const listed = reinterpret_cast<const char*>(found_driver.GetString(GL_EXTENSIONS));
  if (listed == nullptr) return nullptr;
  if (context.extensions.empty()) {
    context.extensions = listed;
    for (const char* name : added_extensions(context)) {
      if (!context.extensions.empty() && context.extensions.back() != ' ') context.extensions += ' ';
      context.extensions += name;
    }
  }
  return reinterpret_cast<const GLubyte*>(context.extensions.c_str());
}

GLint number_of_driver_extensions() {
  return driver_integer(GL_NUM_EXTENSIONS);
}

bool is_pixel_transfer(GLenum pname) {
  return pname >= GL_HI_SCALE_NV && pname <= GL_VIBRANCE_BIAS_NV;
}

// The value of GL_NV_vertex_program's state.
GLint vertex_program_value(const Context& context, GLenum pname) {
  const VertexProgramState& state = context.vertex;
  switch (pname) {
    case GL_VERTEX_PROGRAM_BINDING_NV:
      return static_cast<GLint>(bound_vertex_program(context));
    case GL_PROGRAM_ERROR_POSITION_NV:
      return state.error_position;
    case GL_MATRIX_MODE: {
      const GLint mode = driver_integer(GL_MATRIX_MODE);
      const bool has_nv_name = mode != 0 && static_cast<GLenum>(mode) == state.matrix_mode;
      return has_nv_name ? mode - GL_MATRIX0_ARB + GL_MATRIX0_NV : mode;
    }
    default:
      return static_cast<GLint>(state.arrays >> (pname - GL_VERTEX_ATTRIB_ARRAY0_NV) & 1);
  }
}

// The number of values that a query of the layer's state returns; 0: the state is the driver's.
int number_of_values(const Context& context, GLenum pname) {
  switch (pname) {
    case GL_CONSTANT_COLOR0_NV:
    case GL_CONSTANT_COLOR1_NV:
      return 4;
    case GL_REGISTER_COMBINERS_NV:
    case GL_NUM_GENERAL_COMBINERS_NV:
    case GL_MAX_GENERAL_COMBINERS_NV:
    case GL_COLOR_SUM_CLAMP_NV:
    case GL_NUM_EXTENSIONS:
      return 1;
    case GL_LIST_INDEX:
      return context.open_list != nullptr ? 1 : 0;  // the driver may have another list open
    case GL_CURRENT_PROGRAM:
      return context.bound ? 1 : 0;
    case GL_PER_STAGE_CONSTANTS_NV:
      return context.combiners.profile().per_stage_constants ? 1 : 0;
    case GL_TEXTURE_SHADER_NV:
      return context.combiners.profile().texture_shaders ? 1 : 0;
    case GL_VERTEX_ARRAY_RANGE_NV:
    case GL_VERTEX_ARRAY_RANGE_LENGTH_NV:
    case GL_VERTEX_ARRAY_RANGE_VALID_NV:
    case GL_MAX_VERTEX_ARRAY_RANGE_ELEMENT_NV:
      return context.features.extras.have(Extra::vertex_array_range) ? 1 : 0;
    case GL_SHARED_TEXTURE_PALETTE_EXT:
      return context.features.extras.have(Extra::shared_texture_palette) ? 1 : 0;
    case GL_VERTEX_PROGRAM_BINDING_NV:
    case GL_MATRIX_MODE:
      return has_vertex_programs(&context) ? 1 : 0;
    case GL_PROGRAM_ERROR_POSITION_NV:
      return context.vertex.has_error_position ? 1 : 0;
    default:
      if (is_attribute_array(&context, pname)) return 1;
      return is_pixel_transfer(pname) && context.combiners.profile().texture_shaders ? 1 : 0;
  }
}

// The value of GL_NV_vertex_array_range's state.
GLint range_value(const VertexRange& range, GLenum pname) {
  switch (pname) {
    case GL_VERTEX_ARRAY_RANGE_LENGTH_NV:
      return range.length;
    case GL_VERTEX_ARRAY_RANGE_VALID_NV:
      return range.enabled && range.length != 0 ? 1 : 0;
    case GL_MAX_VERTEX_ARRAY_RANGE_ELEMENT_NV:
      return 0xFFFF;  // the least that a driver may have; no index is too large here
    default:
      return range.enabled ? 1 : 0;
  }
}

// The state as floats, as integers by `integers`.
void values_of(Context& context, GLenum pname, GLfloat* floats, GLint* integers) {
  if (is_pixel_transfer(pname)) {
    *floats = context.pixel_transfer[pname - GL_HI_SCALE_NV];
    *integers = static_cast<GLint>(std::lround(*floats));
    return;
  }
  if (pname == GL_TEXTURE_SHADER_NV) {
    *integers = context.combiners.texture_shader().enabled ? 1 : 0;
  } else if (pname >= GL_VERTEX_ARRAY_RANGE_NV && pname <= GL_MAX_VERTEX_ARRAY_RANGE_ELEMENT_NV) {
    *integers = range_value(context.vertex_range, pname);
  } else if (pname == GL_SHARED_TEXTURE_PALETTE_EXT) {
    *integers = context.shared_palette.enabled ? 1 : 0;
  } else if (pname == GL_LIST_INDEX) {
    *integers = static_cast<GLint>(context.open_list->number);
  } else if (pname == GL_CURRENT_PROGRAM) {
    *integers = static_cast<GLint>(context.app_program);
  } else if (pname == GL_VERTEX_PROGRAM_BINDING_NV || pname == GL_PROGRAM_ERROR_POSITION_NV ||
             pname == GL_MATRIX_MODE || is_attribute_array(&context, pname)) {
    *integers = vertex_program_value(context, pname);
  } else if (pname == GL_NUM_EXTENSIONS) {
    *integers = number_of_driver_extensions() + static_cast<GLint>(added_extensions(context).size());
  } else {
    const front::CurrentContext current(context.combiners);
    front::glGetFloatv(pname, floats);
    return front::glGetIntegerv(pname, integers);
  }
  *floats = static_cast<GLfloat>(*integers);
}

enum class QueryType : std::uint8_t { booleans, integers, floats };

// Answers a query of the layer's state; false: it is the driver's.
template <class T>
bool answer(GLenum pname, T* params, QueryType type) {
  Context* const context = current();
  const int number = context != nullptr ? number_of_values(*context, pname) : 0;
  if (number == 0) return false;
  if (!context->outside_begin()) return true;
  if (params == nullptr) {
    context->raise(GL_INVALID_VALUE);
    return true;
  }
  GLfloat floats[4]{};
  GLint integers[4]{};
  values_of(*context, pname, floats, integers);
  for (int i = 0; i < number; ++i) {
    switch (type) {
      case QueryType::booleans:
        params[i] = static_cast<T>(floats[i] != 0.0F ? 1 : 0);
        break;
      case QueryType::integers:
        params[i] = static_cast<T>(integers[i]);
        break;
      case QueryType::floats:
        params[i] = static_cast<T>(floats[i]);
        break;
    }
  }
  return true;
}

}  // namespace

GLAPI void GLAPIENTRY glGetBooleanv(GLenum pname, GLboolean* params) {
  if (!answer(pname, params, QueryType::booleans)) find_driver().GetBooleanv(pname, params);
}

GLAPI void GLAPIENTRY glGetIntegerv(GLenum pname, GLint* params) {
  if (!answer(pname, params, QueryType::integers)) find_driver().GetIntegerv(pname, params);
}

GLAPI void GLAPIENTRY glGetFloatv(GLenum pname, GLfloat* params) {
  if (!answer(pname, params, QueryType::floats)) find_driver().GetFloatv(pname, params);
}

GLAPI void GLAPIENTRY glGetDoublev(GLenum pname, GLdouble* params) {
  if (!answer(pname, params, QueryType::floats)) find_driver().GetDoublev(pname, params);
}

GLAPI GLhandleARB GLAPIENTRY glGetHandleARB(GLenum pname) {
  const Context* const context = current();
  if (context != nullptr && context->bound && pname == GL_PROGRAM_OBJECT_ARB) return context->app_program;
  const auto get = find_driver().GetHandleARB;
  return get != nullptr ? get(pname) : 0;
}

GLAPI const GLubyte* GLAPIENTRY glGetString(GLenum name) {
  Context* const context = current();
  if (context == nullptr || name != GL_EXTENSIONS || context->in_begin) return find_driver().GetString(name);
  return extension_string(*context);
}

GLAPI const GLubyte* GLAPIENTRY glGetStringi(GLenum name, GLuint index) {
  const auto get = find_driver().GetStringi;
  if (get == nullptr) return nullptr;
  Context* const context = current();
  if (context == nullptr || name != GL_EXTENSIONS || context->in_begin) return get(name, index);
  const auto listed = static_cast<GLuint>(number_of_driver_extensions());
  const auto added = added_extensions(*context);
  if (index < listed || index - listed >= added.size()) return get(name, index);
  return reinterpret_cast<const GLubyte*>(added[index - listed]);
}
