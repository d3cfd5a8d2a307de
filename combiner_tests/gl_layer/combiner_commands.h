// Commands of NV_register_combiners as values, so that the layer and the library's own front end (gl_nv.h) can be given
// the same ones, and everything that can be read back afterwards.
#pragma once

#include <array>
#include <vector>

#include "combiner_tests/gl_layer/gl_context.h"
#include "combiner_tests/support/random.h"

namespace ninebit::test {

// The entry points of the two extensions, and the few of OpenGL's own that they extend: FUNCTION(name here, name).
#define NINEBIT_COMBINER_FUNCTIONS(FUNCTION)                        \
  FUNCTION(parameterfv, glCombinerParameterfvNV)                    \
  FUNCTION(parameteriv, glCombinerParameterivNV)                    \
  FUNCTION(parameterf, glCombinerParameterfNV)                      \
  FUNCTION(parameteri, glCombinerParameteriNV)                      \
  FUNCTION(input, glCombinerInputNV)                                \
  FUNCTION(output, glCombinerOutputNV)                              \
  FUNCTION(final_input, glFinalCombinerInputNV)                     \
  FUNCTION(stage_parameterfv, glCombinerStageParameterfvNV)         \
  FUNCTION(get_inputfv, glGetCombinerInputParameterfvNV)            \
  FUNCTION(get_inputiv, glGetCombinerInputParameterivNV)            \
  FUNCTION(get_outputfv, glGetCombinerOutputParameterfvNV)          \
  FUNCTION(get_outputiv, glGetCombinerOutputParameterivNV)          \
  FUNCTION(get_final_inputfv, glGetFinalCombinerInputParameterfvNV) \
  FUNCTION(get_final_inputiv, glGetFinalCombinerInputParameterivNV) \
  FUNCTION(get_stage_parameterfv, glGetCombinerStageParameterfvNV)  \
  FUNCTION(enable, glEnable)                                        \
  FUNCTION(disable, glDisable)                                      \
  FUNCTION(is_enabled, glIsEnabled)                                 \
  FUNCTION(get_floatv, glGetFloatv)                                 \
  FUNCTION(get_integerv, glGetIntegerv)                             \
  FUNCTION(get_error, glGetError)

struct CombinerFunctions {
#define NINEBIT_DECLARE(name, function) decltype(&::function) name;
  NINEBIT_COMBINER_FUNCTIONS(NINEBIT_DECLARE)
#undef NINEBIT_DECLARE
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
