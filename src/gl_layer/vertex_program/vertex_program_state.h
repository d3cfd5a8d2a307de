// The state of NV_vertex_program: the objects that contexts share, and what is a context's own.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "src/gl_layer/vertex_program/vertex_program.h"

namespace ninebit::gl_layer {

// What a program of the driver stands for, beside a text: the tracked matrices that it reads, and the attributes that
// come from attribute arrays.
using VertexVariant = std::pair<TrackedMatrices, unsigned>;

// A program that was loaded, by its name. Other contexts may have it bound: a new text makes a new object, and only the
// variants change, with the group's mutex.
struct VertexProgramObject {
  unsigned target = 0;
  std::string text{};
  VertexProgram program{};
  std::map<VertexVariant, unsigned> variants{};  // the driver's programs; 0: the driver refused it
};

struct SharedVertexPrograms {
  std::map<unsigned, std::shared_ptr<VertexProgramObject>> by_name{};
  std::set<unsigned> driver_names{};           // that the layer made, and the program never got
  std::atomic<bool> has_driver_names = false;  // whether there ever was one
  unsigned without_text = 0;                   // the driver's program that draws nothing, with its error
};

// Where an attribute array is, for glArrayElement: between glBegin and glEnd the driver does not say.
struct AttributeArray {
  unsigned type = 0;
  int size = 4, stride = 0;  // in components and bytes; the stride 0 is that of elements without a gap
  const void* pointer = nullptr;
  bool is_readable = false;  // in the program's memory, with a format that glVertexAttribPointerNV gives
};

struct VertexProgramState {
  bool is_bound = false;  // whether the program that is bound has a text of the extension; otherwise it is the driver's
  unsigned name = 0;      // of that program
  std::shared_ptr<VertexProgramObject> object{};
  unsigned driver_name = 0;   // of the driver's program that stands for it
  unsigned arrays = 0;        // the attribute arrays that are enabled
  unsigned drawn_arrays = 0;  // those that the driver's program reads: immediate mode has none
  std::array<AttributeArray, kVertexAttributes> array{};
  TrackedMatrices matrices{};
  std::array<std::pair<unsigned, unsigned>, kVertexParameters / 4> tracked{};  // the same in OpenGL's words
  unsigned matrix_mode = 0;  // the driver's, if the last glMatrixMode had a name of the extension
  int error_position = -1;
  bool has_error_position = false;  // whether the last program text was of the extension
};

}  // namespace ninebit::gl_layer
