// Prints texture-shader stages as !!TS1.0.
#include <algorithm>

#include "src/language/rc10/rc10_parser.h"
#include "src/language/source/beyond_opengl.h"
#include "src/system/digits.h"

namespace ninebit::detail {
namespace {

class Ts10Printer {
 public:
  explicit Ts10Printer(const TextureShaderState& state) : state_(only_used(state)) {}

  Result<std::string> print() {
    if (const std::string beyond = beyond_opengl(state_); !beyond.empty()) return why("OpenGL has no " + beyond);
    std::string text = "!!TS1.0\n";
    for (std::size_t i = 0; i < state_.stage.size();) {
      const TextureOperationInfo& info = info_of(state_.stage[i].operation);
      const Ts10Chain* const chain = chain_at(i);
      const std::size_t lines = chain == nullptr ? 1 : static_cast<std::size_t>(chain->lines);
      if (chain == nullptr && (info.ts10.empty() || info.dots_before > 0)) {
        return why("texture stage " + std::to_string(i) + ": " + std::string(info.name) +
                   " that is not in a chain of dot products");
      }
      for (std::size_t line = 0; line < lines; ++line) {
        const TextureStage& stage = state_.stage[i + line];
        if (!can_read(stage, i)) {
          return why("texture stage " + std::to_string(i + line) + ": the previous stage " +
                     std::to_string(stage.previous) +
                     (stage.previous >= static_cast<int>(i) ? " is in the same chain" : " has no texel"));
        }
        text += chain == nullptr
                    ? std::string(info.ts10)
                    : std::string(chain->name) + '_' + std::to_string(line + 1) + "of" + std::to_string(chain->lines);
        text += '(' + arguments(stage);
        if (chain != nullptr && chain->has_eye && line == 0) text += numbers(state_.stage[i + lines - 1].eye);
        text += ");\n";
      }
      i += lines;
    }
    return text;
  }

 private:
  static Diagnostic why(const std::string& what) { return {.message = "!!TS1.0 cannot express this: " + what}; }

  // The longest chain that begins at a stage.
  [[nodiscard]] const Ts10Chain* chain_at(std::size_t place) const {
    const Ts10Chain* found = nullptr;
    for (const Ts10Chain& chain : ts10_chains()) {
      const auto lines = static_cast<std::size_t>(chain.lines);
      if (place + lines > state_.stage.size() || (found != nullptr && found->lines >= chain.lines)) continue;
      const bool fits = std::equal(chain.operation.begin(), chain.operation.begin() + chain.lines,
                                   state_.stage.begin() + static_cast<std::ptrdiff_t>(place),
                                   [](TextureOperation a, const TextureStage& b) { return a == b.operation; });
      if (fits) found = &chain;
    }
    return found;
  }

  // Whether a line of the chain that begins at a stage may read what it names.
  [[nodiscard]] bool can_read(const TextureStage& stage, std::size_t first) const {
    if (info_of(stage.operation).input == StageInput::none) return true;
    if (stage.previous < 0 || stage.previous >= static_cast<int>(first)) return false;
    const TextureOperation previous = state_.stage[static_cast<std::size_t>(stage.previous)].operation;
    return info_of(previous).target != StageTarget::none || previous == TextureOperation::pass_through ||
           previous == TextureOperation::dot_product_depth_replace;
  }

  static std::string arguments(const TextureStage& stage) {
    const StageInput input = info_of(stage.operation).input;
    if (stage.operation == TextureOperation::cull_fragment) {
      std::string text;
      for (const CullMode mode : stage.cull) {
        text += text.empty() ? "" : ", ";
        text += mode == CullMode::kills_negative ? "GEQUAL_TO_ZERO" : "LESS_THAN_ZERO";
      }
      return text;
    }
    if (input == StageInput::none) return "";
    std::string text = "tex" + std::to_string(stage.previous);
    if (stage.mapping == DotMapping::minus1_to_1_d3d) text = "expand(" + text + ")";
    if (input == StageInput::offset || input == StageInput::luminance) text += numbers(stage.matrix);
    if (input == StageInput::luminance) text += numbers(std::array{stage.scale, stage.bias});
    return text;
  }

  // The shortest digits without exponent that read as the same numbers.
  template <std::size_t N>
  static std::string numbers(const std::array<float, N>& values) {
    std::string text;
    for (const float value : values) text += ", " + plain_digits_of(value);
    return text;
  }

  TextureShaderState state_;
};

}  // namespace

Result<std::string> print_ts10(const TextureShaderState& state) {
  return Ts10Printer(state).print();
}

}  // namespace ninebit::detail
