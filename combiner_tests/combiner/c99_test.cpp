// The two C99 files that emulators copy, compiled as C: profiles, defaults, faults, programs, results and register
// words are those of the library.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/combiner/support.h"
#include "combiner_tests/support/chip_words.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/validate.h"
#include "ninebit/numerics/fixed9.h"
#include "ninebit/numerics/profile_fields.h"
#include "src/combiner/c99/ninebit_combiner.h"

namespace ninebit::test {
namespace {

// A field of the C files' profile, by its name in the table of all fields.
struct FieldInC {
  const char* name;
  int (*get)(const nbc_profile& profile);
  void (*set)(nbc_profile& profile, int value);
};

template <auto kMember>
constexpr FieldInC field_in_c(const char* name) {
  return {name, [](const nbc_profile& p) { return static_cast<int>(p.*kMember); },
          [](nbc_profile& p, int v) { p.*kMember = static_cast<std::decay_t<decltype(p.*kMember)>>(v); }};
}

#define NINEBIT_FIELD(member) field_in_c<&nbc_profile::member>(#member),
constexpr std::array kFieldsInC{NBC_ARITHMETIC(NINEBIT_FIELD) NBC_CHIP(NINEBIT_FIELD)};
#undef NINEBIT_FIELD
static_assert(kFieldsInC.size() == 15);

nbc_profile profile_in_c(const HardwareProfile& profile) {
  nbc_profile c{};
  c.name = "a profile";
  for (const FieldInC& field : kFieldsInC) {
    const auto* const known = find_profile_field(field.name);
    EXPECT_NE(known, nullptr) << field.name;
    if (known != nullptr) field.set(c, known->get(profile).value);
  }
  return c;
}

bool is_same_profile(const nbc_profile& a, const nbc_profile& b) {
  return std::all_of(kFieldsInC.begin(), kFieldsInC.end(),
                     [&](const FieldInC& field) { return field.get(a) == field.get(b); });
}

nbc_input in_c(const CombinerInput& in) {
  return {static_cast<nbc_register>(in.reg), static_cast<nbc_mapping>(in.mapping), static_cast<nbc_usage>(in.usage)};
}

nbc_portion in_c(const Portion& p) {
  return {in_c(p.a),
          in_c(p.b),
          in_c(p.c),
          in_c(p.d),
          {static_cast<nbc_register>(p.out.ab), static_cast<nbc_register>(p.out.cd),
           static_cast<nbc_register>(p.out.sum), static_cast<nbc_scale>(p.out.scale), static_cast<nbc_bias>(p.out.bias),
           p.out.ab_dot_product, p.out.cd_dot_product, p.out.mux_sum, p.out.ab_blue_to_alpha, p.out.cd_blue_to_alpha}};
}

nbc_final in_c(const FinalCombiner& f) {
  return {in_c(f.a), in_c(f.b), in_c(f.c), in_c(f.d), in_c(f.e), in_c(f.f), in_c(f.g)};
}

nbc_state in_c(const CombinerState& state) {
  nbc_state c{};
  c.num_general_combiners = state.num_general_combiners;
  c.color_sum_clamp = state.color_sum_clamp;
  c.color_sum_invert_spare0 = state.color_sum_invert_spare0;
  c.color_sum_invert_secondary = state.color_sum_invert_secondary;
  c.per_stage_constants = state.per_stage_constants;
  c.mux_by_lowest_bit = state.mux_by_lowest_bit;
  std::copy(state.constant0.begin(), state.constant0.end(), c.constant0);
  std::copy(state.constant1.begin(), state.constant1.end(), c.constant1);
  for (std::size_t i = 0; i < state.general.size(); ++i) {
    const GeneralCombiner& stage = state.general[i];
    c.general[i].rgb = in_c(stage.rgb);
    c.general[i].alpha = in_c(stage.alpha);
    std::copy(stage.constant0.begin(), stage.constant0.end(), c.general[i].constant0);
    std::copy(stage.constant1.begin(), stage.constant1.end(), c.general[i].constant1);
  }
  c.final_combiner = in_c(state.final_combiner);
  return c;
}

// All that a program says, as one text that two programs can be compared by.
std::string c_text_of(const nbc_input& in) {
  return std::to_string(in.reg) + '/' + std::to_string(in.mapping) + '/' + std::to_string(in.usage) + ' ';
}
std::string c_text_of(const nbc_portion& p) {
  std::string text = c_text_of(p.a) + c_text_of(p.b) + c_text_of(p.c) + c_text_of(p.d);
  const nbc_output& out = p.out;
  for (const int field :
       {int{out.ab}, int{out.cd}, int{out.sum}, int{out.scale}, int{out.bias}, int{out.ab_dot_product},
        int{out.cd_dot_product}, int{out.mux_sum}, int{out.ab_blue_to_alpha}, int{out.cd_blue_to_alpha}}) {
    text += std::to_string(field) + ' ';
  }
  return text;
}
std::string c_text_of(const nbc_final& f) {
  return c_text_of(f.a) + c_text_of(f.b) + c_text_of(f.c) + c_text_of(f.d) + c_text_of(f.e) + c_text_of(f.f) +
         c_text_of(f.g);
}
template <class Four>
std::string c_text_of_four(const Four& four) {
  std::string text;
  for (const auto v : four) text += std::to_string(v) + ' ';
  return text;
}
std::string c_text_of(const nbc_program& p) {
  std::string text = std::to_string(p.num_general_combiners) + (p.color_sum_clamp ? "c" : "-") +
                     (p.color_sum_invert_spare0 ? "0" : "-") + (p.color_sum_invert_secondary ? "1" : "-") + '\n';
  for (const nbc_stage& stage : p.general) {
    text += c_text_of(stage.rgb) + "| " + c_text_of(stage.alpha) + "| " + c_text_of_four(stage.constant0) +
            c_text_of_four(stage.constant1) + (stage.mux_by_lowest_bit ? "lsb\n" : "msb\n");
  }
  return text + c_text_of(p.final_combiner) + c_text_of_four(p.constant0) + c_text_of_four(p.constant1);
}
std::string c_text_of(const Program& p) {
  nbc_program c{};
  c.num_general_combiners = p.num_general_combiners;
  c.color_sum_clamp = p.color_sum_clamp;
  c.color_sum_invert_spare0 = p.color_sum_invert_spare0;
  c.color_sum_invert_secondary = p.color_sum_invert_secondary;
  for (std::size_t i = 0; i < p.general.size(); ++i) {
    nbc_stage& stage = c.general[i];
    stage.rgb = in_c(p.general[i].rgb);
    stage.alpha = in_c(p.general[i].alpha);
    stage.mux_by_lowest_bit = p.general[i].mux_by_lowest_bit;
    std::copy(p.general[i].constant0.begin(), p.general[i].constant0.end(), stage.constant0);
    std::copy(p.general[i].constant1.begin(), p.general[i].constant1.end(), stage.constant1);
  }
  c.final_combiner = in_c(p.final_combiner);
  std::copy(p.constant0.begin(), p.constant0.end(), c.constant0);
  std::copy(p.constant1.begin(), p.constant1.end(), c.constant1);
  return c_text_of(c);
}

struct EvaluatedInC {
  RegisterFile registers;
  Rgba9 color{};
};

EvaluatedInC evaluate_in_c(const nbc_program& program, const RegisterFile& start) {
  std::int16_t registers[NBC_REGISTERS][4];
  for (std::size_t r = 0; r < kRegisterCount; ++r)
    std::copy(start.value[r].begin(), start.value[r].end(), registers[r]);
  EvaluatedInC result;
  nbc_evaluate(&program, registers, result.color.data());
  for (std::size_t r = 0; r < kRegisterCount; ++r) std::copy_n(registers[r], 4, result.registers.value[r].begin());
  return result;
}

// The program of a valid state by both, which are expected to be equal.
nbc_program compiled_in_c(const CombinerState& state, const HardwareProfile& profile) {
  const nbc_state c = in_c(state);
  const nbc_profile c_profile = profile_in_c(profile);
  nbc_program program{};
  EXPECT_TRUE(nbc_compile(&c, &c_profile, &program));
  EXPECT_EQ(c_text_of(program), c_text_of(normalize(state, profile)));
  EXPECT_TRUE(is_same_profile(program.datapath, c_profile));
  return program;
}

void expect_same_in_c(const Program& program, const nbc_program& c, const RegisterFile& start) {
  RegisterFile registers = start;
  evaluate_general(program, registers);
  const EvaluatedInC result = evaluate_in_c(c, start);
  ASSERT_EQ(result.registers, registers);
  ASSERT_EQ(result.color, evaluate_final(program, registers));
}

TEST(C99, HasTheShippedIntegerProfiles) {
  std::size_t found = 0;
  for (const HardwareProfile& profile : hardware_profiles()) {
    const std::string name(profile.name);
    const nbc_profile* const c = nbc_find_profile(name.c_str());
    EXPECT_EQ(c != nullptr, profile.arithmetic == Arithmetic::integer) << name;
    if (c == nullptr) continue;
    ++found;
    EXPECT_TRUE(is_same_profile(*c, profile_in_c(profile))) << name;
    EXPECT_EQ(c->name, profile.name);
  }
  EXPECT_EQ(found, integer_profiles().size());
  EXPECT_EQ(nbc_find_profile("geforce"), nullptr);
  EXPECT_EQ(nbc_find_profile("geforce22"), nullptr);
}

TEST(C99, TheDefaultStateIsOpenGls) {
  nbc_state state;
  nbc_default_state(&state);
  nbc_program program{};
  for (const HardwareProfile& profile : integer_profiles()) {
    const nbc_profile c_profile = profile_in_c(profile);
    ASSERT_TRUE(nbc_compile(&state, &c_profile, &program));
    EXPECT_EQ(c_text_of(program), c_text_of(normalize({}, profile)));
  }
}

TEST(C99, AllBytesBecomeTheSameCodesAndBack) {
  for (const HardwareProfile& profile : integer_profiles()) {
    const nbc_profile c = profile_in_c(profile);
    for (int byte = 0; byte < 256; ++byte) {
      EXPECT_EQ(nbc_code(&c, static_cast<std::uint8_t>(byte)), from_byte(profile, static_cast<std::uint8_t>(byte)));
    }
    for (int code = profile.lowest; code <= profile.one; ++code) {
      EXPECT_EQ(nbc_byte(&c, static_cast<s9>(code)), to_byte(profile, static_cast<s9>(code)));
    }
  }
}

// Runs a state over all codes in texture 0, each with one of `stride` in the primary colour, whose components differ.
void expect_same_for_pairs(const CombinerState& state, const HardwareProfile& profile, int stride) {
  const Program program = normalize(state, profile);
  const nbc_program c = compiled_in_c(state, profile);
  RegisterFile registers;
  const int low = profile.lowest, count = profile.one - low + 1;
  for (int x = 0; x < count; ++x) {
    for (int y = x % stride; y < count; y += stride) {
      for (int k = 0; k < 4; ++k) {
        const auto i = static_cast<std::size_t>(k);
        registers[Register::texture0][i] = static_cast<s9>(low + x);
        registers[Register::primary][i] = static_cast<s9>(low + (y + k % 3) % count);
      }
      registers[Register::spare0] = registers[Register::primary];
      registers[Register::secondary] = registers[Register::texture0];
      ASSERT_NO_FATAL_FAILURE(expect_same_in_c(program, c, registers));
    }
  }
}

TEST(C99, AllMappingsOfAllCodesAndAllOutputsOfAllProducts) {
  if (kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  for (const HardwareProfile& profile : profiles_and_rivals()) {
    for (const InputMapping mapping : kInputMappings) {
      CombinerState state;
      state.general[0].rgb.a = rgb_of(Register::texture0, mapping);
      state.general[0].rgb.b = rgb_of(Register::primary, mapping);
      state.general[0].alpha.a = alpha_of(Register::texture0, mapping);
      state.general[0].alpha.b = blue_of(Register::primary, mapping);
      ASSERT_NO_FATAL_FAILURE(expect_same_for_pairs(state, profile, 31));
    }
    for (const auto& [scale, bias] : kScaleBias) {
      for (const bool mux : {false, true}) {
        CombinerState state = rgb_stage({rgb_of(Register::texture0, InputMapping::signed_identity),
                                         rgb_of(Register::primary, InputMapping::signed_identity),
                                         rgb_of(Register::texture0, InputMapping::expand_normal),
                                         rgb_of(Register::primary, InputMapping::signed_negate),
                                         {Register::spare1, Register::texture1, Register::texture0, scale, bias}});
        state.general[0].rgb.out.mux_sum = mux;
        state.general[0].alpha = of_alpha(state.general[0].rgb);
        state.mux_by_lowest_bit = mux && profile.mux_by_lowest_bit && bias == Bias::none;
        ASSERT_NO_FATAL_FAILURE(expect_same_for_pairs(state, profile, 7));
      }
    }
  }
}

TEST(C99, TheFinalCombinerOfManyPairsOfCodes) {
  for (const HardwareProfile& profile : profiles_and_rivals()) {
    for (const bool clamp : {false, true}) {
      for (const bool invert : {false, true}) {
        CombinerState state = silent_state(1);
        FinalCombiner& f = state.final_combiner;
        f.a = rgb_of(Register::texture0);
        f.b = rgb_of(Register::spare0_plus_secondary, invert ? InputMapping::unsigned_invert : InputMapping{});
        f.c = rgb_of(Register::e_times_f);
        f.d = rgb_of(clamp ? Register::zero : Register::primary);
        f.e = rgb_of(Register::texture0, invert ? InputMapping::unsigned_invert : InputMapping{});
        f.f = rgb_of(Register::primary);
        f.g = alpha_of(Register::texture0, invert ? InputMapping::unsigned_invert : InputMapping{});
        state.color_sum_clamp = clamp;
        state.color_sum_invert_spare0 = invert && profile.color_sum_inverts;
        state.color_sum_invert_secondary = clamp && profile.color_sum_inverts;
        ASSERT_NO_FATAL_FAILURE(expect_same_for_pairs(state, profile, 7));
      }
    }
  }
}

TEST(C99, RandomProgramsGiveTheSameRegistersAndColors) {
  Random random(50);
  for (int i = 0; i < 5000; ++i) {
    const HardwareProfile profile = random_profile(random);
    const CombinerState state = random_state(random, profile);
    const Program program = normalize(state, profile);
    const nbc_program c = compiled_in_c(state, profile);
    for (int k = 0; k < 4; ++k) {
      ASSERT_NO_FATAL_FAILURE(expect_same_in_c(program, c, random_registers(random, profile))) << "case " << i;
    }
  }
}

// A state with some fields that hold any number.
CombinerState damaged_state(Random& random, const HardwareProfile& profile) {
  CombinerState state = random_state(random, profile);
  for (int i = random.between(1, 4); i > 0; --i) {
    GeneralCombiner& stage = state.general[static_cast<std::size_t>(random.below(kMaxGeneralCombiners))];
    Portion& portion = random.one_in(2) ? stage.rgb : stage.alpha;
    FinalCombiner& f = state.final_combiner;
    CombinerInput& in = *random.pick({&portion.a, &portion.d, &f.a, &f.b, &f.d, &f.e, &f.g});
    Register& to = *random.pick({&portion.out.ab, &portion.out.cd, &portion.out.sum});
    switch (random.below(10)) {
      case 0:
        state.num_general_combiners = random.between(-2, 10);
        break;
      case 1:
        state.per_stage_constants = state.mux_by_lowest_bit = true;
        break;
      case 2:
        state.color_sum_invert_spare0 = true;
        break;
      case 3:
        in.reg = static_cast<Register>(random.below(18));
        break;
      case 4:
        in.mapping = static_cast<InputMapping>(random.below(10));
        break;
      case 5:
        in.usage = static_cast<ComponentUsage>(random.below(5));
        break;
      case 6:
        to = static_cast<Register>(random.below(18));
        break;
      case 7:
        portion.out.scale = static_cast<Scale>(random.below(6));
        break;
      case 8:
        portion.out.bias = static_cast<Bias>(random.below(4));
        break;
      default:
        portion.out.ab_dot_product = portion.out.cd_blue_to_alpha = true;
    }
  }
  return state;
}

TEST(C99, FaultsAreThoseOfTheLibrary) {
  Random random(51);
  int faulty = 0;
  for (int i = 0; i < 5000; ++i) {
    HardwareProfile profile = random_profile(random);
    profile.name = "a profile";
    const CombinerState state = damaged_state(random, profile);
    const std::vector<StateDiagnostic> expected = validate(state, profile);
    const nbc_state c = in_c(state);
    const nbc_profile c_profile = profile_in_c(profile);
    std::vector<nbc_fault> faults(400);
    ASSERT_EQ(nbc_validate(&c, &c_profile, faults.data(), 400), static_cast<int>(expected.size())) << "case " << i;
    nbc_program program{};
    EXPECT_EQ(nbc_compile(&c, &c_profile, &program), expected.empty());
    for (std::size_t k = 0; k < expected.size(); ++k) {
      const nbc_fault& fault = faults[k];
      EXPECT_EQ(fault.stage, expected[k].stage.value_or(-1));
      EXPECT_EQ(fault.portion, expected[k].portion ? static_cast<int>(*expected[k].portion) : -1);
      EXPECT_EQ(fault.variable, expected[k].variable ? static_cast<int>(*expected[k].variable) : -1);
      EXPECT_EQ(fault.parameter, expected[k].parameter ? static_cast<int>(*expected[k].parameter) : -1);
      EXPECT_EQ(fault.gl_error, static_cast<int>(expected[k].gl_error));
      char text[200];
      const int length = nbc_fault_text(&fault, &c_profile, text, sizeof text);
      ASSERT_LT(length, 200);
      EXPECT_EQ(static_cast<std::size_t>(length), std::strlen(text));
      const std::string& message = expected[k].message;
      EXPECT_TRUE(message == text || message.ends_with(std::string(": ") + text)) << message << " / " << text;
    }
    faulty += expected.empty() ? 0 : 1;
  }
  EXPECT_GT(faulty, 3000);
}

TEST(C99, AFaultsTextIsCutToItsSize) {
  nbc_state state;
  nbc_default_state(&state);
  state.num_general_combiners = 3;
  const nbc_profile* const profile = nbc_find_profile("geforce2");
  nbc_fault fault{};
  ASSERT_EQ(nbc_validate(&state, profile, &fault, 1), 1);
  char text[9] = "????????";
  EXPECT_GT(nbc_fault_text(&fault, profile, text, 8), 50);
  EXPECT_STREQ(text, "num_gen");
  EXPECT_EQ(text[8], '\0');
  char whole[80];
  nbc_fault_text(&fault, profile, whole, sizeof whole);
  EXPECT_STREQ(whole, "num_general_combiners is 3; profile geforce2 has 1 to 2");
  EXPECT_GT(nbc_fault_text(&fault, profile, nullptr, 0), 50);
}

TEST(C99, AProfileWithTooManyCombinersHasAsManyAsAStateHasRoomFor) {
  nbc_profile c_profile = *nbc_find_profile("nv2a");
  HardwareProfile profile = profiles::nv2a;
  c_profile.general_combiners = profile.general_combiners.value = 16;
  CombinerState state;
  state.num_general_combiners = 9;
  const std::vector<StateDiagnostic> faults = validate(state, profile);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].message, "num_general_combiners is 9; profile nv2a has 1 to 8");
  const nbc_state c = in_c(state);
  nbc_program program;
  EXPECT_FALSE(nbc_compile(&c, &c_profile, &program));
  nbc_fault fault{};
  ASSERT_EQ(nbc_validate(&c, &c_profile, &fault, 1), 1);
  char text[80];
  nbc_fault_text(&fault, &c_profile, text, sizeof text);
  EXPECT_EQ(text, faults[0].message);
}

// Words of a chip: some random bits in the words of a random valid state.
struct ChipWords {
  nbc_words c{};
  std::vector<RegisterWord> named;
};

ChipWords random_words(Random& random, ChipClass chip) {
  const HardwareProfile& profile = chip == ChipClass::nv20 ? profiles::nv2a : profiles::geforce2;
  ChipWords words;
  CombinerState state = random_state(random, profile);
  const auto encoded = encode_register_words(state, chip, profile);
  EXPECT_TRUE(encoded) << encoded.error().text();
  const bool damaged = random.one_in(4);
  for_each_word(words.c, chip, [&](const std::string& name, std::uint32_t& to) {
    for (const RegisterWord& word : *encoded) {
      if (word.name == name) to = word.value;
    }
    if (damaged && random.one_in(12)) to ^= 1U << random.below(32);
    words.named.push_back({name, to, {}});
  });
  return words;
}

TEST(C99, RegisterWordsGiveTheSamePrograms) {
  Random random(52);
  for (const ChipClass chip : {ChipClass::nv10, ChipClass::nv20}) {
    const HardwareProfile& profile = chip == ChipClass::nv20 ? profiles::nv2a : profiles::geforce2;
    const nbc_profile c_profile = profile_in_c(profile);
    int read = 0, refused = 0;
    for (int i = 0; i < 4000; ++i) {
      const ChipWords words = random_words(random, chip);
      const auto expected = decode_register_words(words.named, "words", chip, profile);
      nbc_state state;
      const bool is_right = nbc_read_words(&words.c, chip == ChipClass::nv20 ? NBC_NV20 : NBC_NV10, &state);
      nbc_program program{};
      const bool is_valid = nbc_compile(&state, &c_profile, &program);
      EXPECT_TRUE(is_right || !is_valid) << "case " << i;
      // The library also refuses bits that a chip has no meaning for.
      if (!expected) {
        refused += is_right && is_valid ? 0 : 1;
        continue;
      }
      ASSERT_TRUE(is_right) << "case " << i;
      ASSERT_TRUE(is_valid) << "case " << i;
      ASSERT_EQ(c_text_of(program), c_text_of(normalize(*expected, profile))) << "case " << i;
      ++read;
    }
    EXPECT_GT(read, 3000);
    EXPECT_GT(refused, 50);
  }
}

TEST(C99, WordsOfANv10HaveNoConstantsOfStages) {
  nbc_words words{};
  nbc_state expected, state;
  words.out_rgb[1] = 1U << 28;
  ASSERT_TRUE(nbc_read_words(&words, NBC_NV10, &expected));
  for (int i = 0; i < 8; ++i)
    words.stage_color0[i] = words.stage_color1[i] = 0x11223344U * static_cast<unsigned>(i % 4);
  words.out_rgb[1] |= 1U << 12 | 1U << 16;  // a dot product, a scale; in an NV20's RC_ENABLE, constants of each stage
  ASSERT_TRUE(nbc_read_words(&words, NBC_NV10, &state));
  for (int i = 0; i < 8; ++i) {
    for (int k = 0; k < 4; ++k) {
      EXPECT_EQ(state.general[i].constant0[k], expected.general[i].constant0[k]);
      EXPECT_EQ(state.general[i].constant1[k], expected.general[i].constant1[k]);
    }
  }
}

// What the words say that no chip has is not forgotten where a caller does.
TEST(C99, WordsThatAreRefusedGiveAStateThatIsRefused) {
  const auto compiles = [](const nbc_words& words, bool is_right) {
    nbc_state state;
    nbc_program program;
    EXPECT_EQ(nbc_read_words(&words, NBC_NV20, &state), is_right);
    return nbc_compile(&state, nbc_find_profile("nv2a"), &program);
  };
  nbc_words words{};
  words.enable = 1;
  EXPECT_TRUE(compiles(words, true));
  for (const std::uint32_t count : {0U, 9U, 15U}) {
    words.enable = count;
    EXPECT_FALSE(compiles(words, false)) << count;
  }
  words.enable = 1;
  for (std::uint32_t nbc_words::*const word : {&nbc_words::final0, &nbc_words::final1}) {
    words.*word = 0x06000000;  // no register
    EXPECT_FALSE(compiles(words, false));
    words.*word = 0;
  }
  words.in_rgb[0] = 0x00070000;
  EXPECT_FALSE(compiles(words, false));
  words.in_rgb[0] = 0;
  words.out_alpha[0] = 0x00000E00;  // an output cannot be the colour sum
  EXPECT_FALSE(compiles(words, false));
}

}  // namespace
}  // namespace ninebit::test
