// The notes, constants and legend beside the equations of an explanation.
#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/numerics/hardware_profile.h"
#include "src/language/explain/explain_terms.h"

namespace ninebit::explain_detail {
namespace {

const Portion& portion_of(const Program& program, int stage, PortionName name) {
  const ProgramStage& from = program.general[static_cast<std::size_t>(stage)];
  return name == PortionName::rgb ? from.rgb : from.alpha;
}

bool is_default(const Portion& portion, PortionName name) {
  return portion == detail::normalize_portion(default_portion(name));
}

std::string name_of_portion(PortionName name) {
  return name == PortionName::rgb ? "RGB" : "alpha";
}

// "stage 0's RGB portion", "the final combiner's alpha".
std::string reader_of(const Equation& equation) {
  if (!equation.stage) return equation.portion == PortionName::rgb ? "the final combiner's RGB" : "the final alpha";
  return "stage " + std::to_string(*equation.stage) + "'s " + name_of_portion(equation.portion) + " portion";
}

bool reads(const Fact& fact, Register reg, unsigned components) {
  const auto hit = [&](const Read& r) { return r.reg == reg && (r.needed(kRgbBits) & components) != 0; };
  return std::any_of(fact.reads.begin(), fact.reads.end(), hit);
}

// The first used equation that reads these components before any stage has written them.
std::optional<std::string> reader_of_initial(const std::vector<Fact>& facts, Register reg, unsigned components) {
  std::optional<int> written_in;
  for (const Fact& fact : facts) {
    const std::optional<int>& stage = fact.equation.stage;
    if (written_in && (!stage || *stage > *written_in)) return std::nullopt;
    if (fact.equation.used && reads(fact, reg, components)) return reader_of(fact.equation);
    if (stage && fact.target == reg && (fact.components & components) != 0) written_in = stage;
  }
  return std::nullopt;
}

void add_initial_register_notes(const HardwareProfile& profile, const std::vector<Fact>& facts,
                                std::vector<std::string>& notes) {
  const auto note = [&](Register reg, unsigned components, const std::string& what) {
    if (const auto reader = reader_of_initial(facts, reg, components)) notes.push_back(what + ": read by " + *reader);
  };
  note(Register::spare0, kAlphaBit, "spare0 alpha still holds texture 0's alpha");
  note(Register::spare0, kRgbBits, "spare0 holds 0 before it is written (GL leaves it undefined)");
  note(Register::spare1, kRgbBits, "spare1 holds 0 before it is written (GL leaves it undefined)");
  note(Register::spare1, kAlphaBit, "spare1 alpha holds 0 before it is written (GL leaves it undefined)");
  if (profile.secondary_alpha.value == SecondaryAlpha::one) {
    note(Register::secondary, kAlphaBit, "secondary alpha is 1 with this profile, whatever the colour's alpha is");
  }
  note(Register::fog, kAlphaBit, "fog alpha is the fog factor, and 1 while fog is off");
}

// " = (0, 128, 255, 0)/255", " is not set"; `from`: a general combiner, or the program for the final one.
template <class Stage>
std::string value_of_constant(const Stage& from, Register reg, const Datapath& d) {
  const bool first = reg == Register::constant0;
  if (const auto& name = from.unset[first ? 0 : 1]) {
    const std::string own = name_of_constant(*name);
    return own == short_name(reg) ? " is not set" : " is " + own + ", which is not set";
  }
  const Rgba9& value = first ? from.constant0 : from.constant1;
  std::string text = " = (";
  for (std::size_t c = 0; c < 4; ++c) text += (c > 0 ? ", " : "") + std::to_string(value[c]);
  return text + ")/" + std::to_string(d.one);
}

}  // namespace

std::vector<DeadPortion> dead_portions(const Program& program, const std::vector<Fact>& facts) {
  std::vector<DeadPortion> dead;
  for (int stage = 0; stage < program.num_general_combiners; ++stage) {
    for (const PortionName name : {PortionName::rgb, PortionName::alpha}) {
      const Portion& portion = portion_of(program, stage, name);
      const bool used = std::any_of(facts.begin(), facts.end(), [&](const Fact& f) {
        return f.equation.stage == stage && f.equation.portion == name && f.equation.used;
      });
      if (used) continue;
      std::string reason = "dead, nothing reads its outputs";
      if (is_default(portion, name)) reason = "dead, GL's default, and nothing reads its outputs";
      if (!is_live(portion.out)) reason = "dead, all its outputs are discarded";
      dead.push_back({stage, name, std::move(reason)});
    }
  }
  return dead;
}

std::vector<std::string> constant_sentences(const Program& program, const std::vector<Fact>& facts) {
  std::vector<std::string> sentences;
  for (const Register reg : {Register::constant0, Register::constant1}) {
    std::vector<std::pair<std::string, std::string>> values;  // with the readers
    for (const Fact& fact : facts) {
      if (!reads(fact, reg, kRgbBits | kAlphaBit)) continue;
      const std::optional<int>& stage = fact.equation.stage;
      const ProgramStage* from = stage ? &program.general[static_cast<std::size_t>(*stage)] : nullptr;
      const std::string value = from == nullptr ? value_of_constant(program, reg, program.datapath)
                                                : value_of_constant(*from, reg, program.datapath);
      const std::string reader = stage ? "stage " + std::to_string(*stage) : "the final combiner";
      const auto known = std::find_if(values.begin(), values.end(), [&](const auto& v) { return v.first == value; });
      if (known == values.end()) {
        values.emplace_back(value, reader);
      } else if (!known->second.ends_with(reader)) {
        known->second += ", " + reader;
      }
    }
    for (const auto& [value, readers] : values) {
      std::string sentence = std::string(short_name(reg)) + value;
      if (values.size() > 1) sentence += " in " + readers;
      sentences.push_back(std::move(sentence));
    }
  }
  return sentences;
}

std::vector<std::string> notes_of(const Program& program, const HardwareProfile& profile,
                                  const std::vector<Fact>& facts) {
  std::vector<std::string> notes;
  add_initial_register_notes(profile, facts, notes);
  for (const Fact& fact : facts) {
    const Equation& equation = fact.equation;
    if (!equation.stage || !equation.used) continue;
    if (is_default(portion_of(program, *equation.stage, equation.portion), equation.portion)) {
      notes.push_back(reader_of(equation) + " is GL's default: " + equation.target + " = " + equation.expression);
    }
    if (!fact.mux_picks.empty()) {
      const bool by_bit = program.general[static_cast<std::size_t>(*equation.stage)].mux_by_lowest_bit;
      notes.push_back("the mux of " + reader_of(equation) + " always picks " + fact.mux_picks +
                      ": spare0 alpha can only be " + (by_bit ? "one code" : "on that side of ½"));
    }
  }
  const FinalCombiner gl;
  if (is_default_color(program.final_combiner)) {
    notes.emplace_back("the final combiner's RGB is fog and colour sum, GL's default");
  }
  if (program.final_combiner.g == gl.g) notes.emplace_back("the final alpha is spare0's alpha, GL's default");
  const Fact& color = facts[facts.size() - 2];
  if (program.color_sum_clamp && color.equation.expression.find("min(1, ") != std::string::npos) {
    notes.emplace_back("the colour sum is clamped to 1, GL's default");
  }
  return notes;
}

std::vector<std::string> legend_of(const Datapath& d, const std::vector<Fact>& facts) {
  Marks marks;
  for (const Fact& fact : facts) marks.insert(fact.marks.begin(), fact.marks.end());
  const std::map<Mark, std::string> words{
      {Mark::expand, "expand(x) = 2·x − 1"},
      {Mark::half, d.arithmetic == Arithmetic::integer
                       ? "½ is the code " + std::to_string(d.half) + " of " + std::to_string(d.one)
                       : "½ is one half exactly"},
      {Mark::odd, "odd(x): the lowest bit of x's code, or of 0 if x is negative"},
      {Mark::product, "a × b multiplies component by component"},
      {Mark::dot, "dot(a, b) is the dot product of red, green and blue, in every component"},
      {Mark::swizzle, "x.aaa, x.blue.blue.blue: one component in place of red, green and blue"},
      {Mark::max, "max(0, x): x can be negative here, and the mapping clamps that to 0"},
  };
  std::vector<std::string> sentences;
  for (const Mark mark : marks) sentences.push_back(words.at(mark));
  sentences.emplace_back("a stage reads all its inputs before it writes; its results are clamped to [−1, 1]");
  sentences.emplace_back("the final combiner's results are clamped to [0, 1]");
  return sentences;
}

namespace {

// The inputs of the final combiner, with E·F and the colour sum expanded in place.
class FinalInputs {
 public:
  FinalInputs(const Program& program, const Scope& scope) : program_(program), scope_(scope) {}

