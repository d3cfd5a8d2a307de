// OpenGL's draw calls: before each of them the right shader becomes current.
#include "src/gl_layer/calls/display_lists.h"
#include "src/gl_layer/capture/dump.h"
#include "src/gl_layer/context/context.h"
#include "src/gl_layer/draw/draw_state.h"
#include "src/gl_layer/draw/vertex_programs.h"
#include "src/gl_layer/driver/driver.h"

using namespace ninebit::gl_layer;  // NOLINT(google-build-using-namespace): these are OpenGL's names

namespace {

// Returns whether the draw is captured, which after_draw ends. `reads_arrays`: it takes vertices from arrays.
bool before_draw(const char* call, bool reads_arrays = false) {
  Context* const context = current();
  if (context == nullptr || context->in_begin) return false;
  const unsigned arrays = drawn_arrays(*context, reads_arrays);
  if (context->open_list != nullptr) {
    if (!context->open_list->in_begin) prepare_list_for_vertices(*context, arrays);
    if (context->recording() && !context->open_list->in_begin) prepare_list_for_draw(*context);
    context->open_list->draws = true;
    return false;
  }
  prepare_vertices(*context, arrays);
  if (!context->watches_draws()) return false;
  prepare_draw(*context);
  count_draw(*context);
  return begin_capture(*context, call);
}

// A captured draw that glBegin began.
thread_local bool captured_until_end = false;

}  // namespace

GLAPI void GLAPIENTRY glBegin(GLenum mode) {
  if (before_draw("glBegin")) captured_until_end = true;  // one inside another is an error, and draws nothing
  if (Context* const before = current(); before != nullptr && !before->next_in_begin()) find_element_arrays(*before);
  found_driver.Begin != nullptr ? found_driver.Begin(mode) : find_driver().Begin(mode);
  Context* const context = current();
  if (context == nullptr || mode > GL_POLYGON) return;
  if (context->open_list != nullptr) {
    context->open_list->in_begin = true;
    context->open_list->effect = BeginEffect::inside;
    if (context->open_list->mode == GL_COMPILE) return;
  }
  context->in_begin = true;
}

GLAPI void GLAPIENTRY glEnd() {
  find_driver().End();
  Context* const context = current();
  if (context == nullptr) return;
  if (context->in_begin) context->begin_has_ended();
  if (context->open_list != nullptr) end_in_list(*context);
  if (captured_until_end) end_capture(*context);
  captured_until_end = false;
}

#define NINEBIT_DRAWING(name, parameters, arguments, reads_arrays) \
  GLAPI void GLAPIENTRY gl##name parameters {                      \
    const bool captured = before_draw("gl" #name, reads_arrays);   \
    const auto draw = find_driver().name;                          \
    if (draw != nullptr) draw arguments;                           \
    if (captured) end_capture(*current());                         \
  }
#define NINEBIT_DRAW_CALL(name, parameters, arguments) NINEBIT_DRAWING(name, parameters, arguments, false)
#define NINEBIT_ARRAY_CALL(name, parameters, arguments) NINEBIT_DRAWING(name, parameters, arguments, true)

NINEBIT_ARRAY_CALL(DrawArrays, (GLenum mode, GLint first, GLsizei count), (mode, first, count))
NINEBIT_ARRAY_CALL(DrawElements, (GLenum mode, GLsizei count, GLenum type, const GLvoid* indices),
                   (mode, count, type, indices))
NINEBIT_ARRAY_CALL(DrawRangeElements,
                   (GLenum mode, GLuint start, GLuint end, GLsizei count, GLenum type, const GLvoid* indices),
                   (mode, start, end, count, type, indices))
NINEBIT_ARRAY_CALL(MultiDrawArrays, (GLenum mode, const GLint* first, const GLsizei* count, GLsizei drawcount),
                   (mode, first, count, drawcount))
NINEBIT_ARRAY_CALL(MultiDrawElements,
                   (GLenum mode, const GLsizei* count, GLenum type, const void* const* indices, GLsizei drawcount),
                   (mode, count, type, indices, drawcount))
