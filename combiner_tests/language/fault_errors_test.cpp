// Which GL error a fault of register words carries, and that faults which GL never sees carry none. Of calls and of
// !!RC1.0 the tables of their faults say it (gl_calls_faults_test.cpp, rc10_faults_test.cpp).
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "ninebit/language/register_words.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit {
namespace {

using enum GlError;
using Errors = std::vector<GlError>;

Errors errors_of(const Parsed<CombinerState>& parsed) {
  Errors errors;
  for (const TextFault& fault : parsed.faults()) {
    errors.push_back(fault.gl_error);
    EXPECT_FALSE(fault.message.starts_with("GL_")) << fault.message;
    EXPECT_EQ(fault.text().find(": GL_INVALID_") != std::string::npos, fault.gl_error != no_error) << fault.text();
  }
  return errors;
}

Errors of_words(const std::string& text, ChipClass chip = ChipClass::nv10) {
  return errors_of(
      parse_register_words({text, "f"}, chip, chip == ChipClass::nv10 ? profiles::geforce2 : profiles::nv2a));
}

TEST(FaultErrors, OfATextAreShownBeforeTheMessage) {
  EXPECT_EQ((TextFault{"f", 1, 2, "m", no_error}.text()), "f:1:2: m");
  EXPECT_EQ((TextFault{"f", 1, 2, "m", invalid_value}.text()), "f:1:2: GL_INVALID_VALUE: m");
}

TEST(FaultErrors, OfRegisterWords) {
  EXPECT_EQ(of_words("RC_IN_RGB[0] = 0x13000000"), Errors{invalid_operation});  // fog's alpha
  EXPECT_EQ(of_words("RC_IN_RGB[0] = 0x0a000000"), Errors{invalid_enum});       // texture2
  EXPECT_EQ(of_words("RC_IN_RGB[0] = 0x0f000000"), Errors{invalid_enum});       // E times F
  EXPECT_EQ(of_words("RC_FINAL1 = 0x0f000000"), Errors{invalid_operation});     // E times F, in variable E
  EXPECT_EQ(of_words("RC_OUT_RGB[0] = 0x00000300"), Errors{invalid_enum});      // fog is written
  EXPECT_EQ(of_words("RC_OUT_RGB[0] = 0x00000ccc"), (Errors(3, invalid_operation)));
  EXPECT_EQ(of_words("RC_OUT_RGB[0] = 0x00028c00"), Errors{invalid_operation});  // bias with a scale by four
  EXPECT_EQ(of_words("RC_OUT_ALPHA[0] = 0x00002c00"), Errors{invalid_value});    // a dot product
  EXPECT_EQ(of_words("RC_OUT_RGB[1] = 0x08000c00"), Errors{invalid_value});      // no general combiner
  EXPECT_EQ(of_words("RC_ENABLE = 0x109", ChipClass::nv20), Errors{invalid_value});
}

// As where stage constants are asked for, which GL refuses by the names of their parameters.
TEST(FaultErrors, OfWhatAProfileHasNot) {
  EXPECT_EQ(of_words("RC_FINAL1 = 0x00001cc0"), Errors{invalid_enum});      // 1 - x in the colour sum
  EXPECT_EQ(of_words("RC_OUT_RGB[1] = 0x20004c00"), Errors{invalid_enum});  // mux by the lowest bit
}

TEST(FaultErrors, NoneOfWhatAChipAloneRefuses) {
  EXPECT_EQ(of_words("RC_IN_RGB[0] = 0x06000000"), Errors{no_error});  // no register has this code
  EXPECT_EQ(of_words("RC_OUT_RGB[0] = 0x00000600"), Errors{no_error});
  EXPECT_EQ(of_words("RC_FINAL0 = 0x40000000"), Errors{no_error});  // outside the mask
  EXPECT_EQ(of_words("RC_IN_RGB[0] = zero\nFOO = 1"), (Errors{no_error, no_error}));
}

}  // namespace
}  // namespace ninebit
