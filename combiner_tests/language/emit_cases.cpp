#include "combiner_tests/language/emit_cases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/language/index_comparison.h"
#include "combiner_tests/support/temp_folder.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/language/rc10.h"

namespace ninebit::test {
namespace {

void add_case(std::vector<EmitCase>& cases, std::string name, const HardwareProfile& profile,
              const CombinerState& state) {
  const Result<Program> program = compile(state, profile);
  if (!program) {
    ADD_FAILURE() << name << ": " << program.error().text();
    return;
  }
  cases.push_back({std::move(name), profile, *program});
}

// spare0 = m(primary) · texture0; then spare1 = -spare0, so that RGB shows what is positive, alpha what is negative.
CombinerState row(InputMapping mapping, Scale scale, Bias bias, bool dot) {
  CombinerState state = silent_state(2);
  const CombinerInput zero = rgb_of(Register::zero);
  state.general[0].rgb = {
      rgb_of(Register::primary, mapping),
      rgb_of(Register::texture0, InputMapping::signed_identity),
      zero,
      zero,
      {.ab = Register::spare0, .sum = Register::discard, .scale = scale, .bias = bias, .ab_dot_product = dot}};
  state.general[1].rgb = {rgb_of(Register::spare0, InputMapping::signed_negate),
                          kOne,
                          zero,
                          zero,
                          {.ab = Register::spare1, .sum = Register::discard}};
  state.final_combiner.d = rgb_of(Register::spare0);
  state.final_combiner.g = {Register::spare1, InputMapping::unsigned_identity, ComponentUsage::blue};
  return state;
}

}  // namespace

std::vector<EmitCase> known_cases() {
  std::vector<EmitCase> cases;
  for (const HardwareProfile& p : integer_profiles()) {
    add_case(cases, "index comparison, " + std::string(p.name), p, index_comparison());
    add_case(cases, "default state, " + std::string(p.name), p, CombinerState{});
  }
  return cases;
}

std::vector<EmitCase> row_cases() {
  std::vector<EmitCase> cases;
  constexpr std::array<std::pair<Scale, Bias>, 6> kPairs{{{Scale::none, Bias::none},
                                                          {Scale::by_two, Bias::none},
                                                          {Scale::by_four, Bias::none},
                                                          {Scale::by_one_half, Bias::none},
                                                          {Scale::none, Bias::by_negative_one_half},
                                                          {Scale::by_two, Bias::by_negative_one_half}}};
  for (const HardwareProfile& p : integer_profiles()) {
    for (const InputMapping mapping : kInputMappings) {
      for (const auto& [scale, bias] : kPairs) {
        for (const bool dot : {false, true}) {
          std::string name(name_of(mapping));
          name.append(", ").append(name_of(scale)).append(", ").append(name_of(bias)).append(dot ? ", dot, " : ", ");
          add_case(cases, name + std::string(p.name), p, row(mapping, scale, bias, dot));
        }
      }
    }
  }
  return cases;
}

std::vector<EmitCase> random_cases(std::uint64_t seed, int count) {
  std::vector<EmitCase> cases;
  const std::vector<HardwareProfile> shipped = integer_profiles();
  for (int i = 0; i < count; ++i) {
    Random random(seed, static_cast<std::uint64_t>(i));
    HardwareProfile profile = shipped[static_cast<std::size_t>(i) % shipped.size()];
    if (i % 3 == 2) profile = random_profile(random);
    add_case(cases, "random " + std::to_string(i) + ", " + std::string(profile.name), profile,
             random_state(random, profile));
  }
  return cases;
}

std::vector<std::pair<std::string, Program>> gallery_programs(const HardwareProfile& profile) {
  std::vector<std::pair<std::string, Program>> programs;
  for (const auto& entry : std::filesystem::directory_iterator(NINEBIT_SOURCE_DIR "/scenes/effects/programs")) {
    const std::string text = read_bytes(entry.path()), name = entry.path().filename().string();
    const bool is_gl = entry.path().extension() == ".gl";
    const auto state = is_gl ? parse_gl_calls({text, name}, profile) : parse_rc10({text, name}, profile);
    if (state) programs.emplace_back(name, normalize(*state, profile));
  }
  std::sort(programs.begin(), programs.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  return programs;
}

std::vector<RegisterFile> emit_inputs(const HardwareProfile& profile, std::uint64_t seed, std::size_t count) {
  std::vector<RegisterFile> inputs(count);
  Random random(seed, 0x696E70757473U);
  for (std::size_t i = 0; i < count; ++i) {
    inputs[i] = random_registers(random, profile);
    const int extreme = i == 0 ? profile.lowest : profile.one;
    for (Rgba9& value : inputs[i].value) {
      if (i < 2) value.fill(static_cast<s9>(extreme));
    }
    for (int c = 0; c < 3; ++c) inputs[i][Register::spare0][static_cast<std::size_t>(c)] = 0;
    inputs[i][Register::spare1] = {};
  }
  return inputs;
}

void Outputs::expect_distinct(std::size_t least_colors) {
  std::sort(distinct_.begin(), distinct_.end());
  distinct_.erase(std::unique(distinct_.begin(), distinct_.end()), distinct_.end());
  EXPECT_GE(distinct_.size(), least_colors) << "too few distinct colours";
  ::testing::Test::RecordProperty("fragments", static_cast<int>(fragments_));
  ::testing::Test::RecordProperty("distinct_colors", static_cast<int>(distinct_.size()));
}

void Outputs::expect_meaning(std::size_t least_fragments) {
  EXPECT_GE(fragments_, least_fragments);
  EXPECT_LT(black_ * 2, fragments_) << "more than half of all colours are black";
  expect_distinct(fragments_ / 6);
}

std::string mismatch(const EmitCase& emitted, const RegisterFile& input, const Rgba9& expected, const Rgba9& actual) {
  std::ostringstream out;
  const auto print = [&](const Rgba9& v) {
    out << '(' << v[0] << ", " << v[1] << ", " << v[2] << ", " << v[3] << ")\n";
  };
  out << emitted.name << "\nexpected ";
  print(expected);
  out << "actual ";
  print(actual);
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    out << "  " << name_of(static_cast<Register>(r)) << ' ';
    print(input.value[r]);
  }
  return out.str();
}

}  // namespace ninebit::test
