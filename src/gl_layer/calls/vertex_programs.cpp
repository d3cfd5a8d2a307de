// NV_vertex_program: programs, their parameters and tracked matrices. vertex_attributes.cpp has the vertices.
#include <algorithm>
#include <cstring>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "src/gl_layer/calls/display_lists.h"
#include "src/gl_layer/calls/vertex_program_call.h"
#include "src/gl_layer/context/context.h"
#include "src/gl_layer/driver/log.h"

using namespace ninebit::gl_layer;  // NOLINT(google-build-using-namespace): these are OpenGL's names

namespace {

std::shared_ptr<VertexProgramObject> find_object(Context& context, GLuint name) {
  const std::lock_guard lock(context.group->mutex);
  const auto& all = context.group->vertex_programs.by_name;
  const auto found = all.find(name);
  return found != all.end() ? found->second : nullptr;
}

// Whether it is one of the layer's own programs, which are none to the program that runs.
bool is_layers(Context& context, GLuint name) {
  SharedVertexPrograms& shared = context.group->vertex_programs;
  if (!shared.has_driver_names) return false;
  const std::lock_guard lock(context.group->mutex);
  return shared.driver_names.contains(name);
}

// The programs of this extension and of ARB_vertex_program have the same names: the driver knows all of them.
bool exists(Context& context, GLuint name) {
  return find_object(context, name) != nullptr ||
         (!is_layers(context, name) && found_driver.IsProgramARB(name) == GL_TRUE);
}

// Runs a command that can go into a display list; what it captures must be values.
template <class Command>
void run(const Command& command) {
  Context& context = *current();
  if (context.open_list != nullptr) {
    if (context.list_in_begin()) return record_begin_error(context);
    return record(context, [command] { run(command); });
  }
  if (context.outside_begin()) command(context);
}

// The context for a command that is executed at once; nullptr: between glBegin and glEnd.
Context* at_once() {
  Context* const context = current();
  return context->outside_begin() ? context : nullptr;
}

// After a change of the program that is bound, or of what its translation depends on.
void rebind(Context& context) {
  bind_vertex_program(context, context.vertex.drawn_arrays);
}

void set_bound(Context& context, GLuint name, std::shared_ptr<VertexProgramObject> object) {
  context.vertex.is_bound = object != nullptr;
  context.vertex.name = object != nullptr ? name : 0;
  context.vertex.object = std::move(object);
  context.vertex.driver_name = 0;
}

// A program without a text of this extension is the driver's.
void bind_now(Context& context, GLuint name) {
  auto object = find_object(context, name);
  if (object != nullptr && object->target == GL_VERTEX_STATE_PROGRAM_NV) return context.raise(GL_INVALID_OPERATION);
  if (object != nullptr) {
    set_bound(context, name, std::move(object));
    return rebind(context);
  }
  const GLuint visible = is_layers(context, name) ? ~0U : name;
  found_driver.BindProgramARB(GL_VERTEX_PROGRAM_ARB, visible);
  GLint bound = 0;
  found_driver.GetProgramivARB(GL_VERTEX_PROGRAM_ARB, GL_PROGRAM_BINDING_ARB, &bound);
  if (static_cast<GLuint>(bound) == visible) set_bound(context, 0, nullptr);  // otherwise the driver has refused it
}

void bind_program(GLenum target, GLuint name) {
  run([=](Context& context) {
    if (target != GL_VERTEX_PROGRAM_NV) return context.raise(GL_INVALID_ENUM);
    bind_now(context, name);
  });
}

void delete_program(Context& context, GLuint name) {
  if (name == 0 || is_layers(context, name)) return;
  const auto object = find_object(context, name);
  if (object != nullptr) {
    if (context.vertex.is_bound && context.vertex.name == name) {
      if (!can_run_beside_list(context)) return;
      set_bound(context, 0, nullptr);
      run_beside_list(context, [] { found_driver.BindProgramARB(GL_VERTEX_PROGRAM_ARB, 0); });
    }
    {
      const std::lock_guard lock(context.group->mutex);
      context.group->vertex_programs.by_name.erase(name);
    }
    delete_variants(context, *object);
  }
  found_driver.DeleteProgramsARB(1, &name);
}

void delete_programs(GLsizei n, const GLuint* names) {
  Context* const context = at_once();
  if (context == nullptr) return;
  if (n < 0) return context->raise(GL_INVALID_VALUE);
  for (GLsizei i = 0; i < n; ++i) delete_program(*context, names[i]);
}

void generate_programs(GLsizei n, GLuint* names) {
  Context* const context = at_once();
  if (context == nullptr) return;
  if (n < 0) return context->raise(GL_INVALID_VALUE);
  found_driver.GenProgramsARB(n, names);
}

GLboolean is_program(GLuint name) {
  Context* const context = at_once();
  return context != nullptr && exists(*context, name) ? GL_TRUE : GL_FALSE;
}

// Makes a name known to the driver, which then gives it to no other program. False: it is that of another target.
bool reserve(Context& context, GLuint name) {
  const GLenum before = found_driver.GetError();
  GLint bound = 0;
  found_driver.GetProgramivARB(GL_VERTEX_PROGRAM_ARB, GL_PROGRAM_BINDING_ARB, &bound);
  found_driver.BindProgramARB(GL_VERTEX_PROGRAM_ARB, name);
  const bool is_ours = found_driver.GetError() == GL_NO_ERROR;
  found_driver.BindProgramARB(GL_VERTEX_PROGRAM_ARB, static_cast<GLuint>(bound));
  if (before != GL_NO_ERROR) context.raise(before);
  return is_ours;
}

void load_program(GLenum target, GLuint name, const std::string& text) {
  run([=](Context& context) {
    using ninebit::gl_layer::VertexProgramKind;
    if (target != GL_VERTEX_PROGRAM_NV && target != GL_VERTEX_STATE_PROGRAM_NV) return context.raise(GL_INVALID_ENUM);
    if (name == 0) return context.raise(GL_INVALID_VALUE);
    const auto before = find_object(context, name);
    const bool is_bound = bound_vertex_program(context) == name;
    const bool is_other = before != nullptr && before->target != target;
    if (is_other || (is_bound && target != GL_VERTEX_PROGRAM_NV)) return context.raise(GL_INVALID_OPERATION);
    const auto kind = target == GL_VERTEX_PROGRAM_NV ? VertexProgramKind::vertex : VertexProgramKind::state;
    VertexFault fault;
    auto program = parse_vertex_program(text, kind, context.features.extras.have(Extra::vertex_program1_1), fault);
    context.vertex.has_error_position = true;
    context.vertex.error_position = program ? -1 : static_cast<int>(fault.position);
    if (!program) {
      log_once("a vertex program is refused at byte " + std::to_string(fault.position) + ": " + fault.message);
      return context.raise(GL_INVALID_OPERATION);
    }
    if (before == nullptr && (is_layers(context, name) || !reserve(context, name))) {
      return context.raise(GL_INVALID_OPERATION);
    }
    // Another thread may be drawing with the object of before: it stays as it is.
    const auto object = std::make_shared<VertexProgramObject>();
    object->target = target;
    object->text = text;
    object->program = std::move(*program);
    std::shared_ptr<VertexProgramObject> replaced = object;
    {
      const std::lock_guard lock(context.group->mutex);
      std::swap(context.group->vertex_programs.by_name[name], replaced);
    }
    if (replaced != nullptr) delete_variants(context, *replaced);
    if (!is_bound) return;
    set_bound(context, name, object);
    rebind(context);
  });
}

void load_program_text(GLenum target, GLuint name, GLsizei length, const GLubyte* text) {
  Context& context = *current();
  if (length < 0 || text == nullptr) {
    if (context.outside_begin()) raise_or_record(context, GL_INVALID_VALUE);
    return;
  }
  load_program(target, name, std::string(reinterpret_cast<const char*>(text), static_cast<std::size_t>(length)));
}

// Whether these are names of programs; otherwise an error is raised.
Context* context_of_programs(GLsizei n, const GLuint* names) {
  Context* const context = at_once();
  if (context == nullptr) return nullptr;
  bool all = n >= 0;
  for (GLsizei i = 0; i < n; ++i) all = all && exists(*context, names[i]);
  if (all) return context;
  context->raise(GL_INVALID_VALUE);
  return nullptr;
}

GLboolean are_resident(GLsizei n, const GLuint* names, GLboolean*) {
  return context_of_programs(n, names) != nullptr ? GL_TRUE : GL_FALSE;  // all are
}

void request_resident(GLsizei n, const GLuint* names) {
  static_cast<void>(context_of_programs(n, names));
}

void get_program(GLuint name, GLenum pname, GLint* params) {
  Context* const context = at_once();
  if (context == nullptr) return;
  const auto object = find_object(*context, name);
  if (object == nullptr) return context->raise(GL_INVALID_OPERATION);
  switch (pname) {
    case GL_PROGRAM_TARGET_NV:
      *params = static_cast<GLint>(object->target);
      return;
    case GL_PROGRAM_LENGTH_NV:
      *params = static_cast<GLint>(object->text.size());
      return;
    case GL_PROGRAM_RESIDENT_NV:
      *params = GL_TRUE;
      return;
    default:
      context->raise(GL_INVALID_ENUM);
  }
}

void get_program_text(GLuint name, GLenum pname, GLubyte* text) {
  Context* const context = at_once();
  if (context == nullptr) return;
  if (pname != GL_PROGRAM_STRING_NV) return context->raise(GL_INVALID_ENUM);
  const auto object = find_object(*context, name);
  if (object == nullptr) return context->raise(GL_INVALID_OPERATION);
  std::copy(object->text.begin(), object->text.end(), text);  // without a 0 behind it
}

// Parameters are the driver's, which records them in its lists.
void set_parameters(GLenum target, GLuint index, GLsizei count, const GLfloat* values) {
  Context& context = *current();
  if (!context.outside_begin()) return;
  if (target != GL_VERTEX_PROGRAM_NV) return raise_or_record(context, GL_INVALID_ENUM);
  const auto end = static_cast<GLuint>(kVertexParameters);
  const bool is_range = count >= 0 && index < end && static_cast<GLuint>(count) <= end - index;
  if (!is_range) return raise_or_record(context, GL_INVALID_VALUE);
  for (GLuint i = 0; i < static_cast<GLuint>(count); ++i) {
    found_driver.ProgramEnvParameter4fvARB(GL_VERTEX_PROGRAM_ARB, index + i, values + 4 * static_cast<std::size_t>(i));
  }
}

void set_parameters(GLenum target, GLuint index, GLsizei count, const GLdouble* values) {
  const std::size_t size = count > 0 && count <= kVertexParameters ? 4 * static_cast<std::size_t>(count) : 0;
  std::vector<GLfloat> floats(size);
  std::transform(values, values + size, floats.begin(), [](GLdouble x) { return static_cast<GLfloat>(x); });
  set_parameters(target, index, count, floats.data());
}

void set_parameter(GLenum target, GLuint index, const GLfloat* values) {
  set_parameters(target, index, 1, values);
}
void set_parameter(GLenum target, GLuint index, const GLdouble* values) {
  set_parameters(target, index, 1, values);
}
template <class T>
void set_parameter(GLenum target, GLuint index, T x, T y, T z, T w) {
  const T values[]{x, y, z, w};
  set_parameters(target, index, 1, values);
}

VertexVector parameter(const Context& context, GLuint index) {
  const TrackedMatrix& tracked = context.vertex.matrices[index / 4];
  if (tracked.source != MatrixSource::none) return rows_of(tracked)[index % 4];
  VertexVector value{};
  found_driver.GetProgramEnvParameterfvARB(GL_VERTEX_PROGRAM_ARB, index, value.data());
  return value;
}

template <class T>
void get_parameter(GLenum target, GLuint index, GLenum pname, T* params) {
  Context* const context = at_once();
  if (context == nullptr) return;
  if (target != GL_VERTEX_PROGRAM_NV || pname != GL_PROGRAM_PARAMETER_NV) return context->raise(GL_INVALID_ENUM);
  if (index >= static_cast<GLuint>(kVertexParameters)) return context->raise(GL_INVALID_VALUE);
  const MatrixSource source = context->vertex.matrices[index / 4].source;
  const bool moves_state = source == MatrixSource::texture || source == MatrixSource::program;
  if (moves_state && !can_run_beside_list(*context)) return;
  VertexVector value{};
  run_beside_list(*context, [&] { value = parameter(*context, index); });
  std::transform(value.begin(), value.end(), params, [](float x) { return static_cast<T>(x); });
}

// What a matrix's name means; empty: it is not one.
std::optional<TrackedMatrix> named_matrix(GLenum matrix) {
  const auto numbered = [](MatrixSource source, GLenum number, GLenum most) -> std::optional<TrackedMatrix> {
    if (number >= static_cast<GLenum>(driver_integer(most))) return std::nullopt;
    return TrackedMatrix{.source = source, .number = static_cast<std::uint8_t>(number)};
  };
  switch (matrix) {
    case GL_NONE:
      return TrackedMatrix{};
    case GL_MODELVIEW:
      return TrackedMatrix{.source = MatrixSource::modelview};
    case GL_PROJECTION:
      return TrackedMatrix{.source = MatrixSource::projection};
    case GL_COLOR:
      log_once("glTrackMatrixNV: the colour matrix is not tracked");
      return std::nullopt;
    case GL_MODELVIEW_PROJECTION_NV:
      return TrackedMatrix{.source = MatrixSource::modelview_projection};
    case GL_TEXTURE:
      return numbered(MatrixSource::texture, static_cast<GLenum>(driver_integer(GL_ACTIVE_TEXTURE)) - GL_TEXTURE0,
                      GL_MAX_TEXTURE_COORDS);
    default:
      if (matrix >= GL_TEXTURE0 && matrix < GL_TEXTURE0 + 32) {
        return numbered(MatrixSource::texture, matrix - GL_TEXTURE0, GL_MAX_TEXTURE_COORDS);
      }
      if (matrix < GL_MATRIX0_NV || matrix > GL_MATRIX7_NV) return std::nullopt;
      return numbered(MatrixSource::program, matrix - GL_MATRIX0_NV, GL_MAX_PROGRAM_MATRICES_ARB);
  }
}

void track_matrix(GLenum target, GLuint address, GLenum matrix, GLenum transform) {
  run([=](Context& context) {
    if (target != GL_VERTEX_PROGRAM_NV) return context.raise(GL_INVALID_ENUM);
    if (address % 4 != 0 || address >= static_cast<GLuint>(kVertexParameters)) return context.raise(GL_INVALID_VALUE);
    auto tracked = named_matrix(matrix);
    if (!tracked || transform < GL_IDENTITY_NV || transform > GL_INVERSE_TRANSPOSE_NV) {
      return context.raise(GL_INVALID_ENUM);
    }
    if (tracked->source != MatrixSource::none)
      tracked->transform = static_cast<MatrixTransform>(transform - GL_IDENTITY_NV);
    TrackedMatrix& before = context.vertex.matrices[address / 4];
    if (before.source != MatrixSource::none && tracked->source == MatrixSource::none) {  // the last values stay
      const auto rows = rows_of(before);
      set_parameters(GL_VERTEX_PROGRAM_NV, address, 4, rows[0].data());
    }
    context.vertex.tracked[address / 4] = {matrix, transform};
    if (before == *tracked) return;
    before = *tracked;
    rebind(context);
  });
}

void get_track_matrix(GLenum target, GLuint address, GLenum pname, GLint* params) {
  Context* const context = at_once();
  if (context == nullptr) return;
  if (target != GL_VERTEX_PROGRAM_NV) return context->raise(GL_INVALID_ENUM);
  if (address % 4 != 0 || address >= static_cast<GLuint>(kVertexParameters)) return context->raise(GL_INVALID_VALUE);
  const auto& [matrix, transform] = context->vertex.tracked[address / 4];
  if (pname == GL_TRACK_MATRIX_NV) {
    *params = static_cast<GLint>(matrix);
  } else if (pname == GL_TRACK_MATRIX_TRANSFORM_NV) {
    *params = static_cast<GLint>(transform != 0 ? transform : GL_IDENTITY_NV);
  } else {
    context->raise(GL_INVALID_ENUM);
  }
}

void execute_program(GLenum target, GLuint name, const GLfloat* params) {
  const VertexVector attribute{params[0], params[1], params[2], params[3]};
  run([=](Context& context) {
    if (target != GL_VERTEX_STATE_PROGRAM_NV) return context.raise(GL_INVALID_ENUM);
    const auto object = find_object(context, name);
    if (object == nullptr || object->target != target) return context.raise(GL_INVALID_OPERATION);
    std::array<VertexVector, kVertexParameters> parameters{};
    for (std::size_t i = 0; i < parameters.size(); ++i) parameters[i] = parameter(context, static_cast<GLuint>(i));
    const auto before = parameters;
    execute_state_program(object->program, attribute, parameters);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      if (std::memcmp(&parameters[i], &before[i], sizeof(before[i])) == 0) continue;
      found_driver.ProgramEnvParameter4fvARB(GL_VERTEX_PROGRAM_ARB, static_cast<GLuint>(i), parameters[i].data());
    }
  });
}

}  // namespace

