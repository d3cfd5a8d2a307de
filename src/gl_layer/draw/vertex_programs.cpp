#include "src/gl_layer/draw/vertex_programs.h"

#include <atomic>
#include <cmath>
#include <utility>

#include "src/gl_layer/driver/driver.h"
#include "src/gl_layer/driver/log.h"
#include "src/gl_layer/driver/lookups.h"

namespace ninebit::gl_layer {
namespace {

// As for display lists: a number that the driver has not given out, far from those that programs count from 1.
unsigned unused_name(SharedVertexPrograms& shared) {
  static std::atomic<unsigned> next{0x40000000U};
  unsigned name = --next;
  while (found_driver.IsProgramARB(name) == GL_TRUE) name = --next;
  shared.driver_names.insert(name);
  shared.has_driver_names = true;
  return name;
}

// With the group's mutex.
unsigned name_without_text(SharedVertexPrograms& shared) {
  if (shared.without_text == 0) shared.without_text = unused_name(shared);
  return shared.without_text;
}

// Leaves the new program bound. 0: the driver refuses it.
unsigned make_variant(SharedVertexPrograms& shared, const std::string& text) {
  note_use(Asked::vertex_program);
  const unsigned name = unused_name(shared);
  found_driver.BindProgramARB(GL_VERTEX_PROGRAM_ARB, name);
  const GLenum before = found_driver.GetError();
  found_driver.ProgramStringARB(GL_VERTEX_PROGRAM_ARB, GL_PROGRAM_FORMAT_ASCII_ARB, static_cast<GLsizei>(text.size()),
                                text.data());
  const bool failed = found_driver.GetError() != GL_NO_ERROR;
  if (Context* const context = current(); before != GL_NO_ERROR && context != nullptr) context->raise(before);
  if (!failed) return name;
  const auto* const why = reinterpret_cast<const char*>(found_driver.GetString(GL_PROGRAM_ERROR_STRING_ARB));
  log_line("the driver refuses a vertex program: " + std::string(why != nullptr ? why : "") + '\n' + text);
  found_driver.DeleteProgramsARB(1, &name);
  shared.driver_names.erase(name);
  return 0;
}

using Matrix = std::array<double, 16>;  // by columns, as OpenGL has them

Matrix driver_matrix(GLenum name) {
  Matrix matrix{};
  found_driver.GetDoublev(name, matrix.data());
  return matrix;
}

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix out{};
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 4; ++row) {
      for (std::size_t k = 0; k < 4; ++k) out[4 * column + row] += a[4 * k + row] * b[4 * column + k];
    }
  }
  return out;
}

Matrix transposed(const Matrix& of) {
  Matrix out{};
  for (std::size_t i = 0; i < 16; ++i) out[4 * (i % 4) + i / 4] = of[i];
  return out;
}

// By Gauss and Jordan, with the largest pivot of a column. A matrix without an inverse gives the identity.
Matrix inverse(Matrix of) {
  Matrix out{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const Matrix identity = out;
  for (std::size_t k = 0; k < 4; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < 4; ++i) {
      if (std::fabs(of[4 * i + k]) > std::fabs(of[4 * pivot + k])) pivot = i;
    }
    if (of[4 * pivot + k] == 0) return identity;
    for (std::size_t i = 0; i < 4; ++i) {
      std::swap(of[4 * k + i], of[4 * pivot + i]);
      std::swap(out[4 * k + i], out[4 * pivot + i]);
    }
    const double by = of[4 * k + k];
    for (std::size_t i = 0; i < 4; ++i) {
      of[4 * k + i] /= by;
      out[4 * k + i] /= by;
    }
    for (std::size_t column = 0; column < 4; ++column) {
      const double times = column == k ? 0.0 : of[4 * column + k];
      for (std::size_t i = 0; i < 4; ++i) {
        of[4 * column + i] -= times * of[4 * k + i];
        out[4 * column + i] -= times * out[4 * k + i];
      }
    }
  }
  return out;
}

Matrix source_matrix(const TrackedMatrix& of) {
  switch (of.source) {
    case MatrixSource::modelview:
      return driver_matrix(GL_MODELVIEW_MATRIX);
    case MatrixSource::projection:
      return driver_matrix(GL_PROJECTION_MATRIX);
    case MatrixSource::texture: {
      const auto active = static_cast<GLenum>(driver_integer(GL_ACTIVE_TEXTURE));
      found_driver.ActiveTexture(GL_TEXTURE0 + of.number);
      const Matrix matrix = driver_matrix(GL_TEXTURE_MATRIX);
      found_driver.ActiveTexture(active);
      return matrix;
    }
    case MatrixSource::program: {
      const auto mode = static_cast<GLenum>(driver_integer(GL_MATRIX_MODE));
      found_driver.MatrixMode(GL_MATRIX0_ARB + of.number);
      const Matrix matrix = driver_matrix(GL_CURRENT_MATRIX_ARB);
      found_driver.MatrixMode(mode);
      return matrix;
    }
    default:
      return product(driver_matrix(GL_PROJECTION_MATRIX), driver_matrix(GL_MODELVIEW_MATRIX));
  }
}

}  // namespace

