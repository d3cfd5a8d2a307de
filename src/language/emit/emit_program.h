// A program as blocks of named values, which each target language prints in its own syntax.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/program.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "src/language/emit/emit_expression.h"

namespace ninebit::emit {

// One live component that a portion writes.
struct Line {
  std::string target;  // "spare0.r", for comments
  std::string name;    // "s0_spare0_r", the variable if the value needs one
  V value;
};

// One portion of one general combiner.
struct Block {
  std::vector<std::string> comments;
  std::vector<Line> lines;
};

struct Listing {
  std::vector<Block> blocks;
  std::vector<std::string> final_comments;
  std::array<V, 4> result{};  // of the final combiner
};

// The name of a register in the emitted text: "primary", "texture0", …
std::string_view short_name_of(Register r);
inline constexpr std::array<char, 4> kComponentLetters{'r', 'g', 'b', 'a'};

// Evaluates the program symbolically. `input` returns the value of an argument's component, or of spare0's initial
// alpha. `constant` returns a component of constant colour 0 or 1 of a general combiner, or of the final combiner,
// whose stage is kMaxGeneralCombiners; without it the program's own constants are literals.
using InputValue = std::function<V(Register, int component)>;
using ConstantValue = std::function<V(Register, int stage, int component)>;
Listing list_program(const Program& program, const InputValue& input, const ConstantValue& constant = {});

// An argument that may be any register code.
V any_code(const Program& program, Graph& graph, std::string text);

// Why the program cannot be emitted under this function name; empty: it can.
std::optional<Diagnostic> refusal(const Program& program, std::string_view function);
// The name alone.
std::optional<Diagnostic> refused_name(std::string_view function);

// A function that emitted texture-shader stages may call: its name behind theirs, and its text, in which '$' is theirs.
struct Helper {
  std::string_view name, text;  // "_dot("
};
// The text of the helper that makes a number c a byte, for the numbers below 0 that a profile has; `size` is c without
// its sign.
std::string byte_helper(std::string_view text, NegativeNumber negative, std::string_view size);
// The texts of the helpers that `lines` call, each after those that it calls; these stand before it in `all`.
std::string called_helpers(std::span<const Helper> all, const std::string& function, const std::string& lines);

// Comments in the emitted text: the equations of a portion and of the final combiner, in ASCII.

// "General combiner 0, RGB portion", its inputs, and one equation for each output that `is_live` names.
struct LiveOutputs {
  bool ab = false, cd = false, sum = false;
  [[nodiscard]] bool any() const { return ab || cd || sum; }
};
std::vector<std::string> comments_of(const Program& program, int stage, PortionName name, const LiveOutputs& live);

std::vector<std::string> comments_of_final(const Program& program);

// The register components that a program's result depends on, after each general combiner.

class LiveSet {
 public:
  void add(Register r, int component) { at(r, component) = true; }
  void remove(Register r, int component) { at(r, component) = false; }
  [[nodiscard]] bool has(Register r, int component) const {
    return r < Register::e_times_f && live_[static_cast<std::size_t>(r)][static_cast<std::size_t>(component)];
  }

 private:
  bool& at(Register r, int component) {
    return live_[static_cast<std::size_t>(r)][static_cast<std::size_t>(component)];
  }
  std::array<std::array<bool, 4>, kRegisterCount> live_{};
};

// Element i: the components that are live after general combiner i.
std::vector<LiveSet> live_after_stages(const Program& program);

}  // namespace ninebit::emit
