// NV_vertex_program: attributes and their arrays. An attribute of a number is a conventional one, so that either kind
// of command sets it: 0 the position, 2 the normal, 3 and 4 the colours, 5 the fog coordinate, 8 to 15 texture
// coordinates. Attributes without one (1, 6 and 7) and arrays of attributes are those of ARB_vertex_program.
#include <algorithm>
#include <array>
#include <cstring>

#include "src/gl_layer/calls/display_lists.h"
#include "src/gl_layer/calls/vertex_program_call.h"
#include "src/gl_layer/context/context.h"
#include "src/gl_layer/driver/log.h"

using namespace ninebit::gl_layer;  // NOLINT(google-build-using-namespace): these are OpenGL's names

namespace {

constexpr auto kAttributes = static_cast<GLuint>(kVertexAttributes);

void set_conventional(GLuint index, const VertexVector& v) {
  switch (index) {
    case 0:
      return found_driver.Vertex4f(v[0], v[1], v[2], v[3]);
    case 2:
      if (v[3] != 1) {
        static LogOnce once;
        once.write("glVertexAttrib4NV: the fourth component of attribute 2, the normal, is lost");
      }
      return found_driver.Normal3f(v[0], v[1], v[2]);
    case 3:
      return found_driver.Color4f(v[0], v[1], v[2], v[3]);
    case 4:
      if (v[3] != 1) {
        static LogOnce once;
        once.write("glVertexAttrib4NV: the fourth component of attribute 4, the secondary colour, is lost");
      }
      return found_driver.SecondaryColor3f(v[0], v[1], v[2]);
    case 5:
      if (v[1] != 0 || v[2] != 0 || v[3] != 1) {
        static LogOnce once;
        once.write("glVertexAttribNV: attribute 5, the fog coordinate, has one component; the others are lost");
      }
      return found_driver.FogCoordf(v[0]);
    default:
      return found_driver.MultiTexCoord4f(GL_TEXTURE0 + index - 8, v[0], v[1], v[2], v[3]);
  }
}

// These commands may stand between glBegin and glEnd, where a list cannot hold their errors: they are raised at once.
void raise_value(Context& context) {
  context.next_in_begin() ? context.raise(GL_INVALID_VALUE) : raise_or_record(context, GL_INVALID_VALUE);
}

void set_attribute(GLuint index, const VertexVector& v) {
  Context& context = *current();
  if (index >= kAttributes) return raise_value(context);
  if ((kGenericAttributes >> index & 1) != 0) return found_driver.VertexAttrib4fARB(index, v[0], v[1], v[2], v[3]);
  set_conventional(index, v);
}

// The components that are given; 0, 0, 0 and 1 stand for the others. Bytes are 0 to 1.
template <int kSize, class T>
VertexVector components(const T* v) {
  VertexVector out{0, 0, 0, 1};
  for (std::size_t i = 0; i < kSize; ++i) {
    out[i] = std::is_same_v<T, GLubyte> ? static_cast<float>(v[i]) / 255 : static_cast<float>(v[i]);
  }
  return out;
}

template <int kSize, class T>
void attribute_of(GLuint index, const T* v) {
  set_attribute(index, components<kSize>(v));
}

// From the last to the first, so that attribute 0, which makes a vertex, comes last.
template <int kSize, class T>
void attributes_of(GLuint index, GLsizei count, const T* v) {
  if (count < 0 || index >= kAttributes || static_cast<GLuint>(count) > kAttributes - index) {
    return raise_value(*current());
  }
  for (auto i = static_cast<std::size_t>(count); i-- > 0;) {
    set_attribute(index + static_cast<GLuint>(i), components<kSize>(v + kSize * i));
  }
}

void attribute_1(GLuint index, GLdouble x) {
  attribute_of<1>(index, &x);
}
void attribute_2(GLuint index, GLdouble x, GLdouble y) {
  const GLdouble v[]{x, y};
  attribute_of<2>(index, v);
}
void attribute_3(GLuint index, GLdouble x, GLdouble y, GLdouble z) {
  const GLdouble v[]{x, y, z};
  attribute_of<3>(index, v);
}
void attribute_4(GLuint index, GLdouble x, GLdouble y, GLdouble z, GLdouble w) {
  const GLdouble v[]{x, y, z, w};
  attribute_of<4>(index, v);
}
void attribute_4_bytes(GLuint index, GLubyte x, GLubyte y, GLubyte z, GLubyte w) {
  const GLubyte v[]{x, y, z, w};
  attribute_of<4>(index, v);
}

void attribute_pointer(GLuint index, GLint size, GLenum type, GLsizei stride, const void* pointer) {
  Context& context = *current();
  if (!context.outside_begin()) return;
  const bool is_type = type == GL_UNSIGNED_BYTE || type == GL_SHORT || type == GL_FLOAT || type == GL_DOUBLE;
  if (index >= kAttributes || size < 1 || size > 4 || stride < 0) return context.raise(GL_INVALID_VALUE);
  if (!is_type) return context.raise(GL_INVALID_ENUM);
  if (type == GL_UNSIGNED_BYTE && size != 4) return context.raise(GL_INVALID_VALUE);
  found_driver.VertexAttribPointerARB(index, size, type, type == GL_UNSIGNED_BYTE ? GL_TRUE : GL_FALSE, stride,
                                      pointer);
  find_attribute_array(context, index);
}

VertexVector current_attribute(GLuint index) {
  VertexVector value{0, 0, 0, 1};
  switch (index) {
    case 2:
      found_driver.GetFloatv(GL_CURRENT_NORMAL, value.data());
      value[3] = 1;
      break;
    case 3:
      found_driver.GetFloatv(GL_CURRENT_COLOR, value.data());
      break;
    case 4:
      found_driver.GetFloatv(GL_CURRENT_SECONDARY_COLOR, value.data());
      value[3] = 1;
      break;
    case 5:
      found_driver.GetFloatv(GL_CURRENT_FOG_COORD, value.data());
      break;
    case 1:
    case 6:
    case 7:
      found_driver.GetVertexAttribfvARB(index, GL_CURRENT_VERTEX_ATTRIB, value.data());
      break;
    default: {
      const auto active = static_cast<GLenum>(driver_integer(GL_ACTIVE_TEXTURE));
      found_driver.ActiveTexture(GL_TEXTURE0 + index - 8);
      found_driver.GetFloatv(GL_CURRENT_TEXTURE_COORDS, value.data());
      found_driver.ActiveTexture(active);
    }
  }
  return value;
}

template <class T>
void get_attribute(GLuint index, GLenum pname, T* params) {
  Context& context = *current();
  if (!context.outside_begin()) return;
  if (index >= kAttributes) return context.raise(GL_INVALID_VALUE);
  switch (pname) {
    case GL_CURRENT_ATTRIB_NV: {
      if (index == 0) return context.raise(GL_INVALID_OPERATION);
      if (index >= 8 && !can_run_beside_list(context)) return;
      VertexVector value{};
      run_beside_list(context, [&] { value = current_attribute(index); });
      std::transform(value.begin(), value.end(), params, [](float x) { return static_cast<T>(x); });
      return;
    }
    case GL_ATTRIB_ARRAY_SIZE_NV:
    case GL_ATTRIB_ARRAY_STRIDE_NV:
    case GL_ATTRIB_ARRAY_TYPE_NV: {
      GLint value = 0;
      found_driver.GetVertexAttribivARB(index, pname, &value);  // the names have the same numbers
      *params = static_cast<T>(value);
      return;
    }
    default:
      context.raise(GL_INVALID_ENUM);
  }
}

void get_attribute_pointer(GLuint index, GLenum pname, void** pointer) {
  Context& context = *current();
  if (!context.outside_begin()) return;
  if (index >= kAttributes) return context.raise(GL_INVALID_VALUE);
  if (pname != GL_ATTRIB_ARRAY_POINTER_NV) return context.raise(GL_INVALID_ENUM);
  found_driver.GetVertexAttribPointervARB(index, pname, pointer);
}

// An element of an attribute array that can be read.
VertexVector element(const AttributeArray& array, GLint number) {
  const auto size = static_cast<std::size_t>(array.size);
  const std::size_t bytes = array.type == GL_UNSIGNED_BYTE ? 1
                            : array.type == GL_SHORT       ? 2
                            : array.type == GL_FLOAT       ? 4
                                                           : 8;
  const std::ptrdiff_t stride = array.stride != 0 ? array.stride : static_cast<std::ptrdiff_t>(size * bytes);
  const auto* const begin = static_cast<const unsigned char*>(array.pointer) + stride * number;
  VertexVector out{0, 0, 0, 1};
  for (std::size_t i = 0; i < size; ++i) {
    const auto read = [&](auto value) {
      std::memcpy(&value, begin + i * bytes, sizeof(value));
      return static_cast<float>(value);
    };
    if (array.type == GL_UNSIGNED_BYTE) out[i] = read(GLubyte{}) / 255;
    if (array.type == GL_SHORT) out[i] = read(GLshort{});
    if (array.type == GL_FLOAT) out[i] = read(GLfloat{});
    if (array.type == GL_DOUBLE) out[i] = read(GLdouble{});
  }
  return out;
}

}  // namespace

