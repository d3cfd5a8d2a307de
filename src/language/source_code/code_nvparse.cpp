// Programs in string literals, which nvparse loads.
#include <algorithm>
#include <tuple>
#include <utility>

#include "ninebit/language/pixel_shader.h"
#include "ninebit/language/rc10.h"
#include "src/language/pixel_shader/shader_parser.h"
#include "src/language/rc10/rc10_parser.h"
#include "src/language/source/foreign_language.h"
#include "src/language/source/string_literals.h"
#include "src/language/source_code/code_machine.h"

namespace ninebit::code {

Value Machine::call_nvparse(const Expression& e) {
  CallSite& site = sites_[e.offset];
  ++calls_made_;
  ++calls_made_on_context_;
  set_since_drawing_ = true;
  std::vector<Value> arguments;
  for (std::size_t i = 1; i < e.parts.size(); ++i) arguments.push_back(evaluate(e.parts[i]));
  need_guards(e);
  const auto found =
      std::find_if(arguments.begin(), arguments.end(), [](const Value& one) { return one.is(ValueKind::text); });
  if (found == arguments.end()) {
    site.is_unknown = true;
    if (!arguments.empty()) need(arguments[0], e.parts[1]);
    return {};
  }
  load(found->begin, found->end, e.offset, found->name);
  return integer_value(0);
}

void Machine::load(std::uint32_t begin, std::uint32_t end, std::uint32_t offset, const std::string& pasted) {
  const SourceText made{.text = pasted, .file = program_.source.file};
  const LiteralText literal(pasted.empty() ? program_.source : made, pasted.empty() ? begin : 0,
                            pasted.empty() ? end : pasted.size());
  loaded_.insert(begin);
  // nvparse also loads programs for other units.
  const std::string_view language = foreign_language(literal.source().text);
  const bool sets_stages = literal.source().text.find(detail::kTs10Header) != std::string_view::npos;
  const bool has_stages = sets_stages && context_.profile().texture_shaders;
  const bool has_combiners = literal.source().text.find("!!RC1.0") != std::string_view::npos;
  if (sets_stages && !has_stages) {
    leave_out_stages(offset, begin);
    if (!has_combiners) return;
    sites_[offset].is_left_out = false;
  }
  if (!language.empty() && !has_combiners && !has_stages) {
    notes_.add(begin, "skipped " + std::string(language) + ": it is not for combiners");
    skipped_language_ = language;
    sites_[offset].is_skipped = true;
    return;
  }
  CallSite& site = sites_[offset];
  const SourceText program = literal.source();
  const bool is_shader = is_pixel_shader(program.text) && program.text.find("!!RC1.0") == std::string_view::npos;
  std::set<std::string> used_by_shaders;
  TextureShaderState stages;
  Parsed<CombinerState> parsed =
      is_shader ? detail::parse_defined_shader(program, given_, context_.profile(), used_by_shaders)
                : parse_rc10(program, context_.profile(), has_stages ? &stages : nullptr);
  for (const std::string& name : used_by_shaders) used_.insert(normal_path(name));
  site.is_read = true;
  for (TextFault& fault : parsed.notes) {
    const bool is_half = has_stages && !has_combiners && fault.message == detail::kNoRegisterCombiners;
    const bool is_left_out = sets_stages && !has_stages && fault.message.find(detail::kTs10Header) != std::string::npos;
    if (!is_half && !is_left_out) notes_.add(std::move(fault));
  }
  for (TextFault fault : parsed.faults()) {
    const TextPlace place = program_.source.place(begin);
    if (!pasted.empty()) std::tie(fault.line, fault.column) = std::tie(place.line, place.column);
    if (!site.is_refused) faults_.add(std::move(fault));
  }
  site.is_refused = site.is_refused || !parsed;
  if (!parsed) return;
  if (has_stages) {
    stages.enabled = context_.texture_shader().enabled;  // glEnable says that
    stages_at_ = begin;
    context_.texture_shader() = stages;
    if (!has_combiners) return;
  }
  context_.state() = *parsed;
  const ByConstant<bool> read = constants_read(*parsed);
  for (std::size_t which = 0; which < 2; ++which) {
    for (std::size_t place = 0; place <= kFinalConstants; ++place) {
      const std::size_t of = parsed->per_stage_constants ? place : kFinalConstants;
      if (read[place][which] && !parsed->origin[place][which].unset) context_.constants_set()[of][which] = true;
    }
  }
}

}  // namespace ninebit::code