NINEBIT_VERTEX_CALL(GLboolean, AreProgramsResidentNV, (GLsizei n, const GLuint* programs, GLboolean* residences),
                    (n, programs, residences), are_resident)
NINEBIT_VERTEX_PROCEDURE(BindProgramNV, (GLenum target, GLuint id), (target, id), bind_program)
NINEBIT_VERTEX_PROCEDURE(DeleteProgramsNV, (GLsizei n, const GLuint* programs), (n, programs), delete_programs)
NINEBIT_VERTEX_PROCEDURE(ExecuteProgramNV, (GLenum target, GLuint id, const GLfloat* params), (target, id, params),
                         execute_program)
NINEBIT_VERTEX_PROCEDURE(GenProgramsNV, (GLsizei n, GLuint* programs), (n, programs), generate_programs)
NINEBIT_VERTEX_PROCEDURE(GetProgramParameterdvNV, (GLenum target, GLuint index, GLenum pname, GLdouble* params),
                         (target, index, pname, params), get_parameter)
NINEBIT_VERTEX_PROCEDURE(GetProgramParameterfvNV, (GLenum target, GLuint index, GLenum pname, GLfloat* params),
                         (target, index, pname, params), get_parameter)
NINEBIT_VERTEX_PROCEDURE(GetProgramivNV, (GLuint id, GLenum pname, GLint* params), (id, pname, params), get_program)
NINEBIT_VERTEX_PROCEDURE(GetProgramStringNV, (GLuint id, GLenum pname, GLubyte* program), (id, pname, program),
                         get_program_text)
