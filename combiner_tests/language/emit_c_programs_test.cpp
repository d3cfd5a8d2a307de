// The C of the gallery's programs: every component that depends on at most three bytes is run for all of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>

#include "combiner_tests/language/compiled_c.h"
#include "combiner_tests/language/emit_cases.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/batch_program.h"
#include "ninebit/language/c_source.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::test {
namespace {

struct Input {
  Register reg;
  int component;
  friend bool operator==(const Input&, const Input&) = default;
};

// The arguments of an emitted function.
std::vector<Input> inputs_of(const ComponentSet& read) {
  std::vector<Input> inputs;
  for (const Register r : {Register::primary, Register::secondary, Register::fog, Register::texture0,
                           Register::texture1, Register::texture2, Register::texture3}) {
    for (int c = 0; c < 4; ++c) {
      if (read.contains(r, c)) inputs.push_back({r, c});
    }
  }
  if (read.contains(Register::spare0, kAlpha)) inputs.push_back({Register::spare0, kAlpha});
  return inputs;
}

using Components = std::array<bool, 4>;

std::vector<Input> inputs_of(const Program& program, const Components& components) {
  return inputs_of(BatchProgram(program, {.color = components}).reads());
}

// All components of which each depends on at most three bytes, as one loop over 2^24 cases runs them: with a byte of
// the case's number for each input, so that no two inputs of a component have the same. Without those that do not fit.
struct Together {
  Components components{};
  std::vector<std::pair<Input, unsigned>> bytes;

  void add(int component, const std::vector<Input>& inputs) {
    if (inputs.size() > 3) return;
    std::vector<std::pair<Input, unsigned>> longer = bytes;
    std::array<bool, 3> taken{};
    for (const Input& input : inputs) {
      for (const auto& [other, byte] : bytes) {
        if (!(other == input)) continue;
        if (taken[byte]) return;
        taken[byte] = true;
      }
    }
    for (const Input& input : inputs) {
      const auto same = [&](const auto& other) { return other.first == input; };
      if (std::any_of(bytes.begin(), bytes.end(), same)) continue;
      const auto byte = static_cast<unsigned>(std::find(taken.begin(), taken.end(), false) - taken.begin());
      taken[byte] = true;
      longer.emplace_back(input, byte);
    }
    bytes = longer;
    components[static_cast<std::size_t>(component)] = true;
  }
  [[nodiscard]] bool any() const { return std::find(components.begin(), components.end(), true) != components.end(); }
};

// Compares components of the colour in C with those of the batch evaluator.
class Comparison {
 public:
  // A byte of the case for each input.
  Comparison(const Program& program, EmittedFunction function, const Together& together)
      : batch_(program, {.color = together.components}), function_(function), components_(together.components) {
    for (const auto& [input, byte] : together.bytes) {
      inputs_.push_back(input);
      byte_.push_back(byte);
      bytes_of_case_ = std::max(bytes_of_case_, byte + 1);
    }
  }
  // One component. The first eight inputs have a byte each, the others take them again.
  Comparison(const Program& program, EmittedFunction function, int component)
      : batch_(program, {.color = alone(component)}),
        inputs_(inputs_of(batch_.reads())),
        function_(function),
        components_(alone(component)),
        bytes_of_case_(static_cast<unsigned>(inputs_.size())) {
    for (unsigned i = 0; i < inputs_.size(); ++i) byte_.push_back(i);
  }

  [[nodiscard]] bool is_small() const { return bytes_of_case_ <= 3; }
  [[nodiscard]] std::uint64_t cases() const {
    return is_small() ? std::uint64_t{1} << (8 * bytes_of_case_) : std::uint64_t{1} << 18U;
  }

  [[nodiscard]] bool agrees() {
    std::mt19937_64 random(7);
    for (std::uint64_t first = 0; first < cases(); first += kBatchSize) {
      const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(kBatchSize, cases() - first));
      for (std::size_t lane = 0; lane < count; ++lane) bytes_[lane] = is_small() ? first + lane : random();
      if (!agree_on_batch(count)) return false;
    }
    return true;
  }

 private:
  static Components alone(int component) {
    Components components{};
    components[static_cast<std::size_t>(component)] = true;
    return components;
  }
  [[nodiscard]] std::int32_t value(std::size_t lane, std::size_t input) const {
    const std::uint64_t bits = bytes_[lane] >> (8 * (byte_[input] % 8));
    return static_cast<std::int32_t>((bits + 89 * (byte_[input] / 8)) & 0xFFU);
  }

