#include "ninebit/language/pixel_shader.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "src/language/pixel_shader/shader_parser.h"
#include "src/language/source/foreign_language.h"
#include "src/language/source/source_faults.h"
#include "src/language/source/string_literals.h"
#include "src/system/lines.h"

namespace ninebit {
namespace {

using detail::ShaderFile;
using detail::ShaderInstruction;
using detail::ShaderOp;
using detail::ShaderText;

// Where the first token stands that is neither blank, comment nor a line of the preprocessor.
std::size_t shader_begin(std::string_view text) {
  std::size_t at = mark_size(text);
  while (at < text.size()) {
    const std::string_view rest = text.substr(at);
    if (detail::is_blank(rest.front())) {
      ++at;
    } else if (rest.front() == ';' || rest.front() == '#' || rest.starts_with("//")) {
      at = std::min(text.find('\n', at), text.size());
    } else if (rest.starts_with("/*")) {
      const std::size_t end = text.find("*/", at + 2);
      at = end == std::string_view::npos ? text.size() : end + 2;
    } else {
      break;
    }
  }
  return at;
}

// "a, b and c"
std::string listed(const std::set<std::string>& names) {
  std::string out;
  std::size_t left = names.size();
  for (const std::string& name : names) {
    out += name;
    --left;
    out += left > 1 ? ", " : left == 1 ? " and " : "";
  }
  return out;
}

// Says what runs before the combiners, and what the text leaves to the application.
void note_outside(const ShaderText& text, bool skips_textures, detail::SourceFaults& notes) {
  std::set<std::string> fetches, registers, constants;
  std::optional<std::size_t> first_fetch, first_constant;
  for (const ShaderInstruction& one : text.instructions) {
    if (one.op() == ShaderOp::texture) {
      if (!first_fetch) first_fetch = one.offset;
      fetches.emplace(one.row->name);
      registers.insert(detail::lower_case(one.targets[0].text));
      continue;
    }
    for (const detail::ShaderOperand& from : one.operands) {
      if (from.file != ShaderFile::constant || text.constants.at(static_cast<std::size_t>(from.index)).defined)
        continue;
      if (!first_constant) first_constant = from.offset;
      constants.insert("c" + std::to_string(from.index));
    }
  }
  if (first_fetch && skips_textures) {
    notes.add(*first_fetch, listed(fetches) + (fetches.size() == 1 ? " is" : " are") +
                                " executed before the combiners, and skipped; " + listed(registers) +
                                (registers.size() == 1 ? " holds" : " hold") + " the result");
  }
  if (first_constant) {
    const bool one = constants.size() == 1;
    notes.add(*first_constant, listed(constants) + (one ? " is" : " are") + " not defined here; the application sets " +
                                   (one ? "it" : "them"));
  }
}

// Whether a constant is the eye vector of a texture instruction, which is not clamped.
bool is_eye(const ShaderText& text, int constant) {
  return std::any_of(text.instructions.begin(), text.instructions.end(), [&](const ShaderInstruction& one) {
    return one.op() == ShaderOp::texture && one.operands.size() == 2 && one.operands[1].file == ShaderFile::constant &&
           one.operands[1].index == constant;
  });
}

// Says where a value is another one than the text has.
void note_ranges(const ShaderText& text, detail::SourceFaults& notes) {
  for (std::size_t i = 0; i < text.constants.size(); ++i) {
    const detail::ShaderConstant& one = text.constants[i];
    if (is_eye(text, static_cast<int>(i))) continue;
    const float lowest = *std::min_element(one.color.begin(), one.color.end());
    const float highest = *std::max_element(one.color.begin(), one.color.end());
    const bool below = text.version.is_xbox ? lowest < 0 : lowest < -1;
    if (below || highest > 1) {
      notes.add(one.offset,
                "c" + std::to_string(i) + " is clamped to " + (text.version.is_xbox ? "0" : "-1") + " to 1");
    }
  }
  if (text.version.minor == 4 && !text.instructions.empty()) {
    notes.add(text.instructions.front().offset,
              "registers of ps.1.4 hold at least -8 to 8; those of combiners are clamped to -1 to 1");
  }
}

// Says if the alpha of the result is what spare0's alpha begins with.
void note_result(const ShaderText& text, detail::SourceFaults& notes) {
  bool rgb = false, alpha = false;
  for (const ShaderInstruction& one : text.instructions) {
    if (one.op() == ShaderOp::xfc || text.version.minor == 4) return;
    for (const detail::ShaderTarget& to : one.targets) {
      if (to.file != ShaderFile::temporary || to.index != 0) continue;
      rgb = rgb || to.rgb;
      alpha = alpha || to.alpha;
    }
  }
  if (rgb && !alpha) notes.add(text.instructions.front().offset, "r0.a is not written; it begins as texture 0's alpha");
}

}  // namespace

namespace detail {

std::size_t find_shader_literal(std::string_view text) {
  constexpr std::array<std::string_view, 8> kHeaders{"ps.1.", "ps_1_", "xps.1",  "xps_1",
                                                     "PS.1.", "XPS.1", "!!PS1.", "!!ps1."};
  std::size_t first = std::string_view::npos;
  for (const std::string_view header : kHeaders) first = std::min(first, find_literal(text, header));
  return first;
}

}  // namespace detail

bool is_pixel_shader(std::string_view text) {
  return detail::shader_version_length(text.substr(shader_begin(text))) > 0 && foreign_language(text).empty();
}

Parsed<CombinerState> detail::parse_defined_shader(const SourceText& source, const std::vector<Definition>& definitions,
                                                   const HardwareProfile& profile, std::set<std::string>& used,
                                                   const SourceInclude& include, TextureShaderState* texture_shader) {
  detail::SourceFaults faults(source), notes(source);
  if (detail::too_long(source, faults)) return faults.take();
  if (detail::shader_version_length(source.text.substr(shader_begin(source.text))) == 0) {
    const std::size_t quote = detail::find_shader_literal(source.text);
    if (quote != std::string_view::npos) {
      const LiteralText shader(source, quote, end_of_literals(source.text, quote));
      return parse_defined_shader(shader.source(), definitions, profile, used, include, texture_shader);
    }
  }
  if (const std::string_view language = foreign_language(source.text); !language.empty()) {
    faults.add(shader_begin(source.text), cannot_run(language));
    return faults.take();
  }
  const auto tokens = detail::preprocess_shader(source.text, definitions, include, faults, notes);
  used.insert(tokens.used.begin(), tokens.used.end());
  if (!tokens.is_whole) return {faults.take(), notes.take()};
  const ShaderText text = detail::parse_shader(tokens, faults);
  if (text.version.name.empty()) return {faults.take(), notes.take()};
  return program_of_shader(text, profile, faults, notes, texture_shader);
}

Parsed<CombinerState> detail::program_of_shader(const ShaderText& text, const HardwareProfile& profile,
                                                SourceFaults& faults, SourceFaults& notes,
                                                TextureShaderState* texture_shader) {
  check_shader_rules(text, faults);
  const CombinerState state = translate_shader(text, profile, faults, notes);
  TextureShaderState stages;
  if (texture_shader != nullptr) stages = translate_textures(text, profile, faults, notes);
  note_outside(text, texture_shader == nullptr, notes);
  note_ranges(text, notes);
  note_result(text, notes);
  if (!faults.empty()) return {faults.take(), notes.take()};
  if (texture_shader != nullptr) *texture_shader = stages;
  return {state, notes.take()};
}

Parsed<CombinerState> parse_pixel_shader(const SourceText& source, const HardwareProfile& profile,
                                         const std::vector<Definition>& definitions, const SourceInclude& include,
                                         TextureShaderState* texture_shader) {
  std::set<std::string> used;
  auto parsed = detail::parse_defined_shader(source, definitions, profile, used, include, texture_shader);
  detail::SourceFaults notes(source);
  for (const Definition& one : definitions) {
    if (!used.contains(one.name)) notes.add(0, detail::not_needed(one));
  }
  for (TextFault& note : notes.take()) parsed.notes.push_back(std::move(note));
  return parsed;
}

}  // namespace ninebit
