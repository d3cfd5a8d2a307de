#include "src/language/register_words/register_words_other.h"

#include <algorithm>

#include "src/language/register_words/register_words_layout.h"

namespace ninebit::words {
namespace {

// A name in lower case, without prefix and SET_.
struct OtherAlias {
  std::string_view bare, name;
};

// The methods' names are those of nxdk's nv2a_regs.h, then those of envytools rnndb. Direct3D writes these four words
// to the chip; it keeps the others for itself.
constexpr OtherAlias kOtherAliases[] = {
    {"shader_clip_plane_mode", "PSCompareMode"},
    {"tex_shader_cull_mode", "PSCompareMode"},
    {"shader_stage_program", "PSTextureModes"},
    {"tex_shader_op", "PSTextureModes"},
    {"dot_rgbmapping", "PSDotMapping"},
    {"tex_shader_dotmapping", "PSDotMapping"},
    {"shader_other_stage_input", "PSInputTexture"},
    {"tex_shader_previous", "PSInputTexture"},
    {"shaderclipmode", "PSCompareMode"},
    {"shaderprog", "PSTextureModes"},
    {"shaderctl", "PSInputTexture"},
    {"other_stage_input", "PSInputTexture"},
};

}  // namespace

std::string_view find_other_word(std::string_view name) {
  const std::string bare = bare_name(name);
  for (const std::string_view other : kOtherWordNames) {
    if (bare_name(other) == bare) return other;
  }
  for (const OtherAlias& alias : kOtherAliases) {
    if (alias.bare == bare) return alias.name;
  }
  return {};
}

bool OtherWords::take(const RegisterWord& word, ChipClass chip, TextFaults& faults) {
  const std::string_view name = find_other_word(word.name);
  if (name.empty()) return false;
  const auto before =
      std::find_if(found.begin(), found.end(), [&](const RegisterWord& other) { return other.name == name; });
  if (chip == ChipClass::nv10) {
    faults.add(word.place, word.name + " is a word of NV20, not of NV10");
  } else if (before != found.end()) {
    faults.add(word.place, before->name + " was given before, in line " + std::to_string(before->place.line));
  } else {
    const std::string bare = bare_name(word.name);
    // SHADERCTL holds two words; xemu's PshState has it as other_stage_input.
    const bool holds_two = bare == "shaderctl" || bare == "other_stage_input";
    constexpr std::uint32_t kDotMapping = 0xfff;
    found.push_back({std::string(name), holds_two ? word.value & ~kDotMapping : word.value, word.place});
    if (holds_two) found.push_back({"PSDotMapping", word.value & kDotMapping, word.place});
  }
  return true;
}

}  // namespace ninebit::words