  [[nodiscard]] Expression value(const CombinerInput& in) const {
    if (in.reg == Register::e_times_f) return mapped_value(d(), in.mapping, e_times_f());
    if (in.reg == Register::spare0_plus_secondary) return mapped_value(d(), in.mapping, color_sum());
    return mapped_input(scope_, in, false);
  }

 private:
  [[nodiscard]] const Datapath& d() const { return *scope_.datapath; }

  [[nodiscard]] Expression e_times_f() const {
    const FinalCombiner& f = program_.final_combiner;
    Expression ef = product(d(), mapped_input(scope_, f.e, false), mapped_input(scope_, f.f, false));
    const auto code = [&](int wide) {
      return reference::narrow(d().final_narrowing, std::max(0, wide), d().one, d().one);
    };
    if (ef.constant) ef.constant = code(*ef.constant);
    ef.range = {code(ef.range.low), code(ef.range.high)};
    return ef;
  }

  [[nodiscard]] Expression color_sum() const {
    const auto rgb = [&](Register reg, bool inverted) {
      const auto mapping = inverted ? InputMapping::unsigned_invert : InputMapping::unsigned_identity;
      return mapped_input(scope_, {reg, mapping, ComponentUsage::rgb}, false);
    };
    Expression e = sum(d(), rgb(Register::spare0, program_.color_sum_invert_spare0),
                       rgb(Register::secondary, program_.color_sum_invert_secondary), 1);
    if (program_.color_sum_clamp && e.range.high > d().one) {
      e.text = "min(1, " + e.text + ")";
      e.binding = Binding::atom;
      e.range.high = d().one;
    }
    return e;
  }

