#include <gtest/gtest.h>
#include <ninebit/capi/combiner.h>

#include <cstdint>
#include <cstring>

TEST(Examples, Combiner) {
  const char* const text = "!!RC1.0\nout.rgb = unsigned_invert(tex0);";
  ninebit_state* state = nullptr;
  ninebit_program* program = nullptr;
  char* error = nullptr;
  ASSERT_EQ(ninebit_state_parse("geforce2", NINEBIT_FORM_RC10, text, std::strlen(text), &state, &error), NINEBIT_OK);
  ASSERT_EQ(ninebit_compile(state, &program, &error), NINEBIT_OK);
  ninebit_registers registers = {};
  registers.struct_size = sizeof registers;
  registers.code[NINEBIT_TEXTURE0][0] = 200;
  std::int16_t color[4];
  EXPECT_EQ(ninebit_evaluate(program, &registers, color, nullptr, &error), NINEBIT_OK);
  EXPECT_EQ(color[0], 55);
  ninebit_program_free(program);
  ninebit_state_free(state);
}
