// Which program of the driver stands for the one that is bound by NV_vertex_program.
#pragma once

#include "src/gl_layer/context/context.h"

namespace ninebit::gl_layer {

// Whether the layer adds the extension to this context.
[[nodiscard]] inline bool has_vertex_programs(const Context* context) {
  return context != nullptr && context->features.extras.have(Extra::vertex_program);
}

// Whether a name is GL_VERTEX_ATTRIB_ARRAY0_NV to GL_VERTEX_ATTRIB_ARRAY15_NV, of a context that has them.
[[nodiscard]] inline bool is_attribute_array(const Context* context, unsigned name) {
  return name - 0x8650U < static_cast<unsigned>(kVertexAttributes) && has_vertex_programs(context);
}

// Binds the driver's program for the extension's state, with these attributes from arrays. Not between glBegin and
// glEnd, nor while a list of the driver is open.
void bind_vertex_program(Context& context, unsigned arrays);

// The name of the program that is bound, by this extension or by ARB_vertex_program.
[[nodiscard]] unsigned bound_vertex_program(const Context& context);

// The attributes that a draw call takes from arrays.
[[nodiscard]] inline unsigned drawn_arrays(const Context& context, bool reads_arrays) {
  return reads_arrays ? context.vertex.arrays : 0;
}

// The same before a draw call, if the last one was of the other kind.
inline void prepare_vertices(Context& context, unsigned arrays) {
  if (arrays != context.vertex.drawn_arrays) bind_vertex_program(context, arrays);
}

// Reads the driver's record of an attribute array, or of all. Not between glBegin and glEnd.
void find_attribute_array(Context& context, unsigned index);
void find_attribute_arrays(Context& context);

// The attribute arrays that glArrayElement of the layer reads: the driver's reads the others.
[[nodiscard]] inline unsigned element_arrays(const Context& context) {
  return context.vertex.is_bound ? context.vertex.arrays & ~(kGenericAttributes | 1U) : 0;
}

// Reads the driver's record of these: functions that the layer does not see may have set them. Before glBegin, and
// before a glArrayElement that is not between glBegin and glEnd.
void find_element_arrays(Context& context);

// The four rows of a matrix as it is now.
[[nodiscard]] std::array<VertexVector, 4> rows_of(const TrackedMatrix& matrix);

// Deletes the driver's programs of an object.
void delete_variants(Context& context, VertexProgramObject& object);

}  // namespace ninebit::gl_layer
