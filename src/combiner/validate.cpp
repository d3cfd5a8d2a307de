#include "ninebit/combiner/validate.h"

namespace ninebit {
namespace {

std::string place(int stage, PortionName portion) {
  return "general combiner " + std::to_string(stage) + ", " + (portion == PortionName::rgb ? "RGB" : "alpha") +
         " portion";
}

std::string variable_name(Variable v) {
  return std::string("variable ") + static_cast<char>('A' + static_cast<int>(v));
}

std::string quoted(Register r) {
  return std::string(name_of(r));
}

// Collects diagnostics that share a place.
class Findings {
 public:
  Findings(std::optional<int> stage, std::optional<PortionName> portion, std::optional<Variable> variable)
      : prototype_{stage, portion, variable, {}, GlError::no_error, {}} {
    if (stage) place_ = place(*stage, portion.value_or(PortionName::rgb));
    if (!stage && variable) place_ = "final combiner";
    if (variable) place_ += ", " + variable_name(*variable);
  }

  void add(GlError error, const std::string& what) {
    StateDiagnostic found = prototype_;
    found.gl_error = error;
    found.message = place_ + ": " + what;
    found_.push_back(std::move(found));
  }

  std::vector<StateDiagnostic> take() { return std::move(found_); }

 private:
  StateDiagnostic prototype_;
  std::string place_;
  std::vector<StateDiagnostic> found_;
};

bool exists(Register r, const HardwareProfile& profile) {
  return !is_texture(r) || texture_unit_of(r) < profile.texture_units;
}

void check_register_exists(Findings& findings, Register r, const HardwareProfile& profile) {
  if (!exists(r, profile)) {
    findings.add(GlError::invalid_enum, quoted(r) + " is beyond the " + std::to_string(profile.texture_units.value) +
                                            " texture units of profile " + std::string(profile.name));
  }
}

bool is_writable(Register r) {
  return r == Register::discard || r == Register::primary || r == Register::secondary || r == Register::spare0 ||
         r == Register::spare1 || is_texture(r);
}

void append(std::vector<StateDiagnostic>& all, std::vector<StateDiagnostic> more) {
  for (StateDiagnostic& one : more) all.push_back(std::move(one));
}

void check_stage(Findings& findings, int stage, const HardwareProfile& profile) {
  if (stage < 0 || stage >= profile.general_combiners) {
    findings.add(GlError::invalid_enum, "profile " + std::string(profile.name) + " has " +
                                            std::to_string(profile.general_combiners.value) + " general combiners");
  }
}

}  // namespace

std::string_view name_of(GlError error) {
  switch (error) {
    case GlError::no_error:
      return "GL_NO_ERROR";
    case GlError::invalid_enum:
      return "GL_INVALID_ENUM";
    case GlError::invalid_value:
      return "GL_INVALID_VALUE";
    case GlError::invalid_operation:
      return "GL_INVALID_OPERATION";
  }
  return "GL_NO_ERROR";
}

std::vector<StateDiagnostic> validate_input(int stage, PortionName portion, Variable variable,
                                            const CombinerInput& input, const HardwareProfile& profile) {
  Findings findings(stage, portion, variable);
  check_stage(findings, stage, profile);
  if (variable > Variable::d) findings.add(GlError::invalid_enum, "a general combiner has the variables A to D");
  if (input.reg >= Register::e_times_f) {
    findings.add(GlError::invalid_enum, quoted(input.reg) + " cannot be read by a general combiner");
  }
  check_register_exists(findings, input.reg, profile);
  // A caller may have cast any number to these enumerations. Evaluation relies on their enumerators.
  if (input.mapping > InputMapping::signed_negate) findings.add(GlError::invalid_enum, "unknown input mapping");
  if (input.usage > ComponentUsage::blue) findings.add(GlError::invalid_enum, "unknown component usage");
  if (portion == PortionName::rgb && input.usage == ComponentUsage::blue) {
    findings.add(GlError::invalid_operation,
                 "component usage blue is for alpha portions; an RGB portion takes rgb or alpha");
  }
  if (portion == PortionName::alpha && input.usage == ComponentUsage::rgb) {
    findings.add(GlError::invalid_operation,
                 "component usage rgb is for RGB portions; an alpha portion takes alpha or blue");
  }
  if (input.reg == Register::fog && input.usage == ComponentUsage::alpha) {
    findings.add(GlError::invalid_operation, "fog's alpha can be read by the final combiner alone");
  }
  return findings.take();
}

std::vector<StateDiagnostic> validate_output(int stage, PortionName portion, const PortionOutput& output,
                                             const HardwareProfile& profile) {
  Findings findings(stage, portion, std::nullopt);
  check_stage(findings, stage, profile);
  if (output.scale > Scale::by_one_half) findings.add(GlError::invalid_enum, "unknown scale");
  if (output.bias > Bias::by_negative_one_half) findings.add(GlError::invalid_enum, "unknown bias");
  const Register registers[3] = {output.ab, output.cd, output.sum};
  for (const Register r : registers) {
    if (!is_writable(r)) findings.add(GlError::invalid_enum, quoted(r) + " cannot be written");
    check_register_exists(findings, r, profile);
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = i + 1; j < 3; ++j) {
      if (registers[i] == registers[j] && registers[i] != Register::discard) {
        findings.add(GlError::invalid_operation,
                     "two outputs go to " + quoted(registers[i]) + "; each needs its own register");
      }
    }
  }
  if (portion == PortionName::alpha && (output.ab_dot_product || output.cd_dot_product)) {
    findings.add(GlError::invalid_value, "an alpha portion has no dot product");
  }
  if (output.ab_blue_to_alpha || output.cd_blue_to_alpha) {
    if (portion == PortionName::alpha) findings.add(GlError::invalid_value, "an alpha portion has no blue");
    if (!profile.blue_to_alpha) {
      findings.add(GlError::invalid_enum,
                   "profile " + std::string(profile.name) + " has no blue-to-alpha outputs (NV2A)");
    }
  }
  if (output.bias != Bias::none && (output.scale == Scale::by_four || output.scale == Scale::by_one_half)) {
    findings.add(GlError::invalid_operation,
                 "a bias of minus one half goes with no scale or with scale_by_two, not with " +
                     std::string(name_of(output.scale)));
  }
  return findings.take();
}

