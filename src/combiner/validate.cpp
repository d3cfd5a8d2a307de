#include "ninebit/combiner/validate.h"

#include <algorithm>

#include "src/combiner/state_rules.h"

namespace ninebit {
namespace {

// The text of a fault, whose sentence names things of the profile and what the fault is about.
std::string text_of(std::string_view sentence, int about, const HardwareProfile& profile) {
  std::string text;
  while (!sentence.empty()) {
    const std::size_t open = std::min(sentence.find('{'), sentence.size());
    text += sentence.substr(0, open);
    sentence.remove_prefix(open);
    if (sentence.empty()) break;
    const std::size_t close = sentence.find('}');
    const std::string_view name = sentence.substr(1, close - 1);
    if (name == "profile") text += profile.name;
    if (name == "combiners") text += std::to_string(rules::most_combiners(profile));
    if (name == "units") text += std::to_string(profile.texture_units.value);
    if (name == "number") text += std::to_string(about);
    if (name == "register") text += name_of(static_cast<Register>(about));
    if (name == "mapping") text += name_of(static_cast<InputMapping>(about));
    if (name == "scale") text += name_of(static_cast<Scale>(about));
    sentence.remove_prefix(close + 1);
  }
  return text;
}

// "general combiner 0, RGB portion, variable A: "; nothing for a parameter.
std::string place_text(const StateDiagnostic& at) {
  if (at.parameter) return {};
  std::string text = "final combiner";
  if (at.stage) {
    text = "general combiner " + std::to_string(*at.stage) + ", " + (at.portion == PortionName::rgb ? "RGB" : "alpha") +
           " portion";
  }
  if (at.variable) text += std::string(", variable ") + static_cast<char>('A' + static_cast<int>(*at.variable));
  return text + ": ";
}

// Collects the faults that the rules find, each with its place.
class Findings {
 public:
  explicit Findings(const HardwareProfile& profile) : profile_(profile) {}

  void at_parameter(StateParameter parameter) { at_ = {{}, {}, {}, parameter, GlError::no_error, {}}; }
  void at_output(int stage, PortionName portion) { at_ = {stage, portion, {}, {}, GlError::no_error, {}}; }
  void at_variable(int stage, PortionName portion, Variable variable) {
    at_ = {stage, portion, variable, {}, GlError::no_error, {}};
  }
  void at_final(Variable variable) { at_ = {{}, {}, variable, {}, GlError::no_error, {}}; }
  void add(rules::StateFault what, int about) {
    const rules::FaultText& fault = rules::kFaultTexts[static_cast<std::size_t>(what)];
    StateDiagnostic& found = found_.emplace_back(at_);
    found.gl_error = fault.error;
    found.message = place_text(at_) + text_of(fault.text, about, profile_);
  }

  std::vector<StateDiagnostic> take() { return std::move(found_); }

 private:
  const HardwareProfile& profile_;
  StateDiagnostic at_{};
  std::vector<StateDiagnostic> found_;
};

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
  Findings findings(profile);
  rules::check_input(findings, stage, portion, variable, input, profile);
  return findings.take();
}

std::vector<StateDiagnostic> validate_output(int stage, PortionName portion, const PortionOutput& output,
                                             const HardwareProfile& profile) {
  Findings findings(profile);
  rules::check_output(findings, stage, portion, output, profile);
  return findings.take();
}

std::vector<StateDiagnostic> validate_final_input(Variable variable, const CombinerInput& input,
                                                  const HardwareProfile& profile) {
  Findings findings(profile);
  rules::check_final_input(findings, variable, input, profile);
  return findings.take();
}

std::vector<StateDiagnostic> validate(const CombinerState& state, const HardwareProfile& profile) {
  Findings findings(profile);
  rules::check_state(findings, state, profile);
  return findings.take();
}

}  // namespace ninebit
