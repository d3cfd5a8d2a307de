#include <algorithm>
#include <array>
#include <initializer_list>
#include <string>
#include <utility>

#include "ninebit/language/profile_json.h"
#include "src/language/json/json_reader.h"

namespace ninebit {
namespace {

using json::Reader;
using json::Type;
using json::Value;

template <class T>
using Names = std::initializer_list<std::pair<std::string_view, T>>;

// The storage of an OwnedProfile's string views.
struct ProfileText {
  std::string name, chip, source;
};

bool is_name(std::string_view text) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
           c == '.';
  };
  return !text.empty() && text.size() <= 64 && std::all_of(text.begin(), text.end(), plain);
}

class ProfileReader {
 public:
  ProfileReader(const SourceText& source, TextFaults& faults) : read_(source.text, faults), faults_(faults) {
    text_->source = source.file.empty() ? "a custom profile" : std::string(source.file);
  }

  OwnedProfile read(const Value& root) {
    if (!read_.object(root, {"ninebit",
                             "version",
                             "base",
                             "name",
                             "chip",
                             "arithmetic",
                             "one",
                             "lowest",
                             "lowest_output",
                             "half",
                             "expand_offset",
                             "byte_shift",
                             "general_narrowing",
                             "narrowing_point",
                             "final_narrowing",
                             "general_combiners",
                             "texture_units",
                             "per_stage_constants",
                             "blue_to_alpha",
                             "mux_by_lowest_bit",
                             "color_sum_inverts",
                             "spare0_alpha_without_texture0",
                             "disabled_texture_alpha",
                             "secondary_alpha",
                             "fog_alpha_without_fog",
                             "subpixel_bits",
                             "line_shape",
                             "point_shape",
                             "vertex_color_mantissa_bits",
                             "polygon_offset_slope",
                             "color_interpolation",
                             "color_weights",
                             "depth_narrowing",
                             "fog_narrowing",
                             "texture_weight_bits",
                             "texture_weight_narrowing",
                             "texture_filter_rounding",
                             "texture_bias_narrowing",
                             "dxt1_palette"})) {
      return {profile_, text_};
    }
    root_ = &root;
    read_.heading(root, "profile", false);
    read_base();
    read_names();
    read_codes();
    read_chip();
    return {profile_, text_};
  }

 private:
  const Value* find(std::string_view key) const { return Reader::find(*root_, key); }

  void read_base() {
    std::string names;
    for (const HardwareProfile& shipped : hardware_profiles()) {
      names += (names.empty() ? "" : ", ") + std::string(shipped.name);
    }
    const Value* const base = find("base");
    if (base == nullptr) return read_.fault(root_->offset, "the key \"base\" is missing; expected one of " + names);
    if (base->type != Type::string) return read_.wrong_type(*base, "a string");
    const HardwareProfile* const shipped = find_profile(base->text);
    if (shipped == nullptr) {
      return read_.fault(base->offset,
                         json::in_quotes(base->text) + " is not a shipped profile; expected one of " + names);
    }
    profile_ = *shipped;
    base_arithmetic_ = profile_.arithmetic;
  }

  void read_names() {
    text_->chip = "none: a variation of " + std::string(profile_.name);
    const Value* const name = find("name");
    if (name == nullptr) {
      read_.fault(root_->offset, "the key \"name\" is missing");
    } else if (name->type != Type::string) {
      read_.wrong_type(*name, "a string");
    } else if (!is_name(name->text)) {
      read_.fault(name->offset, "a name must be 1 to 64 letters, digits and characters - _ .");
    } else if (find_profile(name->text) != nullptr) {
      read_.fault(name->offset, json::in_quotes(name->text) + " is the name of a shipped profile");
    } else {
      text_->name = name->text;
    }
    if (const Value* const chip = find("chip")) {
      const auto control = [](char c) { return (c >= 0 && c < ' ') || c == '\x7F'; };
      if (chip->type != Type::string) {
        read_.wrong_type(*chip, "a string");
      } else if (chip->text.size() > 200 || std::any_of(chip->text.begin(), chip->text.end(), control)) {
        read_.fault(chip->offset, "chip must be one line of at most 200 bytes");
      } else {
        text_->chip = chip->text;
      }
    }
    profile_.name = text_->name;
    profile_.chip = text_->chip;
  }