// Its attribute arrays set attributes as glVertexAttribNV does, which the driver's function does for those without a
// conventional one and for the position.
GLAPI void GLAPIENTRY glArrayElement(GLint i) {
  Context* const context = current();
  if (context != nullptr && element_arrays(*context) != 0) {
    if (!context->next_in_begin()) find_element_arrays(*context);
    const unsigned arrays = element_arrays(*context);
    for (GLuint k = 0; k < kAttributes; ++k) {
      if ((arrays >> k & 1) == 0) continue;
      const AttributeArray& array = context->vertex.array[k];
      if (array.is_readable) {
        set_conventional(k, element(array, i));
      } else {
        static LogOnce once;
        once.write(
            "glArrayElement with an attribute array in a buffer, or of a format that glVertexAttribPointerNV does "
            "not have: the attribute stays as it is");
      }
    }
  }
  const auto call = find_driver().ArrayElement;
  if (call != nullptr) call(i);
}

// Functions of other extensions after which other attribute arrays may be enabled.
#define NINEBIT_ARRAY_ENABLE(name)                                                              \
  GLAPI void GLAPIENTRY gl##name(GLuint index) {                                                \
    const auto call = find_driver().name;                                                       \
    if (call != nullptr) call(index);                                                           \
    Context* const context = current();                                                         \
    const bool is_one = call != nullptr && index < kAttributes && has_vertex_programs(context); \
    if (is_one && !context->in_begin) find_attribute_array(*context, index);                    \
  }
