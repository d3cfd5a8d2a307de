#include "src/gl_layer/calls/display_lists.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <utility>

#include "src/gl_layer/capture/dump.h"
#include "src/gl_layer/draw/draw_state.h"
#include "src/gl_layer/draw/vertex_programs.h"
#include "src/gl_layer/driver/driver.h"
#include "src/gl_layer/driver/log.h"

namespace ninebit::gl_layer {
namespace {

constexpr int kMostNestedLists = 64;

// A number that the driver has not given out and that a program is unlikely to use without asking: programs of the time
// count from 1, and a driver gives out numbers above the highest that it has.
GLuint unused_list(ShareGroup& group) {
  static std::atomic<GLuint> next{0x40000000U};  // no two threads get the same, as their contexts may share lists
  GLuint number = --next;
  while (found_driver.IsList(number) == GL_TRUE) number = --next;
  const std::lock_guard lock(group.mutex);
  group.step_lists.insert(number);
  return number;
}

std::shared_ptr<const StepList> find_list(Context& context, GLuint number) {
  const std::lock_guard lock(context.group->mutex);
  const auto found = context.group->lists.find(number);
  return found != context.group->lists.end() ? found->second : nullptr;
}

void delete_driver_lists(ShareGroup& group, const StepList& list) {
  for (const GLuint number : list.driver_lists) {
    found_driver.DeleteLists(number, 1);
    const std::lock_guard lock(group.mutex);
    group.step_lists.erase(number);
  }
}

bool is_step_list(const Context& context, GLuint number) {
  if (!context.group->had_steps) return false;
  const std::lock_guard lock(context.group->mutex);
  return context.group->step_lists.contains(number);
}

// Whether the driver has the first part of the list that is compiled, by the program's number.
bool has_first_part(const OpenList* open) {
  return open != nullptr && open->driver_number != open->number;
}

// Deletes the program's lists of the driver, and not those between their numbers that it never got, or the first part
// of the list that is compiled.
void delete_visible_lists(Context& context, GLuint list, GLsizei range) {
  std::vector<GLuint> kept;
  OpenList* const open = context.open_list.get();
  if (range > 0 && has_first_part(open) && open->number - list < static_cast<GLuint>(range)) {
    kept.push_back(open->number);
    open->replaces = false;
  }
  if (range > 0 && context.group->had_steps) {
    const std::lock_guard lock(context.group->mutex);
    const auto& all = context.group->step_lists;
    for (auto at = all.lower_bound(list); at != all.end() && *at - list < static_cast<GLuint>(range); ++at) {
      kept.push_back(*at);
    }
    std::sort(kept.begin(), kept.end());
  }
  GLuint begin = list;
  for (const GLuint number : kept) {
    found_driver.DeleteLists(begin, static_cast<GLsizei>(number - begin));
    begin = number + 1;
  }
  found_driver.DeleteLists(begin, range - static_cast<GLsizei>(begin - list));
}

// Forgets the steps of the program's list of that number.
void drop_list(Context& context, GLuint number) {
  std::shared_ptr<const StepList> dropped;
  {
    const std::lock_guard lock(context.group->mutex);
    const auto found = context.group->lists.find(number);
    if (found == context.group->lists.end()) return;
    dropped = std::move(found->second);
    context.group->lists.erase(found);
  }
  delete_driver_lists(*context.group, *dropped);
}

// Plays a list of the driver; `draws`: with a draw call in it, as far as the layer knows; `arrays`: the vertex
// program's attributes that its vertices have from attribute arrays.
void play_driver_list(GLuint number, bool draws, BeginEffect effect, unsigned arrays = 0) {
  Context* const context = current();
  if (context == nullptr) return found_driver.CallList(number);
  draws = draws && !context->in_begin;
  if (draws) {
    prepare_vertices(*context, arrays);
    prepare_draw(*context);
    count_draw(*context);
  }
  const bool captured = draws && begin_capture(*context, "glCallList");
  found_driver.CallList(number);
  if (captured) end_capture(*context);
  context->forget();
  ++context->group->images_changed;
  if (effect == BeginEffect::inside) context->in_begin = true;
  if (effect == BeginEffect::outside && context->in_begin) context->begin_has_ended();
}

// glCallList outside of a list's compilation.
void play(Context& context, GLuint number) {
  const auto list = find_list(context, number);
  if (list == nullptr) return play_driver_list(number, true, BeginEffect::unchanged);
  if (context.list_depth >= kMostNestedLists) return;
  ++context.list_depth;
  for (const auto& step : list->steps) step();
  --context.list_depth;
}

GLuint list_offset(const void* lists, GLenum type, GLsizei i) {
  const auto* const bytes = static_cast<const unsigned char*>(lists);
  const auto at = [&](auto value) {
    std::memcpy(&value, bytes + static_cast<std::size_t>(i) * sizeof(value), sizeof(value));
    return static_cast<GLuint>(static_cast<GLint>(value));
  };
  const auto big_endian = [&](std::size_t count) {
    GLuint value = 0;
    for (std::size_t b = 0; b < count; ++b) value = value << 8 | bytes[static_cast<std::size_t>(i) * count + b];
    return value;
  };
  switch (type) {
    case GL_BYTE:
      return at(GLbyte{});
    case GL_UNSIGNED_BYTE:
      return at(GLubyte{});
    case GL_SHORT:
      return at(GLshort{});
    case GL_UNSIGNED_SHORT:
      return at(GLushort{});
    case GL_FLOAT:
      return at(GLfloat{});
    case GL_2_BYTES:
      return big_endian(2);
    case GL_3_BYTES:
      return big_endian(3);
    case GL_4_BYTES:
      return big_endian(4);
    default:
      return at(GLint{});
  }
}

std::size_t bytes_of(GLenum type) {
  switch (type) {
    case GL_BYTE:
    case GL_UNSIGNED_BYTE:
      return 1;
    case GL_SHORT:
    case GL_UNSIGNED_SHORT:
    case GL_2_BYTES:
      return 2;
    case GL_3_BYTES:
      return 3;
    default:
      return 4;
  }
}

// Makes the driver's list that has been closed a step.
void add_step(OpenList& open) {
  open.list.steps.emplace_back([number = open.driver_number, draws = open.draws, effect = open.effect,
                                arrays = open.arrays] { play_driver_list(number, draws, effect, arrays); });
  if (open.begin_error) {
    open.list.steps.emplace_back([] {
      if (Context* const context = current()) context->raise(GL_INVALID_OPERATION);
    });
  }
  if (open.driver_number != open.number) open.list.driver_lists.push_back(open.driver_number);
  open.driver_number = 0;
  open.effect = BeginEffect::unchanged;
  open.arrays = 0;
  open.stale = open.draws = open.begin_error = false;
}

// After the driver's glEndList.
void finish_list(Context& context) {
  const std::unique_ptr<OpenList> open = std::move(context.open_list);
  open->half_begin = open->half_begin || open->in_begin;
  drop_list(context, open->number);  // until here a call of this number played the former list
  if (open->mode == GL_COMPILE_AND_EXECUTE) context.forget();
  ++context.group->images_changed;
  const bool has_own = open->half_begin || open->begin_error || open->arrays != 0;
  if (open->list.steps.empty() && !has_own) return;
  add_step(*open);
  const std::lock_guard lock(context.group->mutex);
  context.group->lists[open->number] = std::make_shared<const StepList>(std::move(open->list));
  context.group->had_steps = true;
}

bool is_list_type(GLenum type) {
  return (type >= GL_BYTE && type <= GL_FLOAT) || (type >= GL_2_BYTES && type <= GL_4_BYTES);
}

}  // namespace

bool goes_into_steps(const Context& context) {
  return context.recording() && !context.list_in_begin();
}

void close_driver_list(Context& context) {
  OpenList& open = *context.open_list;
  if (open.driver_number == open.number) open.replaces = found_driver.IsList(open.number) == GL_TRUE;
  found_driver.EndList();
  add_step(open);
}

void open_driver_list(Context& context) {
  OpenList& open = *context.open_list;
  open.driver_number = unused_list(*context.group);
  found_driver.NewList(open.driver_number, open.mode);
}

void record(Context& context, const std::function<void()>& command) {
  close_driver_list(context);
  context.open_list->list.steps.push_back(command);
  if (context.open_list->mode == GL_COMPILE_AND_EXECUTE) {
    std::unique_ptr<OpenList> list = std::move(context.open_list);
    command();
    context.open_list = std::move(list);
  }
  open_driver_list(context);
}

void record_begin_error(Context& context) {
  context.open_list->begin_error = true;
  if (context.open_list->mode == GL_COMPILE_AND_EXECUTE) context.raise(GL_INVALID_OPERATION);
}

bool can_run_beside_list(Context& context) {
  if (context.open_list == nullptr || !context.open_list->in_begin) return true;
  log_once("a list between glBegin and glEnd: the layer cannot ask the driver for what depends on other state");
  context.raise(GL_INVALID_OPERATION);
  return false;
}

void raise_or_record(Context& context, unsigned error) {
  if (context.open_list == nullptr) return context.raise(error);
  if (context.list_in_begin()) return record_begin_error(context);
  record(context, [error] {
    if (Context* const now = current()) now->raise(error);
  });
}

void prepare_list_for_draw(Context& context) {
  OpenList& open = *context.open_list;
  const bool executes = open.mode == GL_COMPILE_AND_EXECUTE;
  if (open.stale || (executes && needs_preparation(context))) {
    close_driver_list(context);
    if (executes) prepare_draw(context);
    open_driver_list(context);
  }
}

void prepare_list_for_vertices(Context& context, unsigned arrays) {
  OpenList& open = *context.open_list;
  const bool executes = open.mode == GL_COMPILE_AND_EXECUTE;
  const bool prepares = executes && context.vertex.drawn_arrays != arrays;
  if (open.arrays == arrays && !prepares) return;
  if (open.draws || prepares) {
    close_driver_list(context);
    if (prepares) prepare_vertices(context, arrays);
    open_driver_list(context);
  }
  open.arrays = arrays;
}

namespace {

void mark(bool Context::*stale) {
  Context* const context = current();
  if (context == nullptr) return;
  context->*stale = true;
  if (context->open_list != nullptr) context->open_list->stale = true;
}

}  // namespace

void mark_stale() {
  mark(&Context::inputs_stale);
}

void mark_fog_stale() {
  mark(&Context::fog_stale);
}

void mark_images_changed() {
  mark_stale();
  if (Context* const context = current()) ++context->group->images_changed;
}

void end_in_list(Context& context) {
  OpenList& open = *context.open_list;
  open.half_begin = open.half_begin || !open.in_begin;
  open.in_begin = false;
  open.effect = BeginEffect::outside;
  if (!open.ended_in_begin) return;
  open.ended_in_begin = false;
  if (driver_integer(GL_LIST_INDEX) == 0) finish_list(context);
}

}  // namespace ninebit::gl_layer