  void read_codes() {
    choose("arithmetic", profile_.arithmetic,
           {{"integer", Arithmetic::integer}, {"exact", Arithmetic::exact}, {"float32", Arithmetic::float32}});
    integer("byte_shift", profile_.byte_shift, 0, 4);
    integer("one", profile_.one, 1, 255);
    const int one = 255 >> profile_.byte_shift.value;
    if (profile_.one != one) {
      const Value* const at = find("one") != nullptr ? find("one") : find("byte_shift");
      // No second fault: one of the keys may already have one. Without either key there is nothing to report.
      if (at != nullptr && faults_.empty()) {
        read_.fault(at->offset, "one is " + std::to_string(profile_.one.value) + "; with byte_shift " +
                                    std::to_string(profile_.byte_shift.value) + " it must be " + std::to_string(one) +
                                    ", so that a byte of 255 is 1.0");
      }
      return;
    }
    if (profile_.arithmetic != Arithmetic::integer) return refuse_unread(one);
    // A base with another arithmetic marks these as not read.
    if (base_arithmetic_ != Arithmetic::integer) set_integer_rules(text_->source);
    integer("lowest", profile_.lowest, -one - 1, -one);
    integer("lowest_output", profile_.lowest_output, std::max(profile_.lowest.value, -one - 1), -one);
    integer("half", profile_.half, 0, one);
    integer("expand_offset", profile_.expand_offset, one, one + 1);
    narrowing("general_narrowing", profile_.general_narrowing);
    choose("narrowing_point", profile_.narrowing_point,
           {{"after-scale", NarrowingPoint::after_scale}, {"before-scale", NarrowingPoint::before_scale}});
    narrowing("final_narrowing", profile_.final_narrowing);
  }

  void narrowing(std::string_view key, Choice<Narrowing>& to) {
    choose(key, to, {{"toward-zero", Narrowing::toward_zero}, {"nearest-halves-up", Narrowing::nearest_halves_up}});
  }

  void refuse_unread(int one) {
    for (const std::string_view key : {"lowest", "lowest_output", "half", "expand_offset", "general_narrowing",
                                       "narrowing_point", "final_narrowing"}) {
      if (const Value* const value = find(key)) {
        read_.fault(value->key_offset, std::string(key) + " is not read by this arithmetic; remove it");
      }
    }
    set_integer_rules("not read by this arithmetic");
    profile_.lowest.value = profile_.lowest_output.value = -one;
    profile_.half.value = (one + 1) / 2;
    profile_.expand_offset.value = one;
  }