  bool agree_on_batch(std::size_t count) {
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      s9* const plane = (*registers_)(inputs_[i].reg, inputs_[i].component);
      for (std::size_t lane = 0; lane < count; ++lane) plane[lane] = static_cast<s9>(value(lane, i));
    }
    batch_.run(*registers_, count, *out_);
    std::array<std::array<std::int32_t, 4>, kRegisterCount> wide{};
    std::vector<std::pair<const s9*, std::int32_t*>> inputs;  // from where an input is taken, and to where
    for (const Input& input : inputs_) {
      inputs.emplace_back((*registers_)(input.reg, input.component),
                          &wide[static_cast<std::size_t>(input.reg)][static_cast<std::size_t>(input.component)]);
    }
    const auto argument = [&](Register r) -> EmittedArgument { return wide[static_cast<std::size_t>(r)].data(); };
    std::array<std::int32_t, 4> result{};
    for (std::size_t lane = 0; lane < count; ++lane) {
      for (const auto& [from, to] : inputs) *to = from[lane];
      function_(argument(Register::primary), argument(Register::secondary), argument(Register::fog),
                argument(Register::texture0), argument(Register::texture1), argument(Register::texture2),
                argument(Register::texture3), wide[static_cast<std::size_t>(Register::spare0)][kAlpha], result.data());
      for (std::size_t c = 0; c < 4; ++c) {
        if (components_[c] && result[c] != out_->plane[c][lane]) return false;
      }
    }
    return true;
  }

  BatchProgram batch_;
  std::vector<Input> inputs_;
  std::vector<unsigned> byte_;  // of the case's number, for each input
  EmittedFunction function_;
  Components components_;
  unsigned bytes_of_case_ = 0;
  std::array<std::uint64_t, kBatchSize> bytes_{};
  std::unique_ptr<RegisterBatch> registers_ = std::make_unique<RegisterBatch>();
  std::unique_ptr<OutputBatch> out_ = std::make_unique<OutputBatch>();
};

// The gallery's programs, as two profiles run them; those that are the same for both once.
std::vector<std::pair<std::string, Program>> gallery() {
  std::vector<std::pair<std::string, Program>> programs;
  for (const HardwareProfile* const profile : {&profiles::geforce2, &profiles::nv2a}) {
    for (const auto& one : gallery_programs(*profile)) {
      const auto same = [&](const auto& other) { return other.second == one.second; };
      if (std::any_of(programs.begin(), programs.end(), same)) continue;
      programs.emplace_back(one.first + ", " + std::string(profile->name), one.second);
    }
  }
  return programs;
}

TEST(EmitC, TheGallerysProgramsForAllBytes) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  int whole = 0;
  std::uint64_t cases = 0;
  const auto programs = gallery();
  std::string source;
  for (std::size_t i = 0; i < programs.size(); ++i) {
    const auto text = emit_c(programs[i].second, "program" + std::to_string(i));
    ASSERT_TRUE(text) << programs[i].first << ": " << text.error().text();
    source += *text + '\n';
  }
  const CompiledC compiled(source);
  for (std::size_t i = 0; i < programs.size(); ++i) {
    const auto& [name, program] = programs[i];
    const EmittedFunction function = compiled.find("program" + std::to_string(i));
    ASSERT_NE(function, nullptr);
    Together together;
    for (int c = 0; c < 4; ++c) {
      Components one{};
      one[static_cast<std::size_t>(c)] = true;
      together.add(c, inputs_of(program, one));
    }
    if (together.any()) {
      Comparison all(program, function, together);
      EXPECT_TRUE(all.agrees()) << name;
      const auto components = std::count(together.components.begin(), together.components.end(), true);
      whole += static_cast<int>(components);
      cases += static_cast<std::uint64_t>(components) * all.cases();
    }
    for (int c = 0; c < 4; ++c) {
      if (together.components[static_cast<std::size_t>(c)]) continue;
      Comparison component(program, function, c);
      EXPECT_TRUE(component.agrees()) << name << ", component " << c;
      whole += component.is_small() ? 1 : 0;
      cases += component.cases();
    }
  }
  RecordProperty("cases", std::to_string(cases));
  EXPECT_GT(whole, 40);
}

}  // namespace
}  // namespace ninebit::test