using namespace ninebit::gl_layer;  // NOLINT(google-build-using-namespace): these are OpenGL's names

GLAPI void GLAPIENTRY glNewList(GLuint list, GLenum mode) {
  Context* const context = current();
  if (context == nullptr || context->in_begin) return find_driver().NewList(list, mode);
  const bool legal = list != 0 && (mode == GL_COMPILE || mode == GL_COMPILE_AND_EXECUTE);
  // In a list that executes, the driver's program must be right from its first draw on.
  if (legal && context->open_list == nullptr && mode == GL_COMPILE_AND_EXECUTE) {
    prepare_vertices(*context, 0);
    prepare_draw(*context);
  }
  found_driver.NewList(list, mode);
  if (!legal || context->open_list != nullptr) return;  // the driver has raised the error
  context->open_list = std::make_unique<OpenList>(OpenList{.number = list, .mode = mode, .driver_number = list});
}

GLAPI void GLAPIENTRY glEndList() {
  Context* const context = current();
  find_driver().EndList();
  if (context == nullptr || context->open_list == nullptr) return;
  context->open_list->ended_in_begin = context->in_begin;
  if (!context->in_begin) finish_list(*context);
}

GLAPI void GLAPIENTRY glCallList(GLuint list) {
  Context* const context = current();
  if (context == nullptr) return find_driver().CallList(list);
  if (context->open_list != nullptr) {
    // Alone, 0 is an error; in a list it is a list that does not exist.
    if (list != 0 && goes_into_steps(*context)) return record(*context, [list] { glCallList(list); });
    if (!context->list_in_begin()) prepare_list_for_vertices(*context, 0);
    context->open_list->draws = true;
    return found_driver.CallList(list);
  }
  if (!context->touched && !context->group->had_steps) {
    if (!context->in_begin) prepare_vertices(*context, 0);
    ++context->group->images_changed;
    return found_driver.CallList(list);
  }
  if (is_step_list(*context, list)) return;
  play(*context, list);
}

