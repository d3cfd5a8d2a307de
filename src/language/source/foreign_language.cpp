#include "src/language/source/foreign_language.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "src/language/source/source_faults.h"
#include "src/system/lines.h"

namespace ninebit {
namespace {

struct HeaderOfLanguage {
  std::string_view header;  // in lower case; every version begins with it
  std::string_view language;
};
constexpr std::array kHeaders{
    HeaderOfLanguage{"!!arbfp", "an ARB fragment program"},
    HeaderOfLanguage{"!!arbvp", "an ARB vertex program"},
    HeaderOfLanguage{"!!fp", "an NV fragment program"},
    HeaderOfLanguage{"!!fcp", "an NV fragment program"},
    HeaderOfLanguage{"!!nvfp", "an NV fragment program"},
    HeaderOfLanguage{"!!nvvp", "an NV vertex program"},
    HeaderOfLanguage{"!!nvgp", "an NV geometry program"},
    HeaderOfLanguage{"!!nvcp", "an NV compute program"},
    HeaderOfLanguage{"!!vp", "an NV vertex program"},
    HeaderOfLanguage{"!!vsp", "an NV vertex state program"},
    HeaderOfLanguage{"!!vcp", "an NV vertex program"},
    HeaderOfLanguage{"!!atifs", "an ATI fragment shader"},
    HeaderOfLanguage{"!!ts", "an NV texture shader"},
    HeaderOfLanguage{"vs.", "a Direct3D vertex shader"},
    HeaderOfLanguage{"vs_", "a Direct3D vertex shader"},
    HeaderOfLanguage{"xvs", "an Xbox vertex shader"},
    HeaderOfLanguage{"ps.2", "a Direct3D pixel shader of version 2"},
    HeaderOfLanguage{"ps_2", "a Direct3D pixel shader of version 2"},
    HeaderOfLanguage{"ps.3", "a Direct3D pixel shader of version 3"},
    HeaderOfLanguage{"ps_3", "a Direct3D pixel shader of version 3"},
};

bool has_word(std::string_view text, std::string_view word) {
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string_view::npos; at += word.size()) {
    const std::size_t end = at + word.size();
    const bool begins = at == 0 || !detail::is_word(text[at - 1]) || !detail::is_word(word.front());
    const bool ends = end == text.size() || !detail::is_word(text[end]) || !detail::is_word(word.back());
    if (begins && ends) return true;
  }
  return false;
}

bool has_any(std::string_view text, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(), [&](std::string_view word) { return has_word(text, word); });
}

// Skips a comment of Direct3D's assembly; false: there is none.
bool skipped_assembly_comment(std::string_view text, std::size_t& at) {
  if (at >= text.size() || text[at] != ';') return false;
  at = std::min(text.find('\n', at), text.size());
  return true;
}

std::string_view language_of_words(std::string_view text) {
  // A program for OpenGL or Direct3D may hold shaders; its own calls say what it is.
  if (has_any(text,
              {"CombinerInputNV", "CombinerOutputNV", "glCombinerInputNV", "glBegin", "glEnable", "glBindTexture"})) {
    return {};
  }
  if (has_word(text, "#version") || has_any(text, {"gl_FragColor", "gl_FragData", "gl_Position", "gl_TexCoord"})) {
    return "a GLSL shader";
  }
  if (has_any(text, {"TEXUNIT0", "texobj2D", "texobjCUBE", "f3texRECT", "f4texRECT", "h4texRECT", "glstate"})) {
    return "a Cg program";
  }
  const bool semantics = has_any(text, {": COLOR", ":COLOR", ": COLOR0", ":COLOR0", ": SV_Target", ": SV_TARGET",
                                        ": TEXCOORD0", ":TEXCOORD0", ": POSITION"});
  const bool types = has_any(text, {"float4", "float3", "half4", "half3", "fixed4", "fixed3", "float2"});
  if (!semantics || !types) return {};
  const bool effect =
      has_any(text, {"technique", "technique10", "cbuffer", "SamplerState", "sampler_state", "Texture2D"});
  const bool is_cg = has_any(text, {"uniform", "fixed3", "fixed4", "out float4", "out half4"}) && !effect;
  return is_cg ? "a Cg program" : "an HLSL shader";
}

}  // namespace

std::string_view language_of_header(std::string_view header) {
  const auto begins = [&](const HeaderOfLanguage& known) {
    return header.size() > known.header.size() &&
           detail::same_but_case(header.substr(0, known.header.size()), known.header);
  };
  const auto* const found = std::find_if(kHeaders.begin(), kHeaders.end(), begins);
  return found == kHeaders.end() ? std::string_view() : found->language;
}

std::string_view foreign_language(std::string_view text) {
  constexpr std::size_t kLookedAt = std::size_t{1} << 16;
  text = text.substr(0, kLookedAt);
  std::size_t at = mark_size(text);
  // #version begins like a comment of !!RC1.0.
  while (at < text.size() && detail::is_blank(text[at])) ++at;
  if (!text.substr(at).starts_with("#version")) {
    detail::SourceFaults none({text, {}});
    do {
      if (!detail::skip_blanks(text, at, {.hash_comments = true, .heading = {}}, none)) return {};
    } while (skipped_assembly_comment(text, at));
  }
  const std::string_view content = text.substr(at);
  const auto is_header = [](char c) { return detail::is_word(c) || c == '!' || c == '.'; };
  const auto end = std::find_if_not(content.begin(), content.end(), is_header);
  const auto header = content.substr(0, static_cast<std::size_t>(end - content.begin()));
  if (const std::string_view language = language_of_header(header); !language.empty()) return language;
  if (content.starts_with("!!")) return {};
  return language_of_words(text);
}

std::string_view foreign_calls(std::string_view text) {
  struct Part {
    std::string_view part, what;
  };
  constexpr std::array kParts{
      Part{"FragmentOp1ATI(", "code for ATI_fragment_shader"},
      Part{"FragmentOp2ATI(", "code for ATI_fragment_shader"},
      Part{"FragmentOp3ATI(", "code for ATI_fragment_shader"},
      Part{"BeginFragmentShaderATI(", "code for ATI_fragment_shader"},
      Part{"GL_SHADER_OPERATION_NV", "code for NV_texture_shader"},
      Part{"GL_COMBINE_RGB", "code for texture environments"},
      Part{"GL_COMBINE_ALPHA", "code for texture environments"},
      Part{"GL_COMBINE4_NV", "code for texture environments"},
  };
  const auto* const found = std::find_if(
      kParts.begin(), kParts.end(), [&](const Part& known) { return text.find(known.part) != std::string_view::npos; });
  return found == kParts.end() ? std::string_view() : found->what;
}

std::string cannot_run(std::string_view language) {
  return "this is " + std::string(language) + ", which register combiners cannot run";
}

}  // namespace ninebit
