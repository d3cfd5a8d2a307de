#include "src/language/xbox/xbox_fields.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "ninebit/numerics/hardware_profile.h"
#include "src/language/source/beyond_opengl.h"
#include "src/system/characters.h"

namespace ninebit::xbox {
namespace {

// Source: Cxbx-Reloaded, XbD3D8Types.h; nv2apretty (pixel_shader_definition.py) reads the same order from titles'
// memory.
constexpr std::array kFields{Field{"PSAlphaInputs", 0, 8},
                             Field{"PSFinalCombinerInputsABCD", 8},
                             Field{"PSFinalCombinerInputsEFG", 9},
                             Field{"PSConstant0", 10, 8},
                             Field{"PSConstant1", 18, 8},
                             Field{"PSAlphaOutputs", 26, 8},
                             Field{"PSRGBInputs", 34, 8},
                             Field{"PSCompareMode", 42},
                             Field{"PSFinalCombinerConstant0", 43},
                             Field{"PSFinalCombinerConstant1", 44},
                             Field{"PSRGBOutputs", 45, 8},
                             Field{"PSCombinerCount", 53},
                             Field{"PSTextureModes", 54},
                             Field{"PSDotMapping", 55},
                             Field{"PSInputTexture", 56},
                             Field{"PSC0Mapping", 57},
                             Field{"PSC1Mapping", 58},
                             Field{"PSFinalCombinerConstants", 59}};

}  // namespace

std::span<const Field> fields() {
  return kFields;
}

const Field* find_field(std::string_view name) {
  if (detail::same_but_case(name, "PSAphaInputs")) return kFields.data();
  const auto found = std::find_if(kFields.begin(), kFields.end(),
                                  [&](const Field& field) { return detail::same_but_case(field.name, name); });
  return found == kFields.end() ? nullptr : &*found;
}

std::vector<std::string_view> field_names() {
  std::vector<std::string_view> names;
  for (const Field& field : kFields) names.push_back(field.name);
  return names;
}

const Field& field_of(std::size_t word) {
  std::size_t i = 0;
  while (i + 1 < kFields.size() && kFields[i + 1].first <= word) ++i;
  return kFields[i];
}

std::string word_name(std::size_t word) {
  const Field& field = field_of(word);
  std::string name(field.name);
  if (field.count > 1) name += '[' + std::to_string(word - field.first) + ']';
  return name;
}

std::string index_fault(const Field& field, std::optional<std::int64_t> index) {
  const std::string name(field.name), last = std::to_string(field.count - 1);
  if (field.count == 1) return index ? name + " is one word; expected no index" : "";
  if (!index) return name + " needs an index from 0 to " + last;
  if (*index >= 0 && *index < static_cast<std::int64_t>(field.count)) return "";
  return name + '[' + std::to_string(*index) + "] is out of range; expected an index from 0 to " + last;
}

bool clears_memory(std::string_view function) {
  constexpr std::string_view kNames[] = {"memset", "ZeroMemory", "RtlZeroMemory", "XMemSet", "bzero"};
  return std::find(std::begin(kNames), std::end(kNames), function) != std::end(kNames);
}

Parsed<CombinerState> program_of_definition(const Definition& definition, const SourceText& source,
                                            const HardwareProfile& profile, std::vector<RegisterWord>* other_words) {
  std::vector<RegisterWord> given;
  for (std::size_t i = 0; i < kXboxDefinitionWords; ++i) {
    const auto& offset = definition.offsets[i];
    given.push_back({word_name(i), definition.words[i], offset ? source.place(*offset) : TextPlace{}});
  }
  Parsed<CombinerState> decoded = decode_register_words(given, source.file, ChipClass::nv20, profile, other_words);
  if (!profile.per_stage_constants) {
    decoded.notes.push_back({std::string(source.file), 1, 1, std::string(detail::kReadForOlderChip)});
  }
  return decoded;
}

}  // namespace ninebit::xbox
