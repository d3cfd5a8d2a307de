#include <gtest/gtest.h>
#include <ninebit/combiner/normalize.h>
#include <ninebit/language/trace_json.h>

#include <string>

TEST(Examples, TraceJson) {
  using namespace ninebit;
  const Program program = normalize(CombinerState{}, profiles::geforce2);
  const std::string json = print_json_trace(program, trace(program, profiles::geforce2, RegisterFile{}));
  EXPECT_EQ(json.front(), '{');
  EXPECT_NE(json.find("\"stages\""), std::string::npos);
}
