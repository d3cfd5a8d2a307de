// Definitions as arrays and hex dumps: which form they are found to be, and their faults.
#include <gtest/gtest.h>

#include "combiner_tests/language/all_faults.h"
#include "combiner_tests/language/xbox_shapes.h"
#include "combiner_tests/support/has.h"
#include "ninebit/language/program_text.h"
#include "ninebit/language/xbox_pixel_shader.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::test {
namespace {

// Expects one fault, which is there.
void expect_list_fault(int line, int column, const char* message, const std::string& text) {
  const auto parsed = parse_xbox_pixel_shader({text, ""}, profiles::nv2a);
  ASSERT_EQ(parsed.faults().size(), 1U) << text << all_faults(parsed);
  EXPECT_EQ(parsed.faults()[0].line, line) << parsed.faults()[0].text();
  EXPECT_EQ(parsed.faults()[0].column, column) << parsed.faults()[0].text();
  EXPECT_TRUE(has(parsed.faults()[0].message, message)) << parsed.faults()[0].text();
}

TEST(XboxLists, ArraysHaveOneDefinitionAndNothingElse) {
  Random random(87);
  const Words words = random_words(random);
  const std::string bytes = as_bytes(words);
  std::string array = "DWORD ps[] = {", large = "const BYTE ps[] = {";
  for (const std::uint32_t word : words) array += hex(word) + ",";
  for (std::size_t i = 1; i < bytes.size(); ++i) large += "0,";
  array += "};\n";
  EXPECT_TRUE(is_xbox_pixel_shader(array));
  EXPECT_TRUE(parse_xbox_pixel_shader({array + "#endif\n;unsigned ps_len = 60;\n", ""}, profiles::nv2a));
  expect_list_fault(2, 1, "a second array; the first is in line 1, and a text has one definition", array + array);
  expect_list_fault(2, 1, "expected the end of the text behind the array; found 'SetShader'", array + "SetShader(ps);");
  expect_list_fault(1, 498, "the value does not fit in 8 bits", large + "256};");
  EXPECT_FALSE(is_xbox_pixel_shader("GLint" + array.substr(5)));
}

TEST(XboxLists, HexDumpsAreNotLogsEvenIfTheyEndEarly) {
  std::string dump;
  for (std::uint32_t row = 0; row < 9; ++row) {
    dump += hex(16 * row, "%07o") + " 00 01 02 03 04 05 06 07 08 09 0a 0b 0c 0d 0e 0f\n";
  }
  EXPECT_EQ(form_of(dump), ProgramForm::xbox);
  expect_list_fault(9, 54, "144 bytes; expected the 240 of a D3DPIXELSHADERDEF", dump);
  // Methods that follow each other are not offsets.
  std::string log;
  for (std::uint32_t method = 0x1e40; method < 0x1e60; method += 4) log += hex(method, "%04x") + " 000000c0\n";
  EXPECT_EQ(form_of(log), ProgramForm::log);
}

// Characters behind the bytes may look like bytes.
TEST(XboxLists, CharactersAreNotNumbers) {
  std::string xxd, windbg;
  for (std::uint32_t row = 0; row < 15; ++row) {
    xxd += hex(16 * row, "%08x:") + " 6162 2063 6420 6162 2063 6420 6162 2063  ab cd ab cd ab c\n";
    windbg += hex(16 * row, "%08x ") + " 61 62 20 63 64 20 61 62-20 63 64 20 61 62 20 63  ab cd ab cd ab c\n";
  }
  for (const std::string& text : {xxd, windbg}) {
    ASSERT_TRUE(is_xbox_pixel_shader(text));
    const auto parsed = parse_xbox_pixel_shader({text, ""}, profiles::nv2a);
    EXPECT_FALSE(has(all_faults(parsed), "of a D3DPIXELSHADERDEF"));
    EXPECT_FALSE(has(all_faults(parsed), "is not a number"));
  }
}

}  // namespace
}  // namespace ninebit::test