GLAPI void GLAPIENTRY glCallLists(GLsizei n, GLenum type, const GLvoid* lists) {
  Context* const context = current();
  if (context == nullptr || n <= 0 || lists == nullptr || !is_list_type(type)) {
    return find_driver().CallLists(n, type, lists);
  }
  if (context->open_list != nullptr) {
    if (!goes_into_steps(*context)) {
      context->open_list->draws = true;
      return found_driver.CallLists(n, type, lists);
    }
    const auto* const bytes = static_cast<const unsigned char*>(lists);
    const std::vector<unsigned char> copy(bytes, bytes + static_cast<std::size_t>(n) * bytes_of(type));
    return record(*context, [n, type, copy] { glCallLists(n, type, copy.data()); });
  }
  // One list may change what the shader of the next depends on.
  if (!context->group->had_steps && (context->in_begin || !computes_colors(*context))) {
    if (!context->in_begin) {
      prepare_vertices(*context, 0);
      prepare_draw(*context);
    }
    found_driver.CallLists(n, type, lists);
    ++context->group->images_changed;
    return context->forget();
  }
  const GLint base = driver_integer(GL_LIST_BASE);
  for (GLsizei i = 0; i < n; ++i) {
    const GLuint list = static_cast<GLuint>(base) + list_offset(lists, type, i);
    if (list != 0) glCallList(list);  // as in a list
  }
}

GLAPI void GLAPIENTRY glDeleteLists(GLuint list, GLsizei range) {
  Context* const context = current();
  if (context == nullptr) return find_driver().DeleteLists(list, range);
  delete_visible_lists(*context, list, range);
  if (range <= 0 || context->in_begin || !context->group->had_steps) return;
  std::vector<GLuint> numbers;
  {
    const std::lock_guard lock(context->group->mutex);
    const auto& all = context->group->lists;
    for (auto at = all.lower_bound(list); at != all.end() && at->first - list < static_cast<GLuint>(range); ++at) {
      numbers.push_back(at->first);
    }
  }
  for (const GLuint number : numbers) drop_list(*context, number);
}

GLAPI GLboolean GLAPIENTRY glIsList(GLuint list) {
  const Context* const context = current();
  if (context == nullptr || context->in_begin) return find_driver().IsList(list);
  if (is_step_list(*context, list)) return GL_FALSE;
  // The list that is compiled is none before glEndList.
  const OpenList* const open = context->open_list.get();
  if (has_first_part(open) && open->number == list) return open->replaces ? GL_TRUE : GL_FALSE;
  return found_driver.IsList(list);
}