  const Program& program_;
  const Scope& scope_;
};

CombinerInput complement(CombinerInput in) {
  in.mapping =
      in.mapping == InputMapping::unsigned_identity ? InputMapping::unsigned_invert : InputMapping::unsigned_identity;
  return in;
}

// Converts a wide value to a code, in its constant and its range. Wide values that are whole codes are products by 1;
// the text does not show the unit and stays.
Expression as_code(const Datapath& d, Expression wide) {
  if (wide.constant) wide.constant = reference::narrow(d.final_narrowing, *wide.constant, d.one, 2 * d.one);
  wide.range = {wide.range.low / d.one, (wide.range.high + d.one - 1) / d.one};
  return wide;
}

}  // namespace

Expression final_color(const Program& program, const Scope& scope) {
  const Datapath& d = *scope.datapath;
  const FinalCombiner& f = program.final_combiner;
  const FinalInputs inputs(program, scope);
  const Expression b = inputs.value(f.b);
  const Expression c = inputs.value(f.c);
  Expression blend;
  if (f.b == f.c) {
    blend = b;  // whatever A is: A·B + (1 - A)·B is B to the bit
  } else {
    // A cannot exceed one, so 1 - A is the other unsigned mapping of the same register.
    const Expression ab = product(d, inputs.value(f.a), b);
    const Expression rest = product(d, inputs.value(complement(f.a)), c);
    blend = as_code(d, sum(d, ab, rest, d.one));
  }
  return sum(d, blend, inputs.value(f.d), 1);
}

Expression final_alpha(const Program& program, const Scope& scope) {
  return FinalInputs(program, scope).value(program.final_combiner.g);
}

bool is_default_color(const FinalCombiner& f) {
  const FinalCombiner gl;
  return f.a == gl.a && f.b == gl.b && f.c == gl.c && f.d == gl.d;
}

}  // namespace ninebit::explain_detail