std::vector<StateDiagnostic> validate_final_input(Variable variable, const CombinerInput& input,
                                                  const HardwareProfile& profile) {
  Findings findings(std::nullopt, std::nullopt, variable);
  const bool computed = input.reg == Register::e_times_f || input.reg == Register::spare0_plus_secondary;
  if (input.reg >= Register::discard) findings.add(GlError::invalid_enum, quoted(input.reg) + " cannot be read");
  check_register_exists(findings, input.reg, profile);
  if (input.usage > ComponentUsage::blue) findings.add(GlError::invalid_enum, "unknown component usage");
  if (input.mapping != InputMapping::unsigned_identity && input.mapping != InputMapping::unsigned_invert) {
    findings.add(GlError::invalid_enum, "the final combiner takes unsigned_identity and unsigned_invert, not " +
                                            std::string(name_of(input.mapping)));
  }
  if (computed && variable >= Variable::e) {
    findings.add(GlError::invalid_operation, quoted(input.reg) + " can be read by the variables A to D alone");
  }
  if (input.reg == Register::spare0_plus_secondary && variable == Variable::a) {
    findings.add(GlError::invalid_operation,
                 "spare0_plus_secondary_color can be read by the variables B, C and D alone");
  }
  if (variable == Variable::g && input.usage == ComponentUsage::rgb) {
    findings.add(GlError::invalid_operation, "component usage rgb is not for variable G, which takes alpha or blue");
  }
  if (variable != Variable::g && input.usage == ComponentUsage::blue) {
    findings.add(GlError::invalid_operation, "component usage blue is for variable G alone");
  }
  if (computed && input.usage != ComponentUsage::rgb) {
    findings.add(GlError::invalid_operation, quoted(input.reg) + " has no alpha; its component usage is rgb");
  }
  return findings.take();
}

std::vector<StateDiagnostic> validate(const CombinerState& state, const HardwareProfile& profile) {
  std::vector<StateDiagnostic> all;
  if (state.num_general_combiners < 1 || state.num_general_combiners > profile.general_combiners) {
    all.push_back({{},
                   {},
                   {},
                   StateParameter::num_general_combiners,
                   GlError::invalid_value,
                   "num_general_combiners is " + std::to_string(state.num_general_combiners) + "; profile " +
                       std::string(profile.name) + " has 1 to " + std::to_string(profile.general_combiners.value)});
  }
  const auto lacks = [&](StateParameter parameter, const std::string& what) {
    all.push_back({{}, {}, {}, parameter, GlError::invalid_enum, "profile " + std::string(profile.name) + what});
  };
  if (state.per_stage_constants && !profile.per_stage_constants) {
    lacks(StateParameter::per_stage_constants, " has no per-stage constants (NV_register_combiners2)");
  }
  if (state.mux_by_lowest_bit && !profile.mux_by_lowest_bit) {
    lacks(StateParameter::mux_by_lowest_bit, " has no mux by the lowest bit of spare0's alpha (NV2A)");
  }
  if ((state.color_sum_invert_spare0 || state.color_sum_invert_secondary) && !profile.color_sum_inverts) {
    lacks(StateParameter::color_sum_inverts, " has no 1 - x in the colour sum (NV2A)");
  }
  const int stages = profile.general_combiners;
  for (int i = 0; i < stages && i < kMaxGeneralCombiners; ++i) {
    for (const PortionName name : {PortionName::rgb, PortionName::alpha}) {
      const GeneralCombiner& stage = state.general[static_cast<std::size_t>(i)];
      const Portion& portion = name == PortionName::rgb ? stage.rgb : stage.alpha;
      append(all, validate_input(i, name, Variable::a, portion.a, profile));
      append(all, validate_input(i, name, Variable::b, portion.b, profile));
      append(all, validate_input(i, name, Variable::c, portion.c, profile));
      append(all, validate_input(i, name, Variable::d, portion.d, profile));
      append(all, validate_output(i, name, portion.out, profile));
    }
  }
  const FinalCombiner& f = state.final_combiner;
  append(all, validate_final_input(Variable::a, f.a, profile));
  append(all, validate_final_input(Variable::b, f.b, profile));
  append(all, validate_final_input(Variable::c, f.c, profile));
  append(all, validate_final_input(Variable::d, f.d, profile));
  append(all, validate_final_input(Variable::e, f.e, profile));
  append(all, validate_final_input(Variable::f, f.f, profile));
  append(all, validate_final_input(Variable::g, f.g, profile));
  return all;
}

}  // namespace ninebit
