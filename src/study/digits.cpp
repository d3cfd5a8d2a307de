#include "src/study/digits.h"

#include <bit>
#include <map>
#include <string>

#include "ninebit/combiner/evaluate_real.h"
#include "ninebit/combiner/initial_registers.h"
#include "src/study/digit_flow.h"

namespace ninebit {
namespace {

TextureFormat texture_format(StudyFormat format) {
  switch (format) {
    case StudyFormat::luminance_alpha:
      return TextureFormat::luminance_alpha;
    case StudyFormat::luminance:
      return TextureFormat::luminance;
    case StudyFormat::alpha:
      return TextureFormat::alpha;
    default:
      return TextureFormat::rgb;
  }
}

ByComponent<unsigned> digits_before(StudyFormat format) {
  ByComponent<unsigned> before{};
  const std::vector<Digit> digits = digits_of(format);
  for (std::size_t d = 0; d < digits.size(); ++d) {
    for (const int c : digits[d].components) {
      for (const Register r : {Register::primary, Register::texture0}) {
        before[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] |= 1U << d;
      }
      // Without a first stage's write, spare0's alpha holds texture 0's.
      if (c == kAlpha) before[static_cast<std::size_t>(Register::spare0)][kAlpha] |= 1U << d;
    }
  }
  return before;
}

bool mixed(unsigned digits) {
  return std::popcount(digits) > 1;
}

// What tells two pairs of a digit's values apart after the first stage.
class ClassKey {
 public:
  ClassKey(const Program& program, const ByComponent<unsigned>& after) : program_(program), after_(after) {
    read_ = read_from_stage(program, 1);
    by_products_ = program.datapath.arithmetic != Arithmetic::integer && products_decide();
    first_ = program;
    first_.num_general_combiners = 1;
  }

  [[nodiscard]] std::vector<double> of(const RegisterFile& registers, unsigned digit) const {
    std::vector<double> key;
    if (program_.datapath.arithmetic == Arithmetic::integer) {
      RegisterFile file = registers;
      evaluate_general(first_, file);
      add(file.value, digit, key);
      return key;
    }
    const RealEvaluation real =
        evaluate_real(by_products_ ? program_ : first_, registers, program_.datapath.arithmetic);
    if (!by_products_) {
      add(real.stage[0].after.value, digit, key);
      return key;
    }
    for (const RealChannel& channel : real.stage[1].rgb) key.insert(key.end(), {channel.ab.wide, channel.cd.wide});
    key.insert(key.end(), {real.stage[1].alpha.ab.wide, real.stage[1].alpha.cd.wide});
    return key;
  }

 private:
  template <class Values>
  void add(const Values& values, unsigned digit, std::vector<double>& key) const {
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      for (std::size_t c = 0; c < 4; ++c) {
        if (read_[r][c] && after_[r][c] == digit) key.push_back(static_cast<double>(values[r][c]));
      }
    }
  }

  // Whether the second stage reads what the first left in products of one digit alone, chooses nothing by it, and is the
  // last that reads it: then its products say all.
  [[nodiscard]] bool products_decide() const {
    if (program_.num_general_combiners < 2) return false;
    const ByComponent<bool> later = read_from_stage(program_, 2);
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      for (std::size_t c = 0; c < 4; ++c) {
        if (later[r][c] && after_[r][c] != 0) return false;
      }
    }
    const auto within_digits = [&](const Portion& p, int first, int channels) {
      if (p.out.mux_sum) return false;
      for (int c = 0; c < channels; ++c) {
        const auto digits = [&](const CombinerInput& in) {
          return after_[static_cast<std::size_t>(in.reg)]
                       [static_cast<std::size_t>(reference::component_of(in.usage, first + c))];
        };
        if (mixed(digits(p.a) | digits(p.b)) || mixed(digits(p.c) | digits(p.d))) return false;
      }
      return true;
    };
    const ProgramStage& stage = program_.general[1];
    return within_digits(stage.rgb, kRed, 3) && within_digits(stage.alpha, kAlpha, 1);
  }

  const Program& program_;
  const ByComponent<unsigned>& after_;
  ByComponent<bool> read_{};
  bool by_products_ = false;
  Program first_;
};

}  // namespace

std::vector<Digit> digits_of(StudyFormat format) {
  switch (format) {
    case StudyFormat::channel:
      return {{{kRed}}};
    case StudyFormat::rgb:
      return {{{kRed}}, {{kGreen}}, {{kBlue}}};
    case StudyFormat::luminance_alpha:
      return {{{kRed, kGreen, kBlue}}, {{kAlpha}}};
    case StudyFormat::luminance:
      return {{{kRed, kGreen, kBlue}}};
    case StudyFormat::alpha:
      return {{{kAlpha}}};
  }
  return {};
}

RegisterFile comparison_registers(const HardwareProfile& profile, StudyFormat format,
                                  std::span<const std::uint8_t> own, std::span<const std::uint8_t> other) {
  const std::vector<Digit> digits = digits_of(format);
  FragmentInputs inputs;
  inputs.primary = {0, 0, 0, 255};
  Texel texel{.format = texture_format(format)};
  for (std::size_t d = 0; d < digits.size(); ++d) {
    for (const int c : digits[d].components) {
      inputs.primary[static_cast<std::size_t>(c)] = own[d];
      texel.value[static_cast<std::size_t>(c)] = other[d];
    }
  }
  inputs.texture[0] = texel;
  return initial_registers(profile, inputs);
}

Result<std::vector<std::vector<DigitClass>>> digit_classes(const Program& program, const HardwareProfile& profile,
                                                           StudyFormat format, int step) {
  const std::size_t count = digits_of(format).size();
  const ByComponent<unsigned> after = digits_after_first_stage(program, digits_before(format));
  const ByComponent<bool> read = read_from_stage(program, 1);
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    for (std::size_t c = 0; c < 4; ++c) {
      if (!read[r][c] || !mixed(after[r][c])) continue;
      return Diagnostic{.message = std::string(name_of(static_cast<Register>(r))) + "." + "rgba"[c] +
                                   " depends on more than one channel of the index after the first general combiner: "
                                   "there are too many cases to count them all; expected a first stage that keeps the "
                                   "channels apart, or a format with one channel"};
    }
  }
  const ClassKey key(program, after);
  std::vector<std::vector<DigitClass>> classes(count);
  for (std::size_t d = 0; d < count; ++d) {
    std::map<std::vector<double>, std::size_t> known;
    std::array<std::uint8_t, 3> own{}, other{};
    for (int a = 0; a <= 255; a += step) {
      for (int b = 0; b <= 255; b += step) {
        own[d] = static_cast<std::uint8_t>(a);
        other[d] = static_cast<std::uint8_t>(b);
        const RegisterFile registers = comparison_registers(profile, format, own, other);
        const auto [found, added] = known.try_emplace(key.of(registers, 1U << d), classes[d].size());
        if (added) classes[d].push_back({own[d], other[d], 0, 0});
        DigitClass& of = classes[d][found->second];
        ++of.pairs;
        if (a == b) ++of.equal;
      }
    }
  }
  return classes;
}

}  // namespace ninebit