NINEBIT_VERTEX_PROCEDURE(GetTrackMatrixivNV, (GLenum target, GLuint address, GLenum pname, GLint* params),
                         (target, address, pname, params), get_track_matrix)
NINEBIT_VERTEX_CALL(GLboolean, IsProgramNV, (GLuint id), (id), is_program)
NINEBIT_VERTEX_PROCEDURE(LoadProgramNV, (GLenum target, GLuint id, GLsizei len, const GLubyte* program),
                         (target, id, len, program), load_program_text)
NINEBIT_VERTEX_PROCEDURE(ProgramParameter4dNV,
                         (GLenum target, GLuint index, GLdouble x, GLdouble y, GLdouble z, GLdouble w),
                         (target, index, x, y, z, w), set_parameter)
NINEBIT_VERTEX_PROCEDURE(ProgramParameter4dvNV, (GLenum target, GLuint index, const GLdouble* v), (target, index, v),
                         set_parameter)
NINEBIT_VERTEX_PROCEDURE(ProgramParameter4fNV,
                         (GLenum target, GLuint index, GLfloat x, GLfloat y, GLfloat z, GLfloat w),
                         (target, index, x, y, z, w), set_parameter)
NINEBIT_VERTEX_PROCEDURE(ProgramParameter4fvNV, (GLenum target, GLuint index, const GLfloat* v), (target, index, v),
                         set_parameter)
