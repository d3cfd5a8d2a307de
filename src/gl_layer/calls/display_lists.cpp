#include "src/gl_layer/calls/display_lists.h"

#include <cstring>
#include <utility>

#include "src/gl_layer/capture/dump.h"
#include "src/gl_layer/draw/draw_state.h"
#include "src/gl_layer/driver/driver.h"

namespace ninebit::gl_layer {
namespace {

constexpr int kMostNestedLists = 64;

// A number that the driver has not given out and that a program is unlikely to use without asking: programs of the time
// count from 1.
GLuint unused_list() {
  static thread_local GLuint next = 0xFFFF0000U;
  while (found_driver.IsList(--next) == GL_TRUE) {
  }
  return next;
}

std::shared_ptr<const StepList> find_list(Context& context, GLuint number) {
  const std::lock_guard lock(context.group->mutex);
  const auto found = context.group->lists.find(number);
  return found != context.group->lists.end() ? found->second : nullptr;
}

void delete_driver_lists(const StepList& list) {
  for (const GLuint number : list.driver_lists) found_driver.DeleteLists(number, 1);
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
  delete_driver_lists(*dropped);
}

// Plays a list of the driver; `draws`: with a draw call in it, as far as the layer knows.
void play_driver_list(GLuint number, bool draws = true) {
  Context* const context = current();
  if (context == nullptr) return found_driver.CallList(number);
  prepare_draw(*context);
  if (draws) count_draw(*context);
  const bool captured = draws && begin_capture(*context, "glCallList");
  found_driver.CallList(number);
  if (captured) end_capture(*context);
  context->forget();
}

// glCallList outside of a list's compilation.
void play(Context& context, GLuint number) {
  const auto list = context.in_begin ? nullptr : find_list(context, number);
  if (list == nullptr) {
    if (!context.in_begin) return play_driver_list(number);
    return found_driver.CallList(number);
  }
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

// The current context if its lists may have commands of the layer: then a call makes it use the combiners.
Context* context_of_lists() {
  Context* const context = current();
  if (context != nullptr && context->group->had_steps) context->touched = true;
  return context;
}

bool has_step_lists(Context& context) {
  const std::lock_guard lock(context.group->mutex);
  return !context.group->lists.empty();
}

bool is_list_type(GLenum type) {
  return (type >= GL_BYTE && type <= GL_FLOAT) || (type >= GL_2_BYTES && type <= GL_4_BYTES);
}

}  // namespace

void close_driver_list(Context& context) {
  OpenList& open = *context.open_list;
  found_driver.EndList();
  open.list.steps.emplace_back([number = open.driver_number, draws = open.draws] { play_driver_list(number, draws); });
  if (open.driver_number != open.number) open.list.driver_lists.push_back(open.driver_number);
  open.driver_number = 0;
  open.stale = open.draws = false;
}

void open_driver_list(Context& context) {
  OpenList& open = *context.open_list;
  open.driver_number = unused_list();
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

void prepare_list_for_draw(Context& context) {
  OpenList& open = *context.open_list;
  const bool executes = open.mode == GL_COMPILE_AND_EXECUTE;
  if (open.stale || (executes && needs_preparation(context))) {
    close_driver_list(context);
    if (executes) prepare_draw(context);
    open_driver_list(context);
  }
  open.draws = true;
}

}  // namespace ninebit::gl_layer

using namespace ninebit::gl_layer;  // NOLINT(google-build-using-namespace): these are OpenGL's names

GLAPI void GLAPIENTRY glNewList(GLuint list, GLenum mode) {
  Context* const context = current();
  if (context == nullptr || context->in_begin) return find_driver().NewList(list, mode);
  const bool legal = list != 0 && (mode == GL_COMPILE || mode == GL_COMPILE_AND_EXECUTE);
  // In a list that executes, the driver's program must be right from its first draw on.
  if (legal && context->open_list == nullptr && mode == GL_COMPILE_AND_EXECUTE) prepare_draw(*context);
  found_driver.NewList(list, mode);
  if (!legal || context->open_list != nullptr) return;  // the driver has raised the error
  context->open_list = std::make_unique<OpenList>(OpenList{.number = list, .mode = mode, .driver_number = list});
}

GLAPI void GLAPIENTRY glEndList() {
  Context* const context = current();
  if (context == nullptr || context->open_list == nullptr || context->in_begin) return find_driver().EndList();
  const std::unique_ptr<OpenList> open = std::move(context->open_list);
  found_driver.EndList();
  drop_list(*context, open->number);  // until here a call of this number played the former list
  if (open->mode == GL_COMPILE_AND_EXECUTE) context->forget();
  if (open->list.steps.empty()) return;
  open->list.steps.emplace_back([number = open->driver_number, draws = open->draws] { play_driver_list(number, draws); });
  open->list.driver_lists.push_back(open->driver_number);
  const std::lock_guard lock(context->group->mutex);
  context->group->had_steps = true;
  context->group->lists[open->number] = std::make_shared<const StepList>(std::move(open->list));
}

GLAPI void GLAPIENTRY glCallList(GLuint list) {
  Context* const context = context_of_lists();
  if (context == nullptr || (!context->touched && context->open_list == nullptr)) return find_driver().CallList(list);
  if (context->recording() && !context->open_list->in_begin) return record(*context, [list] { glCallList(list); });
  if (context->open_list != nullptr) return found_driver.CallList(list);
  play(*context, list);
}

GLAPI void GLAPIENTRY glCallLists(GLsizei n, GLenum type, const GLvoid* lists) {
  Context* const context = context_of_lists();
  const bool by_driver = context == nullptr || !context->touched || n <= 0 || lists == nullptr || !is_list_type(type) ||
                         (context->open_list != nullptr && context->open_list->in_begin);
  if (by_driver) return find_driver().CallLists(n, type, lists);
  if (!context->recording() && (context->in_begin || !has_step_lists(*context))) {
    if (!context->in_begin) prepare_draw(*context);
    found_driver.CallLists(n, type, lists);
    context->forget();
    return;
  }
  GLint base = 0;
  found_driver.GetIntegerv(GL_LIST_BASE, &base);
  for (GLsizei i = 0; i < n; ++i) glCallList(static_cast<GLuint>(base) + list_offset(lists, type, i));
}

GLAPI void GLAPIENTRY glDeleteLists(GLuint list, GLsizei range) {
  find_driver().DeleteLists(list, range);
  Context* const context = current();
  if (context == nullptr || range <= 0 || context->in_begin || !has_step_lists(*context)) return;
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
