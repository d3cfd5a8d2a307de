#include "src/study/digits/digits.h"

#include "ninebit/combiner/initial_registers.h"

namespace ninebit {
namespace {

constexpr Digit kOneColor{{kRed, kGreen, kBlue}, 3};
constexpr std::array kChannelDigits{Digit{{kRed}, 1}};
constexpr std::array kRgbDigits{Digit{{kRed}, 1}, Digit{{kGreen}, 1}, Digit{{kBlue}, 1}};
constexpr std::array kLuminanceAlphaDigits{kOneColor, Digit{{kAlpha}, 1}};
constexpr std::array kLuminanceDigits{kOneColor};
constexpr std::array kAlphaDigits{Digit{{kAlpha}, 1}};

TextureFormat texture_format(StudyFormat format) {
  switch (format) {
    case StudyFormat::luminance_alpha:
      return TextureFormat::luminance_alpha;
    case StudyFormat::luminance:
      return TextureFormat::luminance;
    case StudyFormat::alpha:
      return TextureFormat::alpha;
    case StudyFormat::channel:
    case StudyFormat::rgb:
      break;
  }
  return TextureFormat::rgb;
}

}  // namespace

std::span<const Digit> digits_of(StudyFormat format) {
  switch (format) {
    case StudyFormat::channel:
      return kChannelDigits;
    case StudyFormat::luminance_alpha:
      return kLuminanceAlphaDigits;
    case StudyFormat::luminance:
      return kLuminanceDigits;
    case StudyFormat::alpha:
      return kAlphaDigits;
    case StudyFormat::rgb:
      break;
  }
  return kRgbDigits;
}

RegisterFile comparison_registers(const HardwareProfile& profile, StudyFormat format, const DigitBytes& own,
                                  const DigitBytes& other) {
  const std::span<const Digit> digits = digits_of(format);
  FragmentInputs inputs;
  inputs.primary = {0, 0, 0, 255};
  Texel texel{.format = texture_format(format)};
  for (std::size_t d = 0; d < digits.size(); ++d) {
    for (const int c : digits[d].components()) {
      inputs.primary[static_cast<std::size_t>(c)] = own[d];
      texel.value[static_cast<std::size_t>(c)] = other[d];
    }
  }
  inputs.texture[0] = texel;
  return initial_registers(profile, inputs);
}

ByComponent<unsigned> digits_before_first_stage(StudyFormat format) {
  ByComponent<unsigned> before{};
  const std::span<const Digit> digits = digits_of(format);
  for (std::size_t d = 0; d < digits.size(); ++d) {
    for (const int c : digits[d].components()) {
      for (const Register r : {Register::primary, Register::texture0}) {
        before[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] |= 1U << d;
      }
      // Until the first stage writes it, spare0's alpha holds texture 0's.
      if (c == kAlpha) before[static_cast<std::size_t>(Register::spare0)][kAlpha] |= 1U << d;
    }
  }
  return before;
}

}  // namespace ninebit
