#include "combiner_tests/study/emulator_model.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <map>
#include <string>

#include "ninebit/numerics/fixed9.h"

namespace ninebit::test {
namespace {

constexpr std::size_t kConst0 = 1, kConst1 = 2, kEmulatedSecondary = 5, kTex0 = 8, kTex1 = 9, kEmulatedSpare0 = 12,
                      kEmulatedSpare1 = 13, kColorSum = 14, kProduct = 15;
constexpr std::size_t kPrimary = 4;

// T is float for fractions of 1, double for codes.
template <class T>
class Emulator {
 public:
  Emulator(const VectorPack& pack, const std::set<EmulatorFault>& faults)
      : pack_(pack), one_(faults.contains(EmulatorFault::floats) ? T{1} : T{255}) {
    for (const EmulatorFault fault : faults) faults_[static_cast<std::size_t>(fault)] = true;
  }

  std::vector<std::vector<Bytes4>> run() {
    std::map<std::string, std::size_t> places;
    for (std::size_t i = 0; i < pack_.word_names.size(); ++i) places[pack_.word_names[i]] = i;
    std::vector<std::vector<Bytes4>> colors;
    for (const VectorProgram& program : pack_.programs) {
      words_ = words_by_use([&](const std::string& name) { return program.words[places.at(name)]; });
      auto& of_program = colors.emplace_back();
      for (std::size_t i = 0; i < pack_.fragments; ++i) {
        of_program.push_back(fragment(pack_.inputs[program.first_input + i]));
      }
    }
    return colors;
  }

 private:
  using Color = std::array<T, 4>;

  struct StageWords {
    std::uint32_t in_rgb, out_rgb, in_alpha, out_alpha, constant0, constant1;
  };
  struct Words {
    std::uint32_t enable, final0, final1, color0, color1;
    std::array<StageWords, 8> stages;
  };

  template <class WordCalled>
  static Words words_by_use(const WordCalled& word) {
    Words words{word("RC_ENABLE"), word("RC_FINAL0"), word("RC_FINAL1"), word("RC_COLOR0"), word("RC_COLOR1"), {}};
    for (std::size_t s = 0; s < words.stages.size(); ++s) {
      const std::string at = "[" + std::to_string(s) + "]";
      words.stages[s] = {word("RC_IN_RGB" + at),    word("RC_OUT_RGB" + at),         word("RC_IN_ALPHA" + at),
                         word("RC_OUT_ALPHA" + at), word("RC_CONSTANT_COLOR0" + at), word("RC_CONSTANT_COLOR1" + at)};
    }
    return words;
  }

  bool has(EmulatorFault fault) const { return faults_[static_cast<std::size_t>(fault)]; }
  bool rounds() const { return !has(EmulatorFault::floats); }
  static T nearest(T x) { return std::floor(x + T{0.5}); }
  T half() const { return rounds() ? T{128} : T{0.5}; }
  T from_byte(std::uint32_t byte) const { return rounds() ? static_cast<T>(byte) : static_cast<T>(byte) / T{255}; }

  Color constant(std::uint32_t argb) const {
    Color color{from_byte(argb >> 16 & 255), from_byte(argb >> 8 & 255), from_byte(argb & 255), from_byte(argb >> 24)};
    if (has(EmulatorFault::constants_abgr)) std::swap(color[0], color[2]);
    if (has(EmulatorFault::constant_alpha_one)) color[3] = one_;
    return color;
  }

  T input(std::uint32_t byte, std::size_t component, const std::array<Color, 16>& from) const {
    const T v = from[byte & 15][(byte >> 4 & 1) != 0 ? 3 : component];
    const std::uint32_t mapping = byte >> 5 & 7;
    const T positive = v < 0 && !(has(EmulatorFault::mappings_keep_sign) && mapping != 0) ? T{0} : v;
    switch (mapping) {
      case 0:
        // The colour sum and E times F are not registers.
        return has(EmulatorFault::clamped_when_read) && (byte & 15) < kColorSum ? std::min(positive, one_) : positive;
      case 1:
        return one_ - (positive > one_ && !has(EmulatorFault::invert_above_one) ? one_ : positive);
      case 2:
        return 2 * positive - one_;
      case 3:
        return one_ - 2 * positive;
      case 4:
        return positive - half();
      case 5:
        return half() - positive;
      case 6:
        return v;
      default:
        return -v;
    }
  }

  T stored(T wide, std::uint32_t out, std::size_t k) const {
    constexpr std::array kScales{T{1}, T{2}, T{4}, T{0.5}};
    const bool is_sum = k == 2 && (out >> 14 & 1) == 0;
    if ((out >> 15 & 1) != 0 && !has(EmulatorFault::no_bias)) {
      wide -= half() * one_ * (is_sum && has(EmulatorFault::bias_of_products) ? T{2} : T{1});
    }
    if (!has(EmulatorFault::no_scale)) wide *= kScales[out >> 16 & 3];
    const T value = rounds() ? nearest(wide / one_) : wide / one_;
    if (has(EmulatorFault::no_output_clamp) || has(EmulatorFault::clamped_when_read) ||
        (k == 2 && has(EmulatorFault::third_unclamped)))
      return value;
    return std::clamp(value, rounds() ? T{-255} : T{-1}, one_);
  }

