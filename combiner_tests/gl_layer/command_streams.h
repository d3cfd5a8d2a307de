// Random sequences of commands, to be executed in several ways that have to come out the same.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "combiner_tests/gl_layer/pictures.h"
#include "combiner_tests/support/random.h"

namespace ninebit::test {

struct StreamCommand {
  std::string name;
  std::function<void()> run;
  bool in_begin = false;  // between glBegin and glEnd, after this command
};

// Commands of the combiners, of texture shaders, of the driver's state that shaders depend on, and draws. All of them
// can be in a display list.
std::vector<StreamCommand> random_stream(Random& random, int commands);

// The objects that a stream uses, in a new context.
void make_stream_objects();

// What a stream leaves behind; takes the pending error.
struct StreamResult {
  std::vector<Pixel> picture;
  std::vector<GLfloat> state;
  GLenum error;
  friend bool operator==(const StreamResult&, const StreamResult&) = default;
};
StreamResult stream_result();

}  // namespace ninebit::test
