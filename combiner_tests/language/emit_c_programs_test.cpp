// The C of the gallery's programs: every component that depends on at most three bytes is run for all of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <random>

#include "combiner_tests/language/compiled_c.h"
#include "ninebit/combiner/batch_program.h"
#include "ninebit/combiner/validate.h"
#include "ninebit/language/c_source.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/language/rc10.h"

namespace ninebit::test {
namespace {

namespace fs = std::filesystem;

struct Input {
  Register reg;
  int component;
};

// What an emitted function takes.
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

// Compares a component of the colour in C with that of the batch evaluator.
class Component {
 public:
  Component(const Program& program, EmittedFunction function, int component)
      : batch_(program, wanted(component)),
        inputs_(inputs_of(batch_.reads())),
        function_(function),
        component_(component) {}

  [[nodiscard]] bool is_small() const { return inputs_.size() <= 3; }
  [[nodiscard]] std::uint64_t cases() const {
    return is_small() ? std::uint64_t{1} << (8 * inputs_.size()) : std::uint64_t{1} << 18U;
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
  static BatchOutputs wanted(int component) {
    BatchOutputs outputs;
    for (int c = 0; c < 4; ++c) outputs.color[static_cast<std::size_t>(c)] = c == component;
    return outputs;
  }
  // The first eight inputs have a byte each, the others take them again.
  [[nodiscard]] std::int32_t value(std::size_t lane, std::size_t input) const {
    const std::uint64_t bits = bytes_[lane] >> (8 * (input % 8));
    return static_cast<std::int32_t>((bits + 89 * (input / 8)) & 0xFFU);
  }

  bool agree_on_batch(std::size_t count) {
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      s9* const plane = (*registers_)(inputs_[i].reg, inputs_[i].component);
      for (std::size_t lane = 0; lane < count; ++lane) plane[lane] = static_cast<s9>(value(lane, i));
    }
    batch_.run(*registers_, count, *out_);
    std::array<std::array<std::int32_t, 4>, kRegisterCount> wide{};
    const auto argument = [&](Register r) -> EmittedArgument { return wide[static_cast<std::size_t>(r)].data(); };
    std::array<std::int32_t, 4> result{};
    for (std::size_t lane = 0; lane < count; ++lane) {
      for (std::size_t i = 0; i < inputs_.size(); ++i) {
        wide[static_cast<std::size_t>(inputs_[i].reg)][static_cast<std::size_t>(inputs_[i].component)] = value(lane, i);
      }
      function_(argument(Register::primary), argument(Register::secondary), argument(Register::fog),
                argument(Register::texture0), argument(Register::texture1), argument(Register::texture2),
                argument(Register::texture3), wide[static_cast<std::size_t>(Register::spare0)][kAlpha], result.data());
      const auto c = static_cast<std::size_t>(component_);
      if (result[c] != out_->plane[c][lane]) return false;
    }
    return true;
  }

  BatchProgram batch_;
  std::vector<Input> inputs_;
  EmittedFunction function_;
  int component_;
  std::array<std::uint64_t, kBatchSize> bytes_{};
  std::unique_ptr<RegisterBatch> registers_ = std::make_unique<RegisterBatch>();
  std::unique_ptr<OutputBatch> out_ = std::make_unique<OutputBatch>();
};

// The programs that a profile runs, by file.
std::vector<std::pair<std::string, Program>> programs_for(const HardwareProfile& profile) {
  std::vector<std::pair<std::string, Program>> programs;
  for (const auto& entry : fs::directory_iterator(NINEBIT_SOURCE_DIR "/scenes/effects/programs")) {
    const std::string text = read_bytes(entry.path());
    const std::string name = entry.path().filename().string();
    const SourceText source{text, name};
    const auto parsed =
        entry.path().extension() == ".gl" ? parse_gl_calls(source, profile) : parse_rc10(source, profile);
    if (!parsed) continue;
    const auto program = compile(*parsed, profile);
    if (program) programs.emplace_back(name, *program);
  }
  std::sort(programs.begin(), programs.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  return programs;
}

TEST(EmitC, TheGallerysProgramsForAllBytes) {
  int whole = 0;
  std::uint64_t cases = 0;
  for (const HardwareProfile* profile : {&profiles::geforce2, &profiles::nv2a}) {
    const auto programs = programs_for(*profile);
    std::string source;
    for (std::size_t i = 0; i < programs.size(); ++i) {
      const auto text = emit_c(programs[i].second, "program" + std::to_string(i));
      ASSERT_TRUE(text) << programs[i].first << ": " << text.error().text();
      source += *text + '\n';
    }
    const CompiledC compiled(source);
    for (std::size_t i = 0; i < programs.size(); ++i) {
      const EmittedFunction function = compiled.find("program" + std::to_string(i));
      ASSERT_NE(function, nullptr);
      for (int c = 0; c < 4; ++c) {
        Component component(programs[i].second, function, c);
        EXPECT_TRUE(component.agrees()) << programs[i].first << ", component " << c << ", " << profile->name;
        whole += component.is_small() ? 1 : 0;
        cases += component.cases();
      }
    }
  }
  RecordProperty("cases", std::to_string(cases));
  EXPECT_GT(whole, 40);
}

}  // namespace
}  // namespace ninebit::test
