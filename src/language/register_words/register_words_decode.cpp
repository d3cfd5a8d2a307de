// Decodes words to a state. Checks first what the chip refuses, word by word, then what OpenGL refuses.
#include <algorithm>
#include <optional>
#include <utility>

#include "ninebit/combiner/program.h"
#include "ninebit/combiner/validate.h"
#include "src/language/register_words/register_words_layout.h"
#include "src/language/source/source_faults.h"

namespace ninebit {
namespace words {
namespace {

std::string letter(int variable) {
  return {static_cast<char>('A' + variable)};
}

class Decoder {
 public:
  Decoder(ChipClass chip, TextFaults& faults) : chip_(chip), faults_(faults) {}

  // Stores the words by their slots; an unknown or repeated name is a fault.
  void collect(std::span<const RegisterWord> given) {
    for (const RegisterWord& word : given) {
      if (other_words_.take(word, chip_, faults_)) continue;
      const FoundSlot found = find_slot(word.name, chip_);
      if (!found.slot) {
        faults_.add(word.place, found.fault);
        continue;
      }
      const RegisterWord*& at = this->at(*found.slot);
      if (at != nullptr) {
        faults_.add(word.place, canonical_name(*found.slot, chip_) + " was given before, in line " +
                                    std::to_string(at->place.line) + (at->name == word.name ? "" : " as " + at->name));
        continue;
      }
      at = &word;
    }
  }

  [[nodiscard]] std::vector<RegisterWord> take_other_words() { return std::move(other_words_.found); }

  CombinerState decode() {
    for (int i = 0; i < stages_of(chip_); ++i) {
      GeneralCombiner& stage = state_.general[static_cast<std::size_t>(i)];
      inputs({Kind::in_rgb, i}, {&stage.rgb.a, &stage.rgb.b, &stage.rgb.c, &stage.rgb.d});
      inputs({Kind::in_alpha, i}, {&stage.alpha.a, &stage.alpha.b, &stage.alpha.c, &stage.alpha.d});
      outputs({Kind::out_rgb, i}, stage.rgb.out);
      outputs({Kind::out_alpha, i}, stage.alpha.out);
    }
    FinalCombiner& f = state_.final_combiner;
    inputs({Kind::final0, 0}, {&f.a, &f.b, &f.c, &f.d});
    inputs({Kind::final1, 0}, {&f.e, &f.f, &f.g, nullptr});
    final_flags();
    if (leaves_out_final_combiner()) leave_out_final_combiner(f);
    state_.constant0 = color({Kind::color, 0});
    state_.constant1 = color({Kind::color, 1});
    for (std::size_t k = 0; k < 2; ++k) given_[kFinalConstants][k] = has_color(k, std::nullopt);
    const bool mux_by_highest_bit = chip_ == ChipClass::nv10 ? nv10_control() : nv20_control();
    mark_unset_constants(state_, given_);
    state_.mux_by_lowest_bit = !mux_by_highest_bit && uses_mux();
    return state_;
  }

  // The place of the word that a diagnostic of the state refers to.
  TextPlace place_of(const StateDiagnostic& found) {
    Slot slot = control_slot();
    if (found.stage && found.portion) {
      const bool rgb = *found.portion == PortionName::rgb;
      slot = {found.variable ? (rgb ? Kind::in_rgb : Kind::in_alpha) : (rgb ? Kind::out_rgb : Kind::out_alpha),
              *found.stage};
      if (slot.index >= stages_of(chip_)) return {};
    } else if (found.variable) {
      slot = {*found.variable <= Variable::d ? Kind::final0 : Kind::final1, 0};
    } else if (found.parameter == StateParameter::color_sum_inverts) {
      slot = {Kind::final1, 0};
    }
    const RegisterWord* const word = at(slot);
    return word == nullptr ? TextPlace{} : word->place;
  }

 private:
  const RegisterWord*& at(Slot slot) {
    return words_[static_cast<std::size_t>(slot.kind)][static_cast<std::size_t>(slot.index)];
  }

  [[nodiscard]] Slot control_slot() const {
    return chip_ == ChipClass::nv10 ? Slot{Kind::out_rgb, 1} : Slot{Kind::enable, 0};
  }

  // `gl_error` is the error that OpenGL raises for the same state; most of what a chip refuses has none.
  void fault(Slot slot, const std::string& what, GlError gl_error = GlError::no_error) {
    const RegisterWord& word = *at(slot);
    const std::string name = word.name.starts_with("PS") ? word.name : canonical_name(slot, chip_);  // the Xbox's names
    faults_.add(word.place, name + " = " + hex_text(word.value) + ": " + what, gl_error);
  }