NINEBIT_VERTEX_PROCEDURE(ProgramParameters4dvNV, (GLenum target, GLuint index, GLsizei count, const GLdouble* v),
                         (target, index, count, v), set_parameters)
NINEBIT_VERTEX_PROCEDURE(ProgramParameters4fvNV, (GLenum target, GLuint index, GLsizei count, const GLfloat* v),
                         (target, index, count, v), set_parameters)
NINEBIT_VERTEX_PROCEDURE(RequestResidentProgramsNV, (GLsizei n, const GLuint* programs), (n, programs),
                         request_resident)
NINEBIT_VERTEX_PROCEDURE(TrackMatrixNV, (GLenum target, GLuint address, GLenum matrix, GLenum transform),
                         (target, address, matrix, transform), track_matrix)

// Functions of ARB_vertex_program, which share the place of the bound program with those above. The layer's own
// programs are none to the program that runs.
namespace {

bool is_hidden(GLuint name) {
  Context* const context = current();
  return context != nullptr && is_layers(*context, name);
}

bool has_nv_program(GLenum target) {
  const Context* const context = current();
  return target == GL_VERTEX_PROGRAM_ARB && context != nullptr && context->vertex.is_bound;
}

}  // namespace

GLAPI void GLAPIENTRY glBindProgramARB(GLenum target, GLuint program) {
  const auto bind = find_driver().BindProgramARB;
  if (bind == nullptr) return;
  Context* const context = current();
  const bool is_the_drivers =
      !has_vertex_programs(context) || target != GL_VERTEX_PROGRAM_ARB || context->next_in_begin();
  if (is_the_drivers) return bind(target, program);
  if (context->open_list != nullptr) return record(*context, [=] { glBindProgramARB(target, program); });
  bind_now(*context, program);
}