NINEBIT_ARRAY_CALL(DrawArraysInstanced, (GLenum mode, GLint first, GLsizei count, GLsizei instances),
                   (mode, first, count, instances))
NINEBIT_ARRAY_CALL(DrawElementsInstanced,
                   (GLenum mode, GLsizei count, GLenum type, const void* indices, GLsizei instances),
                   (mode, count, type, indices, instances))
NINEBIT_ARRAY_CALL(DrawElementsBaseVertex, (GLenum mode, GLsizei count, GLenum type, const void* indices, GLint base),
                   (mode, count, type, indices, base))
NINEBIT_ARRAY_CALL(DrawRangeElementsBaseVertex,
                   (GLenum mode, GLuint start, GLuint end, GLsizei count, GLenum type, const void* indices, GLint base),
                   (mode, start, end, count, type, indices, base))
NINEBIT_ARRAY_CALL(DrawElementsInstancedBaseVertex,
                   (GLenum mode, GLsizei count, GLenum type, const void* indices, GLsizei instances, GLint base),
                   (mode, count, type, indices, instances, base))
NINEBIT_ARRAY_CALL(MultiDrawElementsBaseVertex,
                   (GLenum mode, const GLsizei* count, GLenum type, const void* const* indices, GLsizei drawcount,
                    const GLint* base),
                   (mode, count, type, indices, drawcount, base))
NINEBIT_ARRAY_CALL(DrawArraysIndirect, (GLenum mode, const void* indirect), (mode, indirect))
NINEBIT_ARRAY_CALL(DrawElementsIndirect, (GLenum mode, GLenum type, const void* indirect), (mode, type, indirect))
NINEBIT_ARRAY_CALL(MultiDrawArraysIndirect, (GLenum mode, const void* indirect, GLsizei drawcount, GLsizei stride),
                   (mode, indirect, drawcount, stride))
NINEBIT_ARRAY_CALL(MultiDrawElementsIndirect,
                   (GLenum mode, GLenum type, const void* indirect, GLsizei drawcount, GLsizei stride),
                   (mode, type, indirect, drawcount, stride))
NINEBIT_DRAW_CALL(Rectd, (GLdouble x1, GLdouble y1, GLdouble x2, GLdouble y2), (x1, y1, x2, y2))
NINEBIT_DRAW_CALL(Rectf, (GLfloat x1, GLfloat y1, GLfloat x2, GLfloat y2), (x1, y1, x2, y2))
NINEBIT_DRAW_CALL(Recti, (GLint x1, GLint y1, GLint x2, GLint y2), (x1, y1, x2, y2))
NINEBIT_DRAW_CALL(Rects, (GLshort x1, GLshort y1, GLshort x2, GLshort y2), (x1, y1, x2, y2))
NINEBIT_DRAW_CALL(Rectdv, (const GLdouble* v1, const GLdouble* v2), (v1, v2))
NINEBIT_DRAW_CALL(Rectfv, (const GLfloat* v1, const GLfloat* v2), (v1, v2))
NINEBIT_DRAW_CALL(Rectiv, (const GLint* v1, const GLint* v2), (v1, v2))
NINEBIT_DRAW_CALL(Rectsv, (const GLshort* v1, const GLshort* v2), (v1, v2))
NINEBIT_DRAW_CALL(EvalMesh1, (GLenum mode, GLint i1, GLint i2), (mode, i1, i2))
NINEBIT_DRAW_CALL(EvalMesh2, (GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2), (mode, i1, i2, j1, j2))
NINEBIT_DRAW_CALL(DrawPixels, (GLsizei width, GLsizei height, GLenum format, GLenum type, const GLvoid* pixels),
                  (width, height, format, type, pixels))
NINEBIT_DRAW_CALL(CopyPixels, (GLint x, GLint y, GLsizei width, GLsizei height, GLenum type),
                  (x, y, width, height, type))
NINEBIT_DRAW_CALL(Bitmap,
                  (GLsizei width, GLsizei height, GLfloat xorig, GLfloat yorig, GLfloat xmove, GLfloat ymove,
                   const GLubyte* bitmap),
                  (width, height, xorig, yorig, xmove, ymove, bitmap))