  // Reports the bits that the chip refuses, except `but`, which have their own fault.
  void check_mask(Slot slot, std::uint32_t but = 0) {
    const std::uint32_t wrong = at(slot)->value & ~mask_of(slot, chip_) & ~but;
    if (wrong != 0) {
      fault(slot, bits_text(wrong) + " must be 0; the mask of the word is " + hex_text(mask_of(slot, chip_)));
    }
  }

  // The register of a code, if the chip has it and a word of this kind may name it.
  std::optional<Register> readable(std::uint32_t code, Kind kind) const {
    const std::optional<Register> r = register_of(code);
    if (r && is_texture(*r) && texture_unit_of(*r) >= (chip_ == ChipClass::nv10 ? 2 : 4)) return std::nullopt;
    if (r && *r >= Register::e_times_f && kind != Kind::final0) return std::nullopt;
    return r;
  }

  void inputs(Slot slot, std::array<CombinerInput*, 4> into) {
    if (at(slot) == nullptr) return;
    check_mask(slot);
    const std::uint32_t word = at(slot)->value;
    for (int i = 0; i < 4; ++i) {
      CombinerInput* const input = into[static_cast<std::size_t>(i)];
      if (input == nullptr) continue;
      const int low = 24 - 8 * i;
      const int variable = slot.kind == Kind::final1 ? 4 + i : i;
      const std::optional<Register> r = readable(bits(word, low, 4), slot.kind);
      if (!r) {
        fault(slot,
              "variable " + letter(variable) + " (bits " + std::to_string(low + 3) + ".." + std::to_string(low) +
                  ") has the register code " + hex_text(bits(word, low, 4), 1) + ", which is reserved here",
              error_of_misplaced(bits(word, low, 4), slot.kind));
        continue;
      }
      const bool scalar = slot.kind == Kind::in_alpha || variable == 6;
      input->reg = *r;
      const bool final = slot.kind == Kind::final0 || slot.kind == Kind::final1;
      read_input(word, low, scalar, final ? 1 : 3, *input);
    }
  }

  void outputs(Slot slot, PortionOutput& out) {
    if (at(slot) == nullptr) return;
    const std::uint32_t word = at(slot)->value;
    const bool rgb = slot.kind == Kind::out_rgb;
    const std::uint32_t dots = 1U << kCdDotBit | 1U << kAbDotBit;
    check_mask(slot, rgb ? 0 : dots);
    if (!rgb && (word & dots) != 0) {
      fault(slot, bits_text(word & dots) + ": an alpha portion has no dot product", GlError::invalid_value);
    }
    const std::pair<int, Register*> destinations[] = {{kAbShift, &out.ab}, {kCdShift, &out.cd}, {kSumShift, &out.sum}};
    for (const auto& [low, into] : destinations) {
      const std::uint32_t code = bits(word, low, 4);
      const std::optional<Register> r = readable(code, slot.kind);
      if (!r || (code > 0 && code < code_of(Register::primary))) {
        fault(slot,
              std::string(low == kAbShift   ? "AB"
                          : low == kCdShift ? "CD"
                                            : "the sum") +
                  " (bits " + std::to_string(low + 3) + ".." + std::to_string(low) + ") has the destination code " +
                  hex_text(code, 1) + ", which cannot be written",
              error_of_misplaced(code, slot.kind));
        continue;
      }
      *into = code == 0 ? Register::discard : *r;
    }
    read_output(word, rgb, chip_ == ChipClass::nv20, out);
    if (out.bias != Bias::none && (out.scale == Scale::by_four || out.scale == Scale::by_one_half)) {
      fault(slot,
            "bits 17..15 are " + std::to_string(bits(word, kBiasBit, 3)) +
                ", a bias with a scale by four or one half, which the chip and OpenGL refuse",
            GlError::invalid_operation);
      out.bias = Bias::none;
    }
  }

  void final_flags() {
    const Slot slot{Kind::final1, 0};
    if (at(slot) == nullptr) return;
    read_final_flags(at(slot)->value, state_);
  }

  bool leaves_out_final_combiner() {
    const auto is_zero = [](const RegisterWord* word) { return word != nullptr && word->value == 0; };
    return chip_ == ChipClass::nv20 && is_zero(at({Kind::final0, 0})) && is_zero(at({Kind::final1, 0}));
  }

  // Whether there is the word of constant `k` of a stage, or of the final combiner.
  bool has_color(std::size_t k, std::optional<int> stage) {
    if (!stage) return at({Kind::color, static_cast<int>(k)}) != nullptr;
    return at({k == 0 ? Kind::stage_color0 : Kind::stage_color1, *stage}) != nullptr;
  }

  ColorF color(Slot slot) { return at(slot) == nullptr ? ColorF{} : color_of(at(slot)->value); }