GLAPI void GLAPIENTRY glDeleteProgramsARB(GLsizei n, const GLuint* programs) {
  const auto call = find_driver().DeleteProgramsARB;
  if (call == nullptr) return;
  Context* const context = current();
  if (n <= 0 || !has_vertex_programs(context) || context->in_begin) return call(n, programs);
  delete_programs(n, programs);
}

GLAPI GLboolean GLAPIENTRY glIsProgramARB(GLuint program) {
  const auto call = find_driver().IsProgramARB;
  return call != nullptr && !is_hidden(program) ? call(program) : GLboolean{GL_FALSE};
}

GLAPI void GLAPIENTRY glProgramStringARB(GLenum target, GLenum format, GLsizei length, const GLvoid* text) {
  const auto call = find_driver().ProgramStringARB;
  if (call == nullptr) return;
  if (has_nv_program(target)) {
    log_once("glProgramStringARB while a program of NV_vertex_program is bound: refused");
    return current()->raise(GL_INVALID_OPERATION);
  }
  call(target, format, length, text);
  if (Context* const context = current()) context->vertex.has_error_position = false;
}

GLAPI void GLAPIENTRY glGetProgramivARB(GLenum target, GLenum pname, GLint* params) {
  const auto call = find_driver().GetProgramivARB;
  if (call == nullptr) return;
  call(target, pname, params);
  const bool replaces = has_nv_program(target) && pname == GL_PROGRAM_BINDING_ARB && !current()->in_begin;
  if (replaces) *params = static_cast<GLint>(current()->vertex.name);
}

// The names of program matrices.
GLAPI void GLAPIENTRY glMatrixMode(GLenum mode) {
  const auto call = find_driver().MatrixMode;
  if (call == nullptr) return;
  Context* const context = current();
  if (!has_vertex_programs(context) || context->in_begin) return call(mode);
  const bool is_nv = mode >= GL_MATRIX0_NV && mode <= GL_MATRIX7_NV;
  if (is_nv && context->open_list != nullptr) {
    if (context->list_in_begin()) return record_begin_error(*context);
    return record(*context, [mode] { glMatrixMode(mode); });
  }
  const GLenum drivers = is_nv ? GL_MATRIX0_ARB + (mode - GL_MATRIX0_NV) : mode;
  const bool executes = context->open_list == nullptr || context->open_list->mode == GL_COMPILE_AND_EXECUTE;
  if (executes) context->vertex.matrix_mode = is_nv ? drivers : 0;
  call(drivers);
}
