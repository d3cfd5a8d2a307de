// One fault in every language: `validate` gives 1 with GL's error, the verbs that need a program 3.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "combiner_tests/tools/program_support.h"

namespace tools_test {
namespace {

struct SameFault {
  const char* name;
  const char* gl_error;
  std::string calls, rc10, words, json, xbox;
};

std::string stages_of_rc10(int count) {
  std::string text = "!!RC1.0\n";
  for (int i = 0; i < count; ++i) text += "{ rgb { spare0 = tex0 * col0; } }\n";
  return text + "out.rgb = spare0;\n";
}

std::string json_of_rgb(const std::string& rgb) {
  return R"({"ninebit": "program", "version": 1, "general_combiners": [{"rgb": )" + rgb + "}]}\n";
}

const std::vector<SameFault> kSameFaults{
    {"too many combiners", "GL_INVALID_VALUE", "glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 9);\n",
     stages_of_rc10(9), "RC_ENABLE = 0x00000109\n",
     R"({"ninebit": "program", "version": 1, "num_general_combiners": 9})", "psd.PSCombinerCount = 0x00000109;\n"},
    {"a register of the final combiner", "GL_INVALID_ENUM",
     "glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, GL_E_TIMES_F_NV, GL_UNSIGNED_IDENTITY_NV, "
     "GL_RGB);\n",
     "!!RC1.0\n{ rgb { spare0 = final_product * tex1; } }\nout.rgb = spare0;\n", "RC_IN_RGB[0] = 0x0f000000\n",
     json_of_rgb(R"({"a": {"input": "e_times_f"}})"), "psd.PSCombinerCount = 1;\npsd.PSRGBInputs[0] = 0x0f000000;\n"},
    {"a register that cannot be written", "GL_INVALID_ENUM",
     "glCombinerOutputNV(GL_COMBINER0_NV, GL_RGB, GL_CONSTANT_COLOR0_NV, GL_DISCARD_NV, GL_DISCARD_NV, GL_NONE, "
     "GL_NONE, GL_FALSE, GL_FALSE, GL_FALSE);\n",
     "!!RC1.0\n{ rgb { const0 = tex0 * tex1; } }\nout.rgb = spare0;\n", "RC_OUT_RGB[0] = 0x00000010\n",
     json_of_rgb(R"({"output": {"ab": "constant_color0"}})"),
     "psd.PSCombinerCount = 1;\npsd.PSRGBOutputs[0] = 0x00000010;\n"},
    {"a register that cannot be read", "GL_INVALID_ENUM",
     "glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, GL_DISCARD_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);\n",
     "!!RC1.0\n{ rgb { spare0 = discard * tex1; } }\nout.rgb = spare0;\n", "",
     json_of_rgb(R"({"a": {"input": "discard"}})"), ""},
    {"two outputs to one register", "GL_INVALID_OPERATION",
     "glCombinerOutputNV(GL_COMBINER0_NV, GL_RGB, GL_SPARE0_NV, GL_SPARE0_NV, GL_DISCARD_NV, GL_NONE, GL_NONE, "
     "GL_FALSE, GL_FALSE, GL_FALSE);\n",
     "!!RC1.0\n{ rgb { spare0 = tex0 * tex1; spare0 = tex0 * col0; } }\nout.rgb = spare0;\n",
     "RC_OUT_RGB[0] = 0x000000cc\n", json_of_rgb(R"({"output": {"ab": "spare0", "cd": "spare0", "sum": "discard"}})"),
     "psd.PSCombinerCount = 1;\npsd.PSRGBOutputs[0] = 0x000000cc;\n"},
    {"fog's alpha in a general combiner", "GL_INVALID_OPERATION",
     "glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, GL_FOG, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);\n",
     "!!RC1.0\n{ rgb { spare0 = fog.a * tex1; } }\nout.rgb = spare0;\n", "RC_IN_RGB[0] = 0x13000000\n",
     json_of_rgb(R"({"a": {"input": "fog", "usage": "alpha"}})"),
     "psd.PSCombinerCount = 1;\npsd.PSRGBInputs[0] = 0x13000000;\n"},
};

// The register writes that have the words of a text, as a log.
std::string log_of(const std::string& words) {
  const std::size_t equal = words.find(" = ");
  const std::string name = words.substr(0, equal);
  const std::string method = name == "RC_ENABLE"       ? "0x1e60"
                             : name == "RC_IN_RGB[0]"  ? "0xac0"
                             : name == "RC_OUT_RGB[0]" ? "0x1e40"
                                                       : "";
  const std::string enable = name == "RC_ENABLE" ? "" : "0x97,0x1e60,0x1\n";
  return "class,method,data\n" + enable + "0x97," + method + "," + words.substr(equal + 3) +
         "0x97,0x17fc,5\n0x97,0x17fc,0\n";
}

class SameFaults : public testing::Test {
 protected:
  void expect_refusal(const std::string& text, const std::string& gl_error, const Words& flags) {
    SCOPED_TRACE(text);
    const std::string file = write_bytes(folder_ / "program", text);
    const std::string inputs = write_bytes(folder_ / "inputs.csv", "tex0.r\n1\n");
    const auto run = [&](const Words& words) { return ninebit(words + flags + Words{"--profile", "nv2a"}); };
    expect_parts(out_of(run({"validate", file}), 1), {gl_error});
    EXPECT_EQ(run({"explain", file}).code, 3);
    if (gl_error != kSameFaults[0].gl_error) return;  // all verbs read programs by the same call
    EXPECT_EQ(run({"eval", file, "--inputs", inputs}).code, 3);
    EXPECT_EQ(run({"convert", file, "--to", "rc10"}).code, 3);
    EXPECT_EQ(run({"trace", file}).code, 3);
  }
  TempFolder folder_;
};

TEST_F(SameFaults, HaveOneExitCodeInEveryLanguage) {
  for (const SameFault& fault : kSameFaults) {
    SCOPED_TRACE(fault.name);
    expect_refusal(fault.calls, fault.gl_error, {});
    expect_refusal(fault.rc10, fault.gl_error, {});
    expect_refusal(fault.json, fault.gl_error, {});
    expect_refusal("void set_up(void)\n{\n" + fault.calls + "}\n", fault.gl_error, {"--function", "set_up"});
    if (fault.words.empty()) continue;  // they have no code for it
    expect_refusal(fault.words, fault.gl_error, {"--chip", "nv20"});
    expect_refusal(fault.xbox, fault.gl_error, {});
    expect_refusal(log_of(fault.words), fault.gl_error, {});
  }
}

TEST_F(SameFaults, WhatIsNoProgramHasAnotherInEveryLanguage) {
  const Words none{
      "glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV;\n",
      "!!RC1.0\n{ rgb { spare0 = tex0 ** tex1; } }\n",
      "!!RC1.0\n{ rgb { spare0 = tex0 . tex1; discard = tex0; spare1 = mux(); } }\nout.rgb = spare0;\n",
      "RC_OUT_RGB[0] = 0xg\n",
      json_of_rgb(R"({"output": {"ab": "spare7"}})"),
      json_of_rgb("3"),
      "psd.PSCombinerCount = ;\n",
      "class,method,data\n0x97,0x1e60\n",
      "!!ARBfp1.0\nMOV result.color, fragment.color;\nEND\n",
  };
  for (const std::string& text : none) {
    SCOPED_TRACE(text);
    const std::string file = write_bytes(folder_ / "program", text);
    EXPECT_EQ(ninebit({"validate", file, "--profile", "nv2a"}).code, 3);
    EXPECT_EQ(ninebit({"explain", file, "--profile", "nv2a"}).code, 3);
  }
}

TEST_F(SameFaults, AFunctionThatCannotBeReadIsNoProgram) {
  const std::string file = write_bytes(
      folder_ / "file.c", "void set_up(void)\n{\n  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, light[);\n}\n");
  EXPECT_EQ(ninebit({"validate", file, "--function", "set_up", "--profile", "nv2a"}).code, 3);
  EXPECT_EQ(ninebit({"explain", file, "--profile", "nv2a"}).code, 3);
}

}  // namespace
}  // namespace tools_test