  // Reads the number of stages; returns whether muxes test the highest bit.
  bool nv10_control() {
    const Slot slot = control_slot();
    if (at(slot) == nullptr) return true;
    const std::uint32_t count = bits(at(slot)->value, kNv10CountShift, 2);
    if (count == 0 || count == 3) {
      fault(slot, "bits 29..28, the number of general combiners, are " + std::to_string(count) + "; NV10 has 1 or 2",
            GlError::invalid_value);
    } else {
      state_.num_general_combiners = static_cast<int>(count);
    }
    return bits(at(slot)->value, kNv10MuxMsbBit, 1) != 0;
  }

  bool nv20_control() {
    const Slot slot = control_slot();
    std::uint32_t word = 1U << kNv20CountShift | 1U << kNv20MuxMsbBit;
    if (at(slot) != nullptr) {
      check_mask(slot);
      word = at(slot)->value;
      const std::uint32_t count = bits(word, kNv20CountShift, 4);
      if (count == 0 || count > 8) {
        fault(slot, "bits 3..0, the number of general combiners, are " + std::to_string(count) + "; NV20 has 1 to 8",
              GlError::invalid_value);
      } else {
        state_.num_general_combiners = static_cast<int>(count);
      }
    }
    stage_constants(bits(word, kNv20Unique0Bit, 1) != 0, bits(word, kNv20Unique1Bit, 1) != 0);
    return bits(word, kNv20MuxMsbBit, 1) != 0;
  }

  // The chip's final combiner always has its own constants. OpenGL has one pair for all, or one pair per stage and one
  // for the final combiner.
  void stage_constants(bool unique0, bool unique1) {
    const ColorF shared[2] = {color({Kind::stage_color0, 0}), color({Kind::stage_color1, 0})};
    ColorF* const global[2] = {&state_.constant0, &state_.constant1};
    bool one_pair = !unique0 && !unique1;
    for (int k = 0; k < 2; ++k) {
      const auto which = static_cast<std::size_t>(k);
      const bool same = shared[k] == *global[k] && has_color(which, 0) == has_color(which, std::nullopt);
      one_pair = one_pair && (same || !final_reads(k) || !stages_read(k));
    }
    if (one_pair) {
      for (int k = 0; k < 2; ++k) {
        if (final_reads(k)) continue;
        *global[k] = shared[k];
        given_[kFinalConstants][static_cast<std::size_t>(k)] = has_color(static_cast<std::size_t>(k), 0);
      }
      return;
    }
    state_.per_stage_constants = true;
    for (int i = 0; i < stages_of(chip_); ++i) {
      GeneralCombiner& stage = state_.general[static_cast<std::size_t>(i)];
      stage.constant0 = unique0 ? color({Kind::stage_color0, i}) : shared[0];
      stage.constant1 = unique1 ? color({Kind::stage_color1, i}) : shared[1];
      given_[static_cast<std::size_t>(i)] = {has_color(0, unique0 ? i : 0), has_color(1, unique1 ? i : 0)};
    }
  }

  [[nodiscard]] bool final_reads(int constant) const {
    const Register r = constant == 0 ? Register::constant0 : Register::constant1;
    return detail::final_reads(state_.final_combiner, r);
  }

  [[nodiscard]] bool stages_read(int constant) const {
    const Register r = constant == 0 ? Register::constant0 : Register::constant1;
    for (int i = 0; i < state_.num_general_combiners; ++i) {
      const GeneralCombiner& stage = state_.general[static_cast<std::size_t>(i)];
      if (detail::reads(stage.rgb, r) || detail::reads(stage.alpha, r)) return true;
    }
    return false;
  }

  // Whether a stage in use has a mux. A word that is 0 except for the number of stages sets only that number.
  [[nodiscard]] bool uses_mux() const {
    for (int i = 0; i < state_.num_general_combiners; ++i) {
      const GeneralCombiner& stage = state_.general[static_cast<std::size_t>(i)];
      if (has_mux(stage.rgb.out) || has_mux(stage.alpha.out)) return true;
    }
    return false;
  }

  ChipClass chip_;
  TextFaults& faults_;
  std::array<std::array<const RegisterWord*, kMaxGeneralCombiners>, kKinds> words_{};
  OtherWords other_words_;
  ByConstant<bool> given_{};  // constants
  CombinerState state_{};
};

}  // namespace
}  // namespace words

Parsed<CombinerState> decode_register_words(std::span<const RegisterWord> given, std::string_view file, ChipClass chip,
                                            const HardwareProfile& profile, std::vector<RegisterWord>* other_words) {
  TextFaults faults(file);
  words::Decoder decoder(chip, faults);
  decoder.collect(given);
  const CombinerState state = decoder.decode();
  for (const StateDiagnostic& found : validate(state, profile)) {
    faults.add(decoder.place_of(found), found.message, found.gl_error);
  }
  if (!faults.empty()) return faults.take();
  if (other_words != nullptr) *other_words = decoder.take_other_words();
  return state;
}

}  // namespace ninebit
