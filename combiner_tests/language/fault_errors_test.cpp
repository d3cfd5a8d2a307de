// Which GL error a fault of a text carries, in each form; and that faults which GL never sees carry none.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "ninebit/language/gl_calls.h"
#include "ninebit/language/rc10.h"
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

Errors of_gl(const std::string& text) {
  return errors_of(parse_gl_calls({text, "f"}, profiles::geforce2));
}
Errors of_rc10(const std::string& text) {
  return errors_of(parse_rc10({"!!RC1.0\n" + text, "f"}, profiles::geforce2));
}
Errors of_rgb(const std::string& statements) {
  return of_rc10("{ rgb { " + statements + " } } out.a = zero;");
}
Errors of_alpha(const std::string& statements) {
  return of_rc10("{ alpha { " + statements + " } } out.a = zero;");
}
Errors of_words(const std::string& text, ChipClass chip = ChipClass::nv10) {
  return errors_of(
      parse_register_words({text, "f"}, chip, chip == ChipClass::nv10 ? profiles::geforce2 : profiles::nv2a));
}

TEST(FaultErrors, OfATextAreShownBeforeTheMessage) {
  EXPECT_EQ((TextFault{"f", 1, 2, "m", no_error}.text()), "f:1:2: m");
  EXPECT_EQ((TextFault{"f", 1, 2, "m", invalid_value}.text()), "f:1:2: GL_INVALID_VALUE: m");
}

TEST(FaultErrors, OfGlCalls) {
  EXPECT_EQ(of_gl("glEnable(GL_FOG);"), Errors{invalid_enum});
  EXPECT_EQ(of_gl("glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 3);"), Errors{invalid_value});
  EXPECT_EQ(of_gl("glFinalCombinerInputNV(GL_VARIABLE_A_NV, GL_SPARE0_PLUS_SECONDARY_COLOR_NV, "
                  "GL_UNSIGNED_IDENTITY_NV, GL_RGB);"),
            Errors{invalid_operation});
  // A program that does not compile never reaches GL.
  EXPECT_EQ(of_gl("glEnable(GL_FOO); glFoo(); glEnable(1, 2); glEnable(1.5);"),
            (Errors{no_error, no_error, no_error, no_error}));
}

TEST(FaultErrors, OfGeneralCombinersInRc10) {
  EXPECT_EQ(of_rgb("zero = tex0;"), Errors{invalid_enum});
  EXPECT_EQ(of_rgb("tex2 = tex3;"), (Errors{invalid_enum, invalid_enum}));
  EXPECT_EQ(of_rgb("spare0 = tex0; spare0 = tex1;"), Errors{invalid_operation});
  EXPECT_EQ(of_rgb("spare0 = discard;"), Errors{invalid_enum});
  EXPECT_EQ(of_rgb("spare0 = color_sum; final_product = tex0;"), (Errors{invalid_enum, invalid_enum}));
  EXPECT_EQ(of_rgb("spare0 = tex0.b * fog.a;"), (Errors{invalid_operation, invalid_operation}));
  EXPECT_EQ(of_alpha("spare0 = tex0.rgb . fog;"), (Errors{invalid_operation, invalid_value, invalid_operation}));
  // The suffix of what is written is left out of the call.
  EXPECT_EQ(of_rgb("spare0.b = tex0;"), Errors{no_error});
  EXPECT_EQ(of_alpha("spare0.rgb = tex0;"), Errors{no_error});
}

TEST(FaultErrors, OfTheFinalCombinerInRc10) {
  EXPECT_EQ(of_rc10("out.rgb = discard;"), Errors{invalid_enum});
  EXPECT_EQ(of_rc10("out.rgb = tex0.b;"), Errors{invalid_operation});
  EXPECT_EQ(of_rc10("out.a = color_sum;"), Errors{invalid_operation});
  EXPECT_EQ(of_rc10("out.a = tex0.rgb;"), Errors{invalid_operation});
  EXPECT_EQ(of_rc10("final_product = color_sum * tex0.b; out.rgb = final_product;"),
            (Errors{invalid_operation, invalid_operation}));
  EXPECT_EQ(of_rc10("out.rgb = color_sum * color_sum;"), Errors{invalid_operation});
  EXPECT_EQ(of_rc10("out.a = expand(tex0);"), Errors{invalid_enum});
  EXPECT_EQ(of_rc10("out.rgb = -tex0;"), Errors{invalid_enum});
}

TEST(FaultErrors, OfWhatAProfileLacksInRc10) {
  EXPECT_EQ(of_rc10("{ rgb { spare0 = tex0; } } { rgb { spare0 = tex0; } } { rgb { spare0 = tex0; } } out.a = zero;"),
            Errors{invalid_value});
  EXPECT_EQ(of_rc10("{ const0 = (0, 0, 0, 0); rgb { spare0 = tex0; } } out.a = zero;"), Errors{invalid_enum});
}

TEST(FaultErrors, NoneOfWhatRc10FindsByItself) {
  // Grammar, repetitions, and what nvparse leaves out of its calls.
  EXPECT_EQ(of_rc10("out.rgb = final_product;"), Errors{no_error});
  EXPECT_EQ(of_rc10("const0 = (0, 0, 0, 0); const0 = (0, 0, 0, 0); out.a = zero;"), Errors{no_error});
  EXPECT_EQ(of_rgb("spare0 = expand tex0;"), Errors{no_error});
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
