// Reads the part !!TS1.0 of a text: the texture-shader stages, one line each.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>
#include <vector>

#include "ninebit/texture_shader/validate_stages.h"
#include "src/language/rc10/rc10_parser.h"
#include "src/system/nearest_name.h"

namespace ninebit::detail {
namespace {

using enum TextureOperation;

constexpr std::array kChains{
    Ts10Chain{"dot_product_2d", {dot_product, dot_product_2d}, 2, false},
    Ts10Chain{"dot_product_rectangle", {dot_product, dot_product_rectangle}, 2, false},
    Ts10Chain{"dot_product_depth_replace", {dot_product, dot_product_depth_replace}, 2, false},
    Ts10Chain{"dot_product_3d", {dot_product, dot_product, dot_product_3d}, 3, false},
    Ts10Chain{"dot_product_cube_map", {dot_product, dot_product, dot_product_cube_map}, 3, false},
    Ts10Chain{
        "dot_product_reflect_cube_map_eye_from_qs", {dot_product, dot_product, dot_product_reflect_cube_map}, 3, false},
    Ts10Chain{"dot_product_reflect_cube_map_const_eye",
              {dot_product, dot_product, dot_product_const_eye_reflect_cube_map},
              3,
              true},
    Ts10Chain{"dot_product_cube_map_and_reflect_cube_map_eye_from_qs",
              {dot_product, dot_product_diffuse_cube_map, dot_product_reflect_cube_map},
              3,
              false},
    Ts10Chain{"dot_product_cube_map_and_reflect_cube_map_const_eye",
              {dot_product, dot_product_diffuse_cube_map, dot_product_const_eye_reflect_cube_map},
              3,
              true},
};

// A line's name.
struct Line {
  TextureOperation operation;
  const Ts10Chain* chain = nullptr;  // nullptr: the line stands alone
  int number = 0;                    // of the chain's lines, from 0
};

std::string chain_line(const Ts10Chain& chain, int number) {
  return std::string(chain.name) + '_' + std::to_string(number + 1) + "of" + std::to_string(chain.lines);
}

std::vector<std::pair<std::string, Line>> all_lines() {
  std::vector<std::pair<std::string, Line>> lines;
  for (const TextureOperationInfo& info : texture_operations()) {
    if (info.dots_before == 0 && !info.ts10.empty()) lines.emplace_back(info.ts10, Line{info.operation});
  }
  for (const Ts10Chain& chain : kChains) {
    for (int i = 0; i < chain.lines; ++i) {
      lines.emplace_back(chain_line(chain, i), Line{chain.operation[static_cast<std::size_t>(i)], &chain, i});
    }
  }
  return lines;
}

class Ts10Reader {
 public:
  Ts10Reader(std::string_view text, const HardwareProfile& profile, SourceFaults& faults)
      : in_(text, profile, faults), lines_(all_lines()) {}

  TextureShaderState read(std::size_t header) {
    state_.enabled = true;
    const std::size_t before = in_.faults.count();
    while (in_.lexer.peek().kind != Rc10Token::Kind::end && !in_.faults.full()) {
      if (line()) continue;
      in_.skip_statement();
      if (in_.lexer.peek().is('}')) in_.lexer.take();
    }
    end_chain();
    if (in_.faults.count() > before) return state_;
    for (const TextureShaderDiagnostic& found : validate(state_, in_.profile)) {
      const std::size_t at = found.stage ? at_[static_cast<std::size_t>(*found.stage)] : header;
      in_.faults.add(at, found.message, found.gl_error);
    }
    return state_;
  }

 private:
  bool line() {
    const Rc10Token name = in_.lexer.peek();
    if (name.kind == Rc10Token::Kind::word && name.text == "texture_cubemap") {
      in_.faults.add(name.offset, "'texture_cubemap' is not a line of !!TS1.0; did you mean 'texture_cube_map'?");
      return false;
    }
    const auto found =
        std::find_if(lines_.begin(), lines_.end(), [&](const auto& one) { return one.first == name.text; });
    if (name.kind != Rc10Token::Kind::word || found == lines_.end()) {
      std::vector<std::string> names;
      for (const auto& one : lines_) names.push_back(one.first);
      in_.faults.add(name.offset, (name.kind == Rc10Token::Kind::end ? "the text ends" : quoted(name.text)) +
                                      " is not a line of !!TS1.0; expected texture_2d, nop, …" +
                                      did_you_mean(name.text, names));
      return false;
    }
    in_.lexer.take();
    if (count_ == kTextureStages) {
      in_.faults.add(name.offset, "too many lines; there are 4 texture-shader stages");
      return false;
    }
    const std::size_t place = static_cast<std::size_t>(count_++);
    at_[place] = name.offset;
    state_.stage[place].operation = found->second.operation;
    begin_line(found->second, name);
    return in_.expect('(') && arguments(found->second, state_.stage[place]) && in_.expect(')') &&
           in_.end_of_statement();
  }

  // Checks that the lines of a chain follow each other.
  void begin_line(const Line& line, const Rc10Token& name) {
    const bool goes_on = line.chain != nullptr && line.number > 0;
    if (goes_on && (chain_ != line.chain || next_ != line.number)) {
      in_.faults.add(name.offset, quoted(name.text) + " must stand behind " + chain_line(*line.chain, line.number - 1));
    } else if (!goes_on) {
      end_chain();
    }
    if (!goes_on || chain_ != line.chain || next_ != line.number) first_ = count_ - 1;
    const bool has_more = line.chain != nullptr && line.number + 1 < line.chain->lines;
    chain_ = has_more ? line.chain : nullptr;
    chain_at_ = name.offset;
    next_ = line.number + 1;
  }

