#include "combiner_tests/gl_layer/combiner_commands.h"

#include "ninebit/language/gl_nv.h"

namespace ninebit::test {
namespace {

GLenum one_of_range(Random& random, GLenum first, GLenum last) {
  return first + static_cast<GLenum>(random.below(static_cast<int>(last - first) + 1));
}

// An enumerant that a place for `right` sometimes gets instead.
GLenum wrong_enum(Random& random) {
  if (random.one_in(3))
    return random.pick<GLenum>({0, 1, GL_TEXTURE4, GL_TEXTURE2, GL_RGBA, GL_RED, 0xFFFFFFFFU, 0x8533});
  return one_of_range(random, GL_REGISTER_COMBINERS_NV, GL_COMBINER7_NV);
}

GLenum portion(Random& random) {
  return random.pick<GLenum>({GL_RGB, GL_ALPHA});
}
GLenum stage(Random& random, const HardwareProfile& profile) {
  return GL_COMBINER0_NV + static_cast<GLenum>(random.below(profile.general_combiners));
}
GLenum input(Random& random) {
  return random.pick<GLenum>({GL_ZERO, GL_CONSTANT_COLOR0_NV, GL_CONSTANT_COLOR1_NV, GL_FOG, GL_PRIMARY_COLOR_NV,
                              GL_SECONDARY_COLOR_NV, GL_SPARE0_NV, GL_SPARE1_NV, GL_TEXTURE0, GL_TEXTURE1});
}
GLenum output(Random& random) {
  return random.pick<GLenum>({GL_DISCARD_NV, GL_DISCARD_NV, GL_PRIMARY_COLOR_NV, GL_SECONDARY_COLOR_NV, GL_SPARE0_NV,
                              GL_SPARE1_NV, GL_TEXTURE0, GL_TEXTURE1});
}
GLenum usage(Random& random) {
  return random.pick<GLenum>({GL_RGB, GL_ALPHA, GL_BLUE});
}
GLenum constant(Random& random) {
  return random.pick<GLenum>({GL_CONSTANT_COLOR0_NV, GL_CONSTANT_COLOR1_NV});
}
GLenum number(Random& random) {
  return random.pick<GLenum>({GL_NUM_GENERAL_COMBINERS_NV, GL_COLOR_SUM_CLAMP_NV});
}
GLenum input_query(Random& random) {
  return random.pick<GLenum>({GL_COMBINER_INPUT_NV, GL_COMBINER_MAPPING_NV, GL_COMBINER_COMPONENT_USAGE_NV});
}

// The enumerants of a command that has mostly no error.
std::array<GLenum, 7> right_enums(Random& random, const HardwareProfile& profile, int function) {
  switch (function) {
    case 0:
    case 1:
      return {random.one_in(3) ? number(random) : constant(random)};
    case 2:
    case 3:
      return {number(random)};
    case 4:
      return {stage(random, profile),
              portion(random),
              one_of_range(random, GL_VARIABLE_A_NV, GL_VARIABLE_D_NV),
              input(random),
              one_of_range(random, GL_UNSIGNED_IDENTITY_NV, GL_SIGNED_NEGATE_NV),
              usage(random)};
    case 5:
      return {stage(random, profile),
              portion(random),
              output(random),
              output(random),
              output(random),
              random.pick<GLenum>({GL_NONE, GL_SCALE_BY_TWO_NV, GL_SCALE_BY_FOUR_NV, GL_SCALE_BY_ONE_HALF_NV}),
              random.pick<GLenum>({GL_NONE, GL_NONE, GL_BIAS_BY_NEGATIVE_ONE_HALF_NV})};
    case 6:
      return {
          one_of_range(random, GL_VARIABLE_A_NV, GL_VARIABLE_G_NV),
          random.one_in(4) ? random.pick<GLenum>({GL_E_TIMES_F_NV, GL_SPARE0_PLUS_SECONDARY_COLOR_NV}) : input(random),
          random.pick<GLenum>({GL_UNSIGNED_IDENTITY_NV, GL_UNSIGNED_INVERT_NV}), usage(random)};
    case 7:
    case 14:
      return {stage(random, profile), constant(random)};
    case 8:
    case 9:
      return {stage(random, profile), portion(random), one_of_range(random, GL_VARIABLE_A_NV, GL_VARIABLE_D_NV),
              input_query(random)};
    case 10:
    case 11:
      return {stage(random, profile), portion(random),
              one_of_range(random, GL_COMBINER_AB_DOT_PRODUCT_NV, GL_COMBINER_SUM_OUTPUT_NV)};
    case 12:
    case 13:
      return {one_of_range(random, GL_VARIABLE_A_NV, GL_VARIABLE_G_NV), input_query(random)};
    default:
      return {random.pick<GLenum>({GL_REGISTER_COMBINERS_NV, GL_PER_STAGE_CONSTANTS_NV})};
  }
}

}  // namespace

#define NINEBIT_LAYERS(name, function) ::function,
#define NINEBIT_LIBRARYS(name, function) gl::function,
const CombinerFunctions kLayerFunctions{NINEBIT_COMBINER_FUNCTIONS(NINEBIT_LAYERS)};
const CombinerFunctions kLibraryFunctions{NINEBIT_COMBINER_FUNCTIONS(NINEBIT_LIBRARYS)};

CombinerCommand random_command(Random& random, const HardwareProfile& profile, bool setting, int mistakes) {
  CombinerCommand command;
  command.function = random.below(setting ? kSettingFunctions + 2 : kCombinerFunctions);
  if (setting && command.function >= kSettingFunctions) command.function += 15 - kSettingFunctions;
  command.enums = right_enums(random, profile, command.function);
  for (GLenum& value : command.enums) {
    if (random.one_in(mistakes)) value = wrong_enum(random);
  }
  // Only enumerants of these extensions: others belong to the driver.
  if (command.function >= 15) command.enums = right_enums(random, profile, command.function);
  for (GLboolean& flag : command.flags) flag = random.one_in(4) ? GLboolean{GL_TRUE} : GLboolean{GL_FALSE};
  if (command.enums[1] == GL_ALPHA && !random.one_in(4)) command.flags[0] = command.flags[1] = GL_FALSE;
  for (GLfloat& value : command.floats) value = random.real_f(-0.2, 1.2);
  for (GLint& value : command.integers) value = static_cast<GLint>(random.next());
  if (command.enums[0] == GL_NUM_GENERAL_COMBINERS_NV) {
    command.integers[0] = random.between(0, profile.general_combiners + 1);
    command.floats[0] = static_cast<GLfloat>(command.integers[0]);
  }
  command.null = random.one_in(4 * mistakes);
  return command;
}

std::array<GLfloat, 4> execute(const CombinerFunctions& f, const CombinerCommand& c) {
  const auto& e = c.enums;
  std::array<GLfloat, 4> floats{-1, -1, -1, -1};
  std::array<GLint, 4> integers{-1, -1, -1, -1};
  GLfloat* const got_floats = c.null ? nullptr : floats.data();
  GLint* const got_integers = c.null ? nullptr : integers.data();
  // clang-format off
  switch (c.function) {
    case 0: f.parameterfv(e[0], c.null ? nullptr : c.floats.data()); break;
    case 1: f.parameteriv(e[0], c.null ? nullptr : c.integers.data()); break;
    case 2: f.parameterf(e[0], c.floats[0]); break;
    case 3: f.parameteri(e[0], c.integers[0]); break;
    case 4: f.input(e[0], e[1], e[2], e[3], e[4], e[5]); break;
    case 5: f.output(e[0], e[1], e[2], e[3], e[4], e[5], e[6], c.flags[0], c.flags[1], c.flags[2]); break;
    case 6: f.final_input(e[0], e[1], e[2], e[3]); break;
    case 7: f.stage_parameterfv(e[0], e[1], c.null ? nullptr : c.floats.data()); break;
    case 8: f.get_inputfv(e[0], e[1], e[2], e[3], got_floats); break;
    case 9: f.get_inputiv(e[0], e[1], e[2], e[3], got_integers); break;
    case 10: f.get_outputfv(e[0], e[1], e[2], got_floats); break;
    case 11: f.get_outputiv(e[0], e[1], e[2], got_integers); break;
    case 12: f.get_final_inputfv(e[0], e[1], got_floats); break;
    case 13: f.get_final_inputiv(e[0], e[1], got_integers); break;
    case 14: f.get_stage_parameterfv(e[0], e[1], got_floats); break;
    case 15: f.enable(e[0]); break;
    default: f.disable(e[0]); break;
  }
  // clang-format on
  if (c.function == 9 || c.function == 11 || c.function == 13) floats[0] = static_cast<GLfloat>(integers[0]);
  return floats;
}

std::vector<GLfloat> read_state(const CombinerFunctions& f, const HardwareProfile& profile) {
  std::vector<GLfloat> values;
  GLfloat got[4]{};
  const auto add = [&](int count) { values.insert(values.end(), got, got + count); };
  for (int i = 0; i < profile.general_combiners; ++i) {
    const GLenum stage = GL_COMBINER0_NV + static_cast<GLenum>(i);
    for (const GLenum part : std::initializer_list<GLenum>{GL_RGB, GL_ALPHA}) {
      for (GLenum variable = GL_VARIABLE_A_NV; variable <= GL_VARIABLE_D_NV; ++variable) {
        for (GLenum name = GL_COMBINER_INPUT_NV; name <= GL_COMBINER_COMPONENT_USAGE_NV; ++name) {
          f.get_inputfv(stage, part, variable, name, got);
          add(1);
        }
      }
      for (GLenum name = GL_COMBINER_AB_DOT_PRODUCT_NV; name <= GL_COMBINER_SUM_OUTPUT_NV; ++name) {
        f.get_outputfv(stage, part, name, got);
        add(1);
      }
    }
    if (!profile.per_stage_constants) continue;
    for (const GLenum name : std::initializer_list<GLenum>{GL_CONSTANT_COLOR0_NV, GL_CONSTANT_COLOR1_NV}) {
      f.get_stage_parameterfv(stage, name, got);
      add(4);
    }
  }
  for (GLenum variable = GL_VARIABLE_A_NV; variable <= GL_VARIABLE_G_NV; ++variable) {
    for (GLenum name = GL_COMBINER_INPUT_NV; name <= GL_COMBINER_COMPONENT_USAGE_NV; ++name) {
      f.get_final_inputfv(variable, name, got);
      add(1);
    }
  }
  for (const GLenum name : std::initializer_list<GLenum>{GL_NUM_GENERAL_COMBINERS_NV, GL_COLOR_SUM_CLAMP_NV}) {
    f.get_floatv(name, got);
    add(1);
  }
  for (const GLenum name : std::initializer_list<GLenum>{GL_CONSTANT_COLOR0_NV, GL_CONSTANT_COLOR1_NV}) {
    f.get_floatv(name, got);
    add(4);
  }
  values.push_back(f.is_enabled(GL_REGISTER_COMBINERS_NV));
  if (profile.per_stage_constants) values.push_back(f.is_enabled(GL_PER_STAGE_CONSTANTS_NV));
  return values;
}

}  // namespace ninebit::test