  // The outputs of the channels [first, end): three colours, of which these components count.
  std::array<Color, 3> portion(std::uint32_t in, std::uint32_t out, std::size_t first, std::size_t end) {
    std::array<Color, 3> wide{}, value{};
    const std::array<Color, 16> before = registers_;
    const bool is_alpha = first == 3;
    const std::size_t blue = has(EmulatorFault::alpha_reads_red) ? 0 : has(EmulatorFault::alpha_reads_alpha) ? 3 : 2;
    for (std::size_t k = 0; k < 2; ++k) {
      const std::uint32_t x = k == 0 ? in >> 24 : in >> 8, y = k == 0 ? in >> 16 : in;
      for (std::size_t c = first; c < end; ++c) {
        const std::size_t component = is_alpha ? blue : c;
        wide[k][c] = input(x, component, registers_) * input(y, component, registers_);
      }
      products_ = k == 0 ? wide : std::array<Color, 3>{products_[0], wide[1], {}};
      if ((out >> (13 - k) & 1) != 0) wide[k][0] = wide[k][1] = wide[k][2] = wide[k][0] + wide[k][1] + wide[k][2];
      for (std::size_t c = first; c < end; ++c) value[k][c] = stored(wide[k][c], out, k);
      if (k == 0 && has(EmulatorFault::cd_reads_ab) && (out >> 4 & 15) != 0) {
        for (std::size_t c = first; c < end; ++c) registers_[out >> 4 & 15][c] = value[0][c];
      }
    }
    registers_ = before;
    const bool has_dot = (out >> 12 & 3) != 0;
    const T alpha = registers_[kEmulatedSpare0][3];
    const bool by_high_bit = (words_.enable >> 8 & 1) != 0 || has(EmulatorFault::mux_by_threshold);
    const bool takes_cd = by_high_bit
                              ? alpha >= half()
                              : alpha > 0 && static_cast<long>(nearest(rounds() ? alpha : alpha * T{255})) % 2 == 1;
    for (std::size_t c = first; c < end; ++c) {
      const T ab = has_dot && has(EmulatorFault::third_of_products) ? products_[0][c] : wide[0][c];
      const T cd = has_dot && has(EmulatorFault::third_of_products) ? products_[1][c] : wide[1][c];
      const bool muxes = (out >> 14 & 1) != 0 && !has(EmulatorFault::no_mux);
      wide[2][c] = muxes ? (takes_cd != has(EmulatorFault::mux_swapped) ? cd : ab) : ab + cd;
      value[2][c] = stored(wide[2][c], out, 2);
    }
    return value;
  }

  void write(std::uint32_t out, const std::array<Color, 3>& value, std::size_t first, std::size_t end) {
    std::array<std::uint32_t, 3> to{out >> 4 & 15, out & 15, out >> 8 & 15};
    if ((out >> 12 & 3) != 0 && has(EmulatorFault::no_third_beside_dot)) to[2] = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t c = first; to[k] != 0 && c < end; ++c) registers_[to[k]][c] = value[k][c];
    }
    if (first == 3 || has(EmulatorFault::no_blue_to_alpha)) return;
    if ((out >> 19 & 1) != 0 && to[0] != 0) registers_[to[0]][3] = value[0][2];
    if ((out >> 18 & 1) != 0 && to[1] != 0) registers_[to[1]][3] = value[1][2];
  }

  void stage(std::size_t s) {
    const auto& [in_rgb, out_rgb, in_alpha, out_alpha, constant0, constant1] = words_.stages[s];
    if (in_rgb == 0 && in_alpha == 0 && has(EmulatorFault::zero_stage_skipped)) return;
    const bool own = has(EmulatorFault::own_constants);
    registers_[kConst0] = constant(own || (words_.enable >> 12 & 1) != 0 ? constant0 : words_.stages[0].constant0);
    registers_[kConst1] = constant(own || (words_.enable >> 16 & 1) != 0 ? constant1 : words_.stages[0].constant1);
    const auto rgb = portion(in_rgb, out_rgb, 0, 3);
    if (has(EmulatorFault::alpha_reads_rgb_written)) write(out_rgb, rgb, 0, 3);
    const auto alpha = portion(in_alpha, out_alpha, 3, 4);
    if (has(EmulatorFault::alpha_before_rgb_blue)) write(out_alpha, alpha, 3, 4);
    if (!has(EmulatorFault::alpha_reads_rgb_written)) write(out_rgb, rgb, 0, 3);
    if (!has(EmulatorFault::alpha_before_rgb_blue)) write(out_alpha, alpha, 3, 4);
  }

  T sum_part(T v, bool inverted) const {
    const T positive = v < 0 && (!has(EmulatorFault::sum_negative) || inverted) ? T{0} : v;
    return inverted ? one_ - positive : positive;
  }

