// Commands of NV_register_combiners as values, so that the layer and the library's own front end (gl_nv.h) can be given
// the same ones, and everything that can be read back afterwards.
#pragma once

#include <array>
#include <vector>

#include "combiner_tests/gl_layer/gl_context.h"
#include "combiner_tests/support/random.h"

namespace ninebit::test {

// The entry points of the two extensions, and the few of OpenGL's own that they extend.
struct CombinerFunctions {
  void (*parameterfv)(GLenum, const GLfloat*);
  void (*parameteriv)(GLenum, const GLint*);
  void (*parameterf)(GLenum, GLfloat);
  void (*parameteri)(GLenum, GLint);
  void (*input)(GLenum, GLenum, GLenum, GLenum, GLenum, GLenum);
  void (*output)(GLenum, GLenum, GLenum, GLenum, GLenum, GLenum, GLenum, GLboolean, GLboolean, GLboolean);
  void (*final_input)(GLenum, GLenum, GLenum, GLenum);
  void (*stage_parameterfv)(GLenum, GLenum, const GLfloat*);
  void (*get_inputfv)(GLenum, GLenum, GLenum, GLenum, GLfloat*);
  void (*get_inputiv)(GLenum, GLenum, GLenum, GLenum, GLint*);
  void (*get_outputfv)(GLenum, GLenum, GLenum, GLfloat*);
  void (*get_outputiv)(GLenum, GLenum, GLenum, GLint*);
  void (*get_final_inputfv)(GLenum, GLenum, GLfloat*);
  void (*get_final_inputiv)(GLenum, GLenum, GLint*);
  void (*get_stage_parameterfv)(GLenum, GLenum, GLfloat*);
  void (*enable)(GLenum);
  void (*disable)(GLenum);
  GLboolean (*is_enabled)(GLenum);
  void (*get_floatv)(GLenum, GLfloat*);
  void (*get_integerv)(GLenum, GLint*);
  GLenum (*get_error)();
};

extern const CombinerFunctions kLayerFunctions, kLibraryFunctions;

struct CombinerCommand {
  int function = 0;  // the position in CombinerFunctions, 0 to 16
  std::array<GLenum, 7> enums{};
  std::array<GLboolean, 3> flags{};
  std::array<GLfloat, 4> floats{};
  std::array<GLint, 4> integers{};
  bool null = false;  // its pointer, if it has one, is null
};

inline constexpr int kSettingFunctions = 8, kCombinerFunctions = 17;

// A command of random arguments, of which one in `mistakes` is from another list than the right one. `setting`: none
// that only reads.
CombinerCommand random_command(Random& random, const HardwareProfile& profile, bool setting, int mistakes = 12);

// What a command returns through its pointer: -1 where it writes nothing.
std::array<GLfloat, 4> execute(const CombinerFunctions& functions, const CombinerCommand& command);

// Everything that can be read back. Raises no error.
std::vector<GLfloat> read_state(const CombinerFunctions& functions, const HardwareProfile& profile);

}  // namespace ninebit::test