void bind_vertex_program(Context& context, unsigned arrays) {
  VertexProgramState& state = context.vertex;
  state.drawn_arrays = arrays;
  if (!state.is_bound) return;
  const std::lock_guard lock(context.group->mutex);
  SharedVertexPrograms& shared = context.group->vertex_programs;
  const VertexProgram& program = state.object->program;
  const VertexVariant variant{read_matrices(program, state.matrices), arrays & program.attributes};
  const auto [known, is_new] = state.object->variants.try_emplace(variant, 0U);
  if (is_new) {
    known->second = make_variant(shared, translate_vertex_program(program, variant.first, variant.second));
    state.driver_name = known->second;
  }
  const unsigned name = known->second != 0 ? known->second : name_without_text(shared);
  if (name != state.driver_name) found_driver.BindProgramARB(GL_VERTEX_PROGRAM_ARB, name);
  state.driver_name = name;
}

namespace {

// Other functions that set arrays have more formats: integers of other types, GL_BGRA for the number of components.
bool is_format_of_nv(unsigned type, int size, bool normalized) {
  if (size < 1 || size > 4) return false;
  if (type == GL_UNSIGNED_BYTE) return normalized;
  return type == GL_FLOAT || type == GL_DOUBLE || (type == GL_SHORT && !normalized);
}

}  // namespace

void find_attribute_array(Context& context, unsigned index) {
  const auto get = [index](GLenum pname) {
    GLint value = 0;
    found_driver.GetVertexAttribivARB(index, pname, &value);
    return value;
  };
  void* pointer = nullptr;
  found_driver.GetVertexAttribPointervARB(index, GL_VERTEX_ATTRIB_ARRAY_POINTER, &pointer);
  const unsigned bit = 1U << index;
  const bool enabled = get(GL_VERTEX_ATTRIB_ARRAY_ENABLED) != 0;
  context.vertex.arrays = enabled ? context.vertex.arrays | bit : context.vertex.arrays & ~bit;
  AttributeArray& array = context.vertex.array[index];
  array = {.type = static_cast<unsigned>(get(GL_VERTEX_ATTRIB_ARRAY_TYPE)),
           .size = get(GL_VERTEX_ATTRIB_ARRAY_SIZE),
           .stride = get(GL_VERTEX_ATTRIB_ARRAY_STRIDE),
           .pointer = pointer};
  array.is_readable = pointer != nullptr && get(GL_VERTEX_ATTRIB_ARRAY_BUFFER_BINDING) == 0 &&
                      is_format_of_nv(array.type, array.size, get(GL_VERTEX_ATTRIB_ARRAY_NORMALIZED) != 0);
}

unsigned bound_vertex_program(const Context& context) {
  if (context.vertex.is_bound) return context.vertex.name;
  GLint name = 0;
  found_driver.GetProgramivARB(GL_VERTEX_PROGRAM_ARB, GL_PROGRAM_BINDING_ARB, &name);
  return static_cast<unsigned>(name);
}

void find_attribute_arrays(Context& context) {
  for (unsigned i = 0; i < static_cast<unsigned>(kVertexAttributes); ++i) find_attribute_array(context, i);
}

void find_element_arrays(Context& context) {
  const unsigned arrays = element_arrays(context);
  for (unsigned i = 0; i < static_cast<unsigned>(kVertexAttributes); ++i) {
    if ((arrays >> i & 1) != 0) find_attribute_array(context, i);
  }
}

std::array<VertexVector, 4> rows_of(const TrackedMatrix& matrix) {
  Matrix values = source_matrix(matrix);
  const bool inverts =
      matrix.transform == MatrixTransform::inverse || matrix.transform == MatrixTransform::inverse_transpose;
  if (inverts) values = inverse(values);
  const bool transposes =
      matrix.transform == MatrixTransform::transpose || matrix.transform == MatrixTransform::inverse_transpose;
  if (transposes) values = transposed(values);
  std::array<VertexVector, 4> rows{};
  for (std::size_t i = 0; i < 16; ++i) rows[i % 4][i / 4] = static_cast<float>(values[i]);
  return rows;
}

void delete_variants(Context& context, VertexProgramObject& object) {
  const std::lock_guard lock(context.group->mutex);
  for (const auto& [variant, name] : object.variants) {
    if (name == 0) continue;
    context.group->vertex_programs.driver_names.erase(name);
    found_driver.DeleteProgramsARB(1, &name);
  }
  object.variants.clear();
}

}  // namespace ninebit::gl_layer
