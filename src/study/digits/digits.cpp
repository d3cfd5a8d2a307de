#include "src/study/digits/digits.h"

#include <bit>
#include <cstddef>
#include <utility>

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

namespace {

__extension__ typedef unsigned __int128 Wide;

// A prime for which 2^32 divides kPrime - 1: there are roots of unity for every power of two that occurs.
constexpr std::uint64_t kPrime = 0xFFFFFFFF00000001U;
constexpr std::uint64_t kGenerator = 7;

std::uint64_t sum(std::uint64_t x, std::uint64_t y) {
  return x >= kPrime - y ? x - (kPrime - y) : x + y;
}

std::uint64_t difference(std::uint64_t x, std::uint64_t y) {
  return x >= y ? x - y : x + (kPrime - y);
}

// 2^64 leaves 2^32 - 1, and 2^96 leaves -1.
std::uint64_t product(std::uint64_t x, std::uint64_t y) {
  const Wide wide = static_cast<Wide>(x) * y;
  const auto low = static_cast<std::uint64_t>(wide), high = static_cast<std::uint64_t>(wide >> 64U);
  const std::uint64_t middle = (high & 0xFFFFFFFFU) * 0xFFFFFFFFU;
  return difference(sum(low >= kPrime ? low - kPrime : low, middle), high >> 32U);
}

std::uint64_t power(std::uint64_t x, std::uint64_t exponent) {
  std::uint64_t result = 1;
  for (; exponent != 0; exponent >>= 1, x = product(x, x)) {
    if (exponent % 2 == 1) result = product(result, x);
  }
  return result;
}

// Replaces the numbers, a power of two of them, by their discrete Fourier transform with this root of unity.
void transform(std::vector<std::uint64_t>& numbers, std::uint64_t root) {
  const std::size_t size = numbers.size();
  for (std::size_t i = 1, reversed = 0; i < size; ++i) {
    std::size_t bit = size / 2;
    for (; (reversed & bit) != 0; bit /= 2) reversed ^= bit;
    reversed ^= bit;
    if (i < reversed) std::swap(numbers[i], numbers[reversed]);
  }
  std::vector<std::uint64_t> roots(size / 2, 1);
  for (std::size_t i = 1; i < roots.size(); ++i) roots[i] = product(roots[i - 1], root);
  for (std::size_t half = 1; half < size; half *= 2) {
    for (std::size_t first = 0; first < size; first += 2 * half) {
      for (std::size_t i = 0; i < half; ++i) {
        const std::uint64_t x = numbers[first + i];
        const std::uint64_t y = product(numbers[first + half + i], roots[i * (size / (2 * half))]);
        numbers[first + i] = sum(x, y);
        numbers[first + half + i] = difference(x, y);
      }
    }
  }
}

}  // namespace

WideCounts product_counts(int one) {
  WideCounts out{one * one, std::vector<std::uint64_t>(static_cast<std::size_t>(2 * one * one + 1))};
  for (int a = -one; a <= one; ++a) {
    for (int b = -one; b <= one; ++b) ++out.count[static_cast<std::size_t>(out.limit + a * b)];
  }
  return out;
}

// A convolution, as the product of the transforms.
WideCounts sum_counts(const WideCounts& first, const WideCounts& second) {
  const int limit = first.limit + second.limit;
  WideCounts out{limit, first.count};
  std::vector<std::uint64_t> other = second.count;
  const std::size_t results = static_cast<std::size_t>(2 * limit + 1), size = std::bit_ceil(results);
  const std::uint64_t root = power(kGenerator, (kPrime - 1) / size);
  for (std::vector<std::uint64_t>* numbers : {&out.count, &other}) {
    numbers->resize(size);
    transform(*numbers, root);
  }
  const std::uint64_t shrink = power(size, kPrime - 2);
  for (std::size_t i = 0; i < size; ++i) out.count[i] = product(product(out.count[i], other[i]), shrink);
  transform(out.count, power(root, kPrime - 2));
  out.count.resize(results);
  return out;
}

}  // namespace ninebit
