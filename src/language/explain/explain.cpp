#include "ninebit/language/explain.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "ninebit/numerics/hardware_profile.h"
#include "src/language/explain/explain_terms.h"

namespace ninebit {
namespace {

using namespace explain_detail;  // NOLINT(google-build-using-namespace): this file combines those parts

constexpr std::size_t index_of(Register reg) {
  return static_cast<std::size_t>(reg);
}

Ranges initial_ranges(const HardwareProfile& profile, int one) {
  Ranges ranges{};
  for (auto& reg : ranges) reg = {Range{0, one}, Range{0, one}};
  ranges[index_of(Register::zero)] = {};
  ranges[index_of(Register::spare1)] = {};
  ranges[index_of(Register::spare0)][0] = {};
  if (profile.secondary_alpha.value == SecondaryAlpha::one) ranges[index_of(Register::secondary)][1] = {one, one};
  return ranges;
}

// Converts a program in real numbers to finer codes, so that every constant that mappings, products, bias and scale can
// make from `zero` is a whole code: eighths are the finest.
Program with_exact_codes(Program program) {
  constexpr int kFiner = 8;
  Datapath& d = program.datapath;
  d.one *= kFiner;
  d.half = d.one / 2;
  d.lowest = d.lowest_output = -d.one;
  d.expand_offset = d.one;
  const auto finer = [](Rgba9& constant) {
    for (s9& code : constant) code = static_cast<s9>(code * kFiner);
  };
  for (ProgramStage& stage : program.general) finer(stage.constant0), finer(stage.constant1);
  finer(program.constant0);
  finer(program.constant1);
  return program;
}

Fact fact_of(const Datapath& d, const Expression& e, Equation equation, Range limits) {
  Fact fact;
  fact.equation = std::move(equation);
  fact.reads = e.reads;
  fact.marks = e.marks;
  fact.equation.clamps = e.range.low < limits.low || e.range.high > limits.high;
  fact.equation.expression = e.constant ? code_text(d, *e.constant, fact.marks) : with_sign(e);
  fact.range = clamped(e.range, limits.low, limits.high);
  return fact;
}

// The equations of one portion.
void add_portion(const Program& program, int stage, PortionName name, const Ranges& ranges, std::vector<Fact>& facts) {
  const Datapath& d = program.datapath;
  const ProgramStage& from = program.general[static_cast<std::size_t>(stage)];
  const bool rgb = name == PortionName::rgb;
  const Portion& p = rgb ? from.rgb : from.alpha;
  const Scope scope{&d, &ranges, from.constant0, from.constant1, {from.unset[0].has_value(), from.unset[1].has_value()},
                    rgb};
  const auto term = [&](const CombinerInput& x, const CombinerInput& y, bool dot) {
    const Expression left = mapped_input(scope, x, dot);
    const Expression right = mapped_input(scope, y, dot);
    return dot ? dot_product(d, left, right) : product(d, left, right);
  };
  // Only the blue of a product; a dot product is the same in all components.
  const auto blue_of = [&](CombinerInput x, CombinerInput y, bool dot) {
    if (!dot && x.usage == ComponentUsage::rgb) x.usage = ComponentUsage::blue;
    if (!dot && y.usage == ComponentUsage::rgb) y.usage = ComponentUsage::blue;
    return term(x, y, dot);
  };
  const auto add = [&](Register target, unsigned components, std::string output, const Expression& wide) {
    if (target == Register::discard) return;
    Equation equation{.stage = stage, .portion = name, .output = std::move(output)};
    equation.target = std::string(short_name(target)) + (components == kRgbBits ? "" : ".a");
    Fact fact =
        fact_of(d, combiner_output(d, p.out.scale, p.out.bias, wide), std::move(equation), {d.lowest_output, d.one});
    fact.target = target;
    fact.components = components;
    facts.push_back(std::move(fact));
  };
  const unsigned own = rgb ? kRgbBits : kAlphaBit;
  const Expression ab = term(p.a, p.b, p.out.ab_dot_product);
  const Expression cd = term(p.c, p.d, p.out.cd_dot_product);
  add(p.out.ab, own, "AB", ab);
  if (p.out.ab_blue_to_alpha) add(p.out.ab, kAlphaBit, "AB", blue_of(p.a, p.b, p.out.ab_dot_product));
  add(p.out.cd, own, "CD", cd);
  if (p.out.cd_blue_to_alpha) add(p.out.cd, kAlphaBit, "CD", blue_of(p.c, p.d, p.out.cd_dot_product));
  if (p.out.sum == Register::discard) return;
  const Range spare0_alpha = ranges[index_of(Register::spare0)][1];
  if (p.out.mux_sum) {
    add(p.out.sum, own, "mux", choice(d, ab, cd, from.mux_by_lowest_bit, spare0_alpha));
    const Picks picks = mux_picks(d, from.mux_by_lowest_bit, spare0_alpha);
    if (picks != Picks::either) facts.back().mux_picks = picks == Picks::ab ? "AB" : "CD";
  } else {
    add(p.out.sum, own, "sum", sum(d, ab, cd, d.one));
  }
}

void add_final(const Program& program, const Ranges& ranges, std::vector<Fact>& facts) {
  const Datapath& d = program.datapath;
  Scope scope{
      &d,  &ranges, program.constant0, program.constant1, {program.unset[0].has_value(), program.unset[1].has_value()},
      true};
  facts.push_back(fact_of(d, final_color(program, scope),
                          {.portion = PortionName::rgb, .output = "color", .target = "rgb"}, {0, d.one}));
  scope.per_channel = false;
  facts.push_back(fact_of(d, final_alpha(program, scope),
                          {.portion = PortionName::alpha, .output = "alpha", .target = "alpha"}, {0, d.one}));
}

// Marks the equations that reach the final result, from the last to the first.
void mark_used(int stages, std::vector<Fact>& facts) {
  std::array<unsigned, kRegisterCount> needed{};
  const auto read = [&](const Fact& fact, unsigned channels) {
    for (const Read& r : fact.reads) needed[index_of(r.reg)] |= r.needed(channels);
  };
  for (const Fact& fact : facts) {
    if (!fact.equation.stage) read(fact, kRgbBits);
  }
  for (int stage = stages - 1; stage >= 0; --stage) {
    const std::array<unsigned, kRegisterCount> after = needed;
    for (const Fact& fact : facts) {
      if (fact.equation.stage == stage) needed[index_of(fact.target)] &= ~fact.components;
    }
    for (Fact& fact : facts) {
      if (fact.equation.stage != stage) continue;
      const unsigned channels = after[index_of(fact.target)] & fact.components;
      fact.equation.used = channels != 0;
      read(fact, channels);
    }
  }
}

}  // namespace

Explanation explain(const Program& program, const HardwareProfile& profile) {
  const bool real = program.datapath.arithmetic != Arithmetic::integer;
  const Program exact = real ? with_exact_codes(program) : program;
  std::vector<Fact> facts;
  Ranges ranges = initial_ranges(profile, exact.datapath.one);
  for (int stage = 0; stage < exact.num_general_combiners; ++stage) {
    const std::size_t first = facts.size();
    add_portion(exact, stage, PortionName::rgb, ranges, facts);
    add_portion(exact, stage, PortionName::alpha, ranges, facts);
    for (std::size_t i = first; i < facts.size(); ++i) {
      ranges[index_of(facts[i].target)][facts[i].components == kAlphaBit ? 1 : 0] = facts[i].range;
    }
  }
  add_final(exact, ranges, facts);
  mark_used(exact.num_general_combiners, facts);

  Explanation e;
  e.num_general_combiners = exact.num_general_combiners;
  e.profile = std::string(profile.name);
  e.dead = dead_portions(exact, facts);
  e.constants = constant_sentences(program, facts);
  e.notes = notes_of(exact, profile, facts);
  e.legend = legend_of(exact.datapath, facts);
  for (Fact& fact : facts) e.equations.push_back(std::move(fact.equation));
  return e;
}

std::string print_explanation(const Explanation& e) {
  std::string text = std::to_string(e.num_general_combiners) +
                     (e.num_general_combiners == 1 ? " general combiner" : " general combiners") + ", profile " +
                     e.profile + "\n";
  const auto line = [&](const Equation& equation) {
    text += "  " + equation.target + " = " + equation.expression;
    if (!equation.used) text += "    (unused: nothing reads it)";
    text += '\n';
  };
  for (int stage = 0; stage < e.num_general_combiners; ++stage) {
    text += "\nstage " + std::to_string(stage) + "\n";
    for (const PortionName portion : {PortionName::rgb, PortionName::alpha}) {
      for (const Equation& equation : e.equations) {
        if (equation.stage == stage && equation.portion == portion) line(equation);
      }
      for (const DeadPortion& dead : e.dead) {
        if (dead.stage != stage || dead.portion != portion) continue;
        text += std::string("  ") + (portion == PortionName::rgb ? "RGB" : "alpha") + " portion: " + dead.reason + "\n";
      }
    }
  }
  text += "\nfinal combiner\n";
  for (const Equation& equation : e.equations) {
    if (!equation.stage) line(equation);
  }
  const auto section = [&](const char* title, const std::vector<std::string>& sentences) {
    if (sentences.empty()) return;
    text += std::string("\n") + title + "\n";
    for (const std::string& sentence : sentences) text += "  " + sentence + "\n";
  };
  section("constants", e.constants);
  section("defaults that affect the result", e.notes);
  section("how to read this", e.legend);
  return text;
}

}  // namespace ninebit