  void special_inputs(std::uint32_t efg) {
    bool invert_spare0 = (efg >> 5 & 1) != 0, invert_secondary = (efg >> 6 & 1) != 0;
    if (has(EmulatorFault::sum_inverts_swapped)) std::swap(invert_spare0, invert_secondary);
    if (has(EmulatorFault::no_sum_inverts)) invert_spare0 = invert_secondary = false;
    for (std::size_t c = 0; c < 3; ++c) {
      const T product = input(efg >> 24, c, registers_) * input(efg >> 16, c, registers_) / one_;
      const T sum = sum_part(registers_[kEmulatedSpare0][c], invert_spare0) +
                    sum_part(registers_[kEmulatedSecondary][c], invert_secondary);
      registers_[kProduct][c] = rounds() && !has(EmulatorFault::ef_unrounded) ? nearest(product) : product;
      const bool clamps =
          ((efg >> 7 & 1) != 0 && !has(EmulatorFault::sum_never_clamped)) || has(EmulatorFault::sum_always_clamped);
      registers_[kColorSum][c] = clamps && sum > one_ ? one_ : sum;
    }
  }

  std::uint8_t byte(T v) const {
    const T code = std::clamp(v, T{0}, one_) * (T{255} / one_);
    return static_cast<std::uint8_t>(has(EmulatorFault::bytes_cut) ? std::floor(code) : nearest(code));
  }

  void start(const RegisterFile& input) {
    const std::array<Color, 16> last = registers_;
    constexpr std::array<std::size_t, 9> kOrder{
        3, kPrimary, kEmulatedSecondary, kEmulatedSpare0, kEmulatedSpare1, kTex0, kTex1, 10, 11};
    registers_ = {};
    for (std::size_t r = 0; r < kOrder.size(); ++r) {
      for (std::size_t c = 0; c < 4; ++c) {
        const int code = input[kVectorRegisters[r]][c];
        registers_[kOrder[r]][c] = rounds() ? static_cast<T>(code) : static_cast<T>(code) / T{255};
      }
    }
    if (has(EmulatorFault::spare1_alpha_tex1)) registers_[kEmulatedSpare1][3] = registers_[kTex1][3];
    if (has(EmulatorFault::registers_kept)) {
      for (std::size_t c = 0; c < 3; ++c) registers_[kEmulatedSpare0][c] = last[kEmulatedSpare0][c];
      registers_[kEmulatedSpare1] = last[kEmulatedSpare1];
    }
    if (has(EmulatorFault::spare0_alpha_kept)) registers_[kEmulatedSpare0][3] = last[kEmulatedSpare0][3];
  }

  Bytes4 fragment(const RegisterFile& input_codes) {
    start(input_codes);
    std::size_t stages = words_.enable & 15;
    if (has(EmulatorFault::eight_stages_none)) stages &= 7;
    if (has(EmulatorFault::two_stages_at_least)) stages = std::max<std::size_t>(stages, 2);
    for (std::size_t s = 0; s < stages; ++s) stage(s);
    const std::array<Color, 16> left = registers_;
    std::uint32_t abcd = words_.final0, efg = words_.final1;
    if (abcd == 0 && efg == 0 && !has(EmulatorFault::final_zero_shows_zero)) {
      abcd = kEmulatedSpare0;
      efg = (kEmulatedSpare0 | 16) << 8;
    }
    registers_[kConst0] = constant(words_.color0);
    registers_[kConst1] = constant(words_.color1);
    if (has(EmulatorFault::final_last_constants) && (words_.enable >> 12 & 1) != 0) {
      const StageWords& last = words_.stages.at(stages - 1);
      registers_[kConst0] = constant(last.constant0);
      registers_[kConst1] = constant(last.constant1);
    }
    special_inputs(efg);
    Bytes4 out{};
    for (std::size_t c = 0; c < 3; ++c) {
      const T a = input(abcd >> 24, c, registers_);
      const T mix = (a * input(abcd >> 16, c, registers_) + (one_ - a) * input(abcd >> 8, c, registers_)) / one_;
      const bool is_whole = rounds() && !has(EmulatorFault::mix_unrounded) && !has(EmulatorFault::bytes_cut);
      out[c] = byte((is_whole ? nearest(mix) : mix) + input(abcd, c, registers_));
    }
    const bool is_register = (efg >> 8 & 15) < kColorSum;
    out[3] = byte(input(efg >> 8, is_register && has(EmulatorFault::final_g_reads_red) ? 0 : 2, registers_));
    if (has(EmulatorFault::red_blue_swapped)) std::swap(out[0], out[2]);
    registers_ = left;
    return out;
  }

  const VectorPack& pack_;
  std::bitset<64> faults_{};
  T one_;
  Words words_{};
  std::array<Color, 16> registers_{};
  std::array<Color, 3> products_{};
};

}  // namespace

std::vector<std::vector<Bytes4>> emulator_colors(const VectorPack& pack, const std::set<EmulatorFault>& faults) {
  return faults.contains(EmulatorFault::floats) ? Emulator<float>(pack, faults).run()
                                                : Emulator<double>(pack, faults).run();
}

}  // namespace ninebit::test