  // nvparse accepts a chain that stops.
  void end_chain() {
    if (chain_ != nullptr) in_.faults.add(chain_at_, "expected " + chain_line(*chain_, next_) + " behind this line");
    chain_ = nullptr;
  }

  bool arguments(const Line& line, TextureStage& stage) {
    const TextureOperationInfo& info = info_of(stage.operation);
    if (stage.operation == cull_fragment) return conditions(stage);
    if (info.input == StageInput::none) return true;
    if (!texture(stage, info.input == StageInput::normal)) return false;
    if (info.input == StageInput::offset || info.input == StageInput::luminance) {
      if (!numbers(stage.matrix)) return false;
    }
    if (info.input == StageInput::luminance) {
      std::array<float, 2> scale_bias{};
      if (!numbers(scale_bias)) return false;
      stage.scale = scale_bias[0];
      stage.bias = scale_bias[1];
    }
    if (line.chain == nullptr || !line.chain->has_eye) return true;
    // The eye stands on the first line, and is read by the last stage.
    if (line.number == 0) return numbers(eye_);
    if (line.number + 1 == line.chain->lines) stage.eye = eye_;
    return true;
  }

  bool conditions(TextureStage& stage) {
    for (std::size_t i = 0; i < stage.cull.size(); ++i) {
      if (i > 0 && !in_.expect(',')) return false;
      const Rc10Token word = in_.lexer.peek();
      if (word.is("LESS_THAN_ZERO")) {
        stage.cull[i] = CullMode::kills_not_negative;
      } else if (!word.is("GEQUAL_TO_ZERO")) {
        return in_.expected("GEQUAL_TO_ZERO or LESS_THAN_ZERO");
      }
      in_.lexer.take();
    }
    return true;
  }

  // "tex0" or, for a dot product, "expand(tex0)".
  bool texture(TextureStage& stage, bool may_expand) {
    const bool expands = may_expand && in_.lexer.peek().is("expand");
    if (expands) {
      in_.lexer.take();
      if (!in_.expect('(')) return false;
      stage.mapping = DotMapping::minus1_to_1_d3d;
    }
    const Rc10Token name = in_.lexer.peek();
    constexpr std::string_view kName = "tex";
    const bool is_texture = name.kind == Rc10Token::Kind::word && name.text.size() == kName.size() + 1 &&
                            name.text.starts_with(kName) && name.text.back() >= '0' && name.text.back() <= '3';
    if (!is_texture) return in_.expected("tex0, tex1 or tex2");
    in_.lexer.take();
    stage.previous = name.text.back() - '0';
    check_reference(name, stage.previous);
    return !expands || in_.expect(')');
  }

  void check_reference(const Rc10Token& name, int previous) {
    const auto is_silent = [](const TextureStage& one) {
      return info_of(one.operation).target == StageTarget::none && one.operation != pass_through &&
             one.operation != dot_product_depth_replace;
    };
    if (previous >= first_) {
      in_.faults.add(name.offset,
                     quoted(name.text) + " is not a stage before this line" + (first_ + 1 < count_ ? "'s chain" : ""),
                     GlError::invalid_operation);
    } else if (is_silent(state_.stage[static_cast<std::size_t>(previous)])) {
      in_.faults.add(name.offset,
                     quoted(name.text) + " has no texel: its stage is " +
                         std::string(info_of(state_.stage[static_cast<std::size_t>(previous)].operation).name));
    }
  }

  // ", 1.0, 0.0" for each number.
  template <std::size_t N>
  bool numbers(std::array<float, N>& into) {
    for (float& one : into) {
      if (!in_.expect(',')) return false;
      const Rc10Token token = in_.lexer.peek();
      if (token.kind != Rc10Token::Kind::number) return in_.expected("a number, such as 0.5");
      in_.lexer.take();
      const std::string_view digits = token.text.substr(token.text.starts_with('+') ? 1 : 0);
      double value = 0;
      const bool is_out = std::from_chars(digits.data(), digits.data() + digits.size(), value).ec != std::errc();
      // A number too close to 0 is 0; another one is infinite.
      if (is_out && digits.substr(0, digits.find('.')).find_first_not_of("-0") != std::string_view::npos) {
        value = HUGE_VAL;
      }
      one = static_cast<float>(value);
      if (!std::isfinite(one)) in_.faults.add(token.offset, quoted(token.text) + " is too large");
    }
    return true;
  }

  Rc10Reader in_;
  std::vector<std::pair<std::string, Line>> lines_;
  TextureShaderState state_;
  std::array<std::size_t, kTextureStages> at_{};
  int count_ = 0;                     // lines that were read
  int first_ = 0;                     // the stage of the first line of the chain, or of the line
  const Ts10Chain* chain_ = nullptr;  // that is not finished
  int next_ = 0;                      // the number of its next line
  std::size_t chain_at_ = 0;          // the offset of its last line
  std::array<float, 3> eye_{};        // of the chain
};

}  // namespace

std::span<const Ts10Chain> ts10_chains() {
  return kChains;
}

TextureShaderState read_ts10(const Rc10Parts& parts, const HardwareProfile& profile, SourceFaults& faults) {
  std::string text = parts.ts10;
  text.replace(*parts.ts10_at, kTs10Header.size(), kTs10Header.size(), ' ');
  return Ts10Reader(text, profile, faults).read(*parts.ts10_at);
}

}  // namespace ninebit::detail