NINEBIT_ARRAY_ENABLE(DisableVertexAttribArray)
NINEBIT_ARRAY_ENABLE(DisableVertexAttribArrayARB)
NINEBIT_ARRAY_ENABLE(EnableVertexAttribArray)
NINEBIT_ARRAY_ENABLE(EnableVertexAttribArrayARB)

#define NINEBIT_VERTEX_ARRAY_OBJECTS(name, parameters, arguments)                            \
  GLAPI void GLAPIENTRY gl##name parameters {                                                \
    const auto call = find_driver().name;                                                    \
    if (call != nullptr) call arguments;                                                     \
    Context* const context = current();                                                      \
    if (has_vertex_programs(context) && !context->in_begin) find_attribute_arrays(*context); \
  }
NINEBIT_VERTEX_ARRAY_OBJECTS(BindVertexArray, (GLuint array), (array))
NINEBIT_VERTEX_ARRAY_OBJECTS(DeleteVertexArrays, (GLsizei n, const GLuint* arrays), (n, arrays))

#define NINEBIT_ATTRIBUTES(letter, type)                                                                          \
  NINEBIT_VERTEX_PROCEDURE(VertexAttrib1##letter##NV, (GLuint index, type x), (index, x), attribute_1)            \
  NINEBIT_VERTEX_PROCEDURE(VertexAttrib2##letter##NV, (GLuint index, type x, type y), (index, x, y), attribute_2) \
  NINEBIT_VERTEX_PROCEDURE(VertexAttrib3##letter##NV, (GLuint index, type x, type y, type z), (index, x, y, z),   \
                           attribute_3)                                                                           \
  NINEBIT_VERTEX_PROCEDURE(VertexAttrib4##letter##NV, (GLuint index, type x, type y, type z, type w),             \
                           (index, x, y, z, w), attribute_4)                                                      \
  NINEBIT_ATTRIBUTE_VECTORS(1, letter, type)                                                                      \
  NINEBIT_ATTRIBUTE_VECTORS(2, letter, type)                                                                      \
  NINEBIT_ATTRIBUTE_VECTORS(3, letter, type)                                                                      \
  NINEBIT_ATTRIBUTE_VECTORS(4, letter, type)
#define NINEBIT_ATTRIBUTE_VECTORS(size, letter, type)                                                      \
  NINEBIT_VERTEX_PROCEDURE(VertexAttrib##size##letter##vNV, (GLuint index, const type* v), (index, v),     \
                           attribute_of<size>)                                                             \
  NINEBIT_VERTEX_PROCEDURE(VertexAttribs##size##letter##vNV, (GLuint index, GLsizei count, const type* v), \
                           (index, count, v), attributes_of<size>)

NINEBIT_ATTRIBUTES(d, GLdouble)
NINEBIT_ATTRIBUTES(f, GLfloat)
NINEBIT_ATTRIBUTES(s, GLshort)
NINEBIT_VERTEX_PROCEDURE(VertexAttrib4ubNV, (GLuint index, GLubyte x, GLubyte y, GLubyte z, GLubyte w),
                         (index, x, y, z, w), attribute_4_bytes)
NINEBIT_ATTRIBUTE_VECTORS(4, ub, GLubyte)
NINEBIT_VERTEX_PROCEDURE(VertexAttribPointerNV,
                         (GLuint index, GLint fsize, GLenum type, GLsizei stride, const void* pointer),
                         (index, fsize, type, stride, pointer), attribute_pointer)
NINEBIT_VERTEX_PROCEDURE(GetVertexAttribdvNV, (GLuint index, GLenum pname, GLdouble* params), (index, pname, params),
                         get_attribute)
NINEBIT_VERTEX_PROCEDURE(GetVertexAttribfvNV, (GLuint index, GLenum pname, GLfloat* params), (index, pname, params),
                         get_attribute)
NINEBIT_VERTEX_PROCEDURE(GetVertexAttribivNV, (GLuint index, GLenum pname, GLint* params), (index, pname, params),
                         get_attribute)
NINEBIT_VERTEX_PROCEDURE(GetVertexAttribPointervNV, (GLuint index, GLenum pname, void** pointer),
                         (index, pname, pointer), get_attribute_pointer)