  void read_chip() {
    integer("general_combiners", profile_.general_combiners, 1, 8);
    integer("texture_units", profile_.texture_units, 1, 4);
    boolean("per_stage_constants", profile_.per_stage_constants);
    boolean("blue_to_alpha", profile_.blue_to_alpha);
    boolean("mux_by_lowest_bit", profile_.mux_by_lowest_bit);
    boolean("color_sum_inverts", profile_.color_sum_inverts);
    integer("spare0_alpha_without_texture0", profile_.spare0_alpha_without_texture0, 0, 255);
    integer("disabled_texture_alpha", profile_.disabled_texture_alpha, 0, 255);
    choose("secondary_alpha", profile_.secondary_alpha,
           {{"one", SecondaryAlpha::one}, {"as-given", SecondaryAlpha::as_given}});
    integer("fog_alpha_without_fog", profile_.fog_alpha_without_fog, 0, 255);
    integer("subpixel_bits", profile_.subpixel_bits, 0, 4);
    choose("line_shape", profile_.line_shape,
           {{"diamonds", LineShape::diamonds}, {"rectangles", LineShape::rectangles}});
    choose("point_shape", profile_.point_shape,
           {{"whole-pixels", PointShape::whole_pixels}, {"squares", PointShape::squares}});
    integer("vertex_color_mantissa_bits", profile_.vertex_color_mantissa_bits, 1, 23);
    choose("polygon_offset_slope", profile_.polygon_offset_slope,
           {{"larger", OffsetSlope::larger}, {"root", OffsetSlope::root}});
    choose("color_interpolation", profile_.color_interpolation,
           {{"perspective", ColorInterpolation::perspective}, {"affine", ColorInterpolation::affine}});
    choose("color_weights", profile_.color_weights,
           {{"exact", ColorWeights::exact}, {"8-bits", ColorWeights::eight_bits}});
    narrowing("depth_narrowing", profile_.depth_narrowing);
    narrowing("fog_narrowing", profile_.fog_narrowing);
    integer("texture_weight_bits", profile_.texture_weight_bits, 1, 8);
    narrowing("texture_weight_narrowing", profile_.texture_weight_narrowing);
    choose("texture_filter_rounding", profile_.texture_filter_rounding,
           {{"once", FilterRounding::once}, {"each-blend", FilterRounding::each_blend}});
    narrowing("texture_bias_narrowing", profile_.texture_bias_narrowing);
    choose(
        "dxt1_palette", profile_.dxt1_palette,
        {{"rgb565", Dxt1Palette::rgb565}, {"rgb888", Dxt1Palette::rgb888}, {"dithered565", Dxt1Palette::dithered565}});
  }

  // Keeps the values and changes their evidence.
  void set_integer_rules(std::string_view source) {
    const auto set = [&](auto& choice) { choice = {choice.value, Evidence::assumed, source}; };
    set(profile_.lowest);
    set(profile_.lowest_output);
    set(profile_.half);
    set(profile_.expand_offset);
    set(profile_.general_narrowing);
    set(profile_.narrowing_point);
    set(profile_.final_narrowing);
  }

  template <class T>
  void replace(Choice<T>& choice, T value) {
    choice = {value, Evidence::assumed, text_->source};
  }

  void integer(std::string_view key, Choice<int>& choice, int low, int high) {
    if (const Value* const value = find(key)) {
      int number = choice;
      read_.integer(*value, low, high, number);
      replace(choice, number);
    } else if (choice < low || choice > high) {
      // Another field of this file changed the limits, and the base's value is now out of range.
      const Value* const one = find("one");
      read_.fault(one != nullptr ? one->offset : root_->offset,
                  std::string(key) + " of the base is " + std::to_string(choice.value) +
                      ", but with this value it must be " + std::to_string(low) + " to " + std::to_string(high) +
                      "; set it as well");
    }
  }

  void boolean(std::string_view key, Choice<bool>& choice) {
    if (const Value* const value = find(key)) {
      bool chosen = choice;
      read_.boolean(*value, chosen);
      replace(choice, chosen);
    }
  }

  template <class T>
  void choose(std::string_view key, Choice<T>& choice, const Names<T>& names) {
    const Value* const value = find(key);
    if (value == nullptr) return;
    if (value->type != Type::string) return read_.wrong_type(*value, "a string");
    std::string all;
    for (const auto& [name, meaning] : names) {
      if (name == value->text) return replace(choice, meaning);
      all += (all.empty() ? "" : ", ") + std::string(name);
    }
    read_.fault(value->offset,
                json::in_quotes(value->text) + " is not a valid " + std::string(key) + "; expected one of " + all);
  }

  Reader read_;
  TextFaults& faults_;
  const Value* root_ = nullptr;
  std::shared_ptr<ProfileText> text_ = std::make_shared<ProfileText>();
  HardwareProfile profile_ = profiles::geforce2;
  Arithmetic base_arithmetic_ = Arithmetic::integer;
};

}  // namespace

Parsed<OwnedProfile> parse_json_profile(const SourceText& source) {
  TextFaults faults(source.file);
  if (too_long(source.text, faults)) return faults.take();
  const auto root = json::read_tree(source.text, faults);
  if (!root) return faults.take();
  const OwnedProfile profile = ProfileReader(source, faults).read(*root);
  if (!faults.empty()) return faults.take();
  return profile;
}

}  // namespace ninebit
