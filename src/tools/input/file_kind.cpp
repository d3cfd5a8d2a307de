#include "src/tools/input/file_kind.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "ninebit/language/pixel_shader.h"
#include "ninebit/language/program_text.h"
#include "src/system/stream.h"

namespace ninebit::tools {
namespace {

using namespace std::string_view_literals;

constexpr std::size_t kLookedAt = std::size_t{1} << 16;  // bytes of a text that are searched for words

struct Beginning {
  std::string_view bytes, kind;
};

// Kinds that are recognized by their first bytes.
constexpr std::array kBeginnings{
    Beginning{"\x89PNG\r\n\x1A\n"sv, "a PNG picture"},
    Beginning{"\xFF\xD8\xFF"sv, "a JPEG picture"},
    Beginning{"GIF87a"sv, "a GIF picture"},
    Beginning{"GIF89a"sv, "a GIF picture"},
    Beginning{"\x76\x2F\x31\x01"sv, "an OpenEXR picture"},
    Beginning{"DDS \x7C\0\0\0"sv, "a DDS texture"},
    Beginning{"II*\0"sv, "a TIFF picture"},
    Beginning{"MM\0*"sv, "a TIFF picture"},
    Beginning{"\x01\xDA"sv, "an SGI picture"},
    Beginning{"#?RADIANCE"sv, "a Radiance picture"},
    Beginning{"PK\x03\x04"sv, "a ZIP archive"},
    Beginning{"\x1F\x8B"sv, "a gzip file"},
    Beginning{"\x7F"
              "ELF"sv,
              "a program or library (ELF)"},
    Beginning{"glTF\x02\0\0\0"sv, "a binary glTF scene"},
    Beginning{"glTF\x01\0\0\0"sv, "a binary glTF scene"},
    Beginning{"PXR-USDC"sv, "a USD scene"},
    Beginning{"#usda"sv, "a USD scene"},
    Beginning{"ply\n"sv, "a PLY mesh"},
    Beginning{"ply\r"sv, "a PLY mesh"},
    Beginning{"OFF\n"sv, "an OFF mesh"},
    Beginning{"OFF\r"sv, "an OFF mesh"},
    Beginning{"OFF "sv, "an OFF mesh"},
    Beginning{"solid "sv, "an STL mesh"},
    Beginning{"Kaydara FBX Binary"sv, "an FBX scene"},
    Beginning{"; FBX "sv, "an FBX scene"},
    Beginning{"\xFF\xFE"sv, "a text in UTF-16"},
    Beginning{"\xFE\xFF"sv, "a text in UTF-16"},
    Beginning{"<!DOCTYPE html"sv, "an HTML page"},
    Beginning{"<!doctype html"sv, "an HTML page"},
    Beginning{"<html"sv, "an HTML page"},
};

std::string kind_of(ProgramForm form) {
  return std::string(form_row(form).kind);
}

bool has(std::string_view text, std::string_view word) {
  return text.find(word) != std::string_view::npos;
}

std::string_view first_line(std::string_view text) {
  text = text.substr(0, text.find('\n'));
  if (text.ends_with('\r')) text.remove_suffix(1);
  return text;
}

std::string kind_of_bytes(std::string_view bytes) {
  for (const auto& [beginning, kind] : kBeginnings) {
    if (bytes.starts_with(beginning)) return std::string(kind);
  }
  if (bytes.starts_with("RIFF") && bytes.substr(std::min<std::size_t>(8, bytes.size())).starts_with("WEBP")) {
    return "a WebP picture";
  }
  // 3DS: the main chunk, its length, then the chunk of the version or of the scene.
  const std::string_view second = bytes.size() < 8 ? ""sv : bytes.substr(6, 2);
  if (bytes.starts_with("MM") && (second == "\x02\0"sv || second == "\x3D\x3D"sv)) return "a 3DS scene";
  if (bytes.starts_with("<?xml") || bytes.starts_with("<COLLADA")) {
    return has(bytes.substr(0, kLookedAt), "<COLLADA") ? "a COLLADA scene" : "an XML file";
  }
  const bool binary = has(bytes.substr(0, kLookedAt), "\0"sv);
  if (binary && bytes.starts_with("BM")) return "a BMP picture";
  if (binary && bytes.starts_with("MZ")) return "a program or library (Windows)";
  if (bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6' &&
      (bytes[2] == '\n' || bytes[2] == ' ')) {
    return "a PNM picture";
  }
  return binary ? std::string(kBinaryKind) : "";
}

std::string kind_of_script(std::string_view line) {
  if (has(line, "python")) return "a Python script";
  return has(line, "sh") ? "a shell script" : "a script";
}

std::string kind_of_json(std::string_view text) {
  const std::string_view said = json_kind(text);
  if (said == "program") return kind_of(ProgramForm::json);
  if (said == "register_words") return kind_of(ProgramForm::words_json);
  if (said == "profile") return std::string(kProfileKind);
  if (said == "effect") return std::string(kEffectKind);
  text = text.substr(0, kLookedAt);
  if (has(text, "ninebit study part")) return std::string(kPartKind);
  if (has(text, "\"asset\"") || has(text, "\"bufferViews\"") || has(text, "\"accessors\"")) return "a glTF scene";
  return has(text, "\"RC_") ? kind_of(ProgramForm::words_json) : std::string(kJsonKind);
}

// Whether the first line is a header such as tex0.r,out.a, or has a column `program`.
bool is_table(std::string_view text) {
  bool known = false, several = false;
  for (std::string_view line = first_line(text); !line.empty();) {
    std::string_view field = line.substr(0, line.find(','));
    several = several || field.size() < line.size();
    line.remove_prefix(std::min(line.size(), field.size() + 1));
    field = without_space(field);
    while (field.ends_with(' ')) field.remove_suffix(1);
    if (has(field, " ")) return false;
    const std::size_t dot = field.rfind('.');
    const std::string_view component = dot == std::string_view::npos ? ""sv : field.substr(dot + 1);
    known = known || field == "program" || component == "r" || component == "g" || component == "b" || component == "a";
  }
  return known && (several || !has(first_line(text), " "));
}

// Whether a line of the text starts with `beginning`.
bool has_line(std::string_view text, std::string_view beginning) {
  if (text.starts_with(beginning)) return true;
  for (std::size_t at = 0; (at = text.find(beginning, at)) != std::string_view::npos; ++at) {
    if (at > 0 && text[at - 1] == '\n') return true;
  }
  return false;
}

// Whether the text contains "gl" and a capital letter, as in every GL call.
bool has_gl_call(std::string_view text) {
  for (std::size_t at = 0; (at = text.find("gl", at)) != std::string_view::npos; ++at) {
    const bool inside = at > 0 && std::isalnum(static_cast<unsigned char>(text[at - 1])) != 0;
    if (!inside && at + 2 < text.size() && std::isupper(static_cast<unsigned char>(text[at + 2])) != 0) return true;
  }
  return false;
}

std::string kind_of_text(std::string_view text) {
  if (has_line(text, "```") || has_line(text, "## ") || (text.starts_with("# ") && has(text, "]("))) {
    return "a Markdown page";
  }
  if (has_line(text, "#version")) return "a GLSL shader";
  if (const auto form = detected_form(text)) return kind_of(*form);
  if (has_line(text, "#include") || has_line(text, "#pragma") || has_line(text, "#ifndef")) return "C or C++ source";
  if (has_gl_call(text)) return kind_of(ProgramForm::gl);
  if (has_line(text, "void main") || has_line(text, "int main")) return "C source or a shader";
  if (has_line(text, "import ") || has_line(text, "def ") || has_line(text, "from ")) return "a Python script";
  if ((has_line(text, "v ") && has_line(text, "f ")) || has_line(text, "mtllib ")) return "an OBJ mesh";
  return has_line(text, "newmtl ") ? "a material library of OBJ" : "";
}

bool is_program_kind(std::string_view kind) {
  const auto all = forms();
  return std::any_of(all.begin(), all.end(), [&](const Form& form) { return form.kind == kind; });
}

// The role in which a kind is read, and the sentence that names its reader.
struct KindUse {
  std::optional<FileRole> role;
  std::string_view reader;
};

KindUse use_of(std::string_view kind) {
  if (is_program_kind(kind)) return {FileRole::program, "`ninebit explain` reads it"};
  if (kind.ends_with(" mesh") || kind.ends_with(" scene")) return {FileRole::scene, "`ninebit render` draws it"};
  if (kind.ends_with(" picture") || kind.ends_with(" texture")) {
    return {FileRole::picture, "`ninebit draw` reads it as a texture, with --tex0"};
  }
  if (kind == kEffectKind) return {FileRole::effect, "`ninebit draw` draws it"};
  if (kind == kProfileKind) return {FileRole::profile, "`ninebit profiles` reads it, with --profile"};
  if (kind == kTableKind) return {FileRole::table, "`ninebit eval` reads it, with --inputs"};
  if (kind == kPartKind) return {FileRole::part, "`ninebit study merge` joins it with the other parts"};
  return {};
}

// "GL calls, an !!RC1.0 program, … or a log of register writes".
std::string program_kinds() {
  std::vector<std::string_view> kinds;
  for (const Form& form : forms()) {
    if (form.parse != nullptr) kinds.push_back(form.kind);
  }
  const std::string_view last = kinds.back();
  kinds.pop_back();
  return fmt::format("{} or {}", fmt::join(kinds, ", "), last);
}

std::string expected_of(FileRole role) {
  switch (role) {
    case FileRole::program:
      return "a combiner program: " + program_kinds();
    case FileRole::scene:
      return "a scene: a glTF, OBJ, PLY, OFF, 3DS, STL, COLLADA or FBX file";
    case FileRole::picture:
      return "a picture, such as a PNG, JPEG, EXR or DDS file";
    case FileRole::table:
      return "a table of comma-separated values";
    case FileRole::profile:
      return "a profile as JSON";
    case FileRole::effect:
      return "an effect file";
    case FileRole::part:
      return "a part of a study";
  }
  return "";
}

}  // namespace

std::string kind_of_file(std::string_view bytes) {
  const std::string kind = kind_of_bytes(bytes);
  if (kind.empty() || kind == kBinaryKind) {
    const auto form = detected_form(bytes);
    if (form == ProgramForm::xbox || form == ProgramForm::tokens) return kind_of(*form);
  }
  if (!kind.empty()) return kind;
  if (bytes.starts_with("#!")) return kind_of_script(first_line(bytes));
  const std::string_view text = without_heading(bytes);
  if (text.starts_with("!!") && !text.starts_with("!!RC1.0") && !is_pixel_shader(text)) {
    const std::string_view line = first_line(text);
    const auto is_name = [](unsigned char c) { return std::isalnum(c) != 0 || c == '!' || c == '.'; };
    const auto end = std::find_if_not(line.begin(), line.end(), is_name);
    return "a program in " + std::string(line.begin(), end);
  }
  if (is_json(text)) return kind_of_json(text);
  if (is_table(text)) return std::string(kTableKind);
  return kind_of_text(bytes.substr(0, kLookedAt));
}

std::string wrong_kind(std::string_view kind, FileRole role) {
  const KindUse use = use_of(kind);
  if (kind.empty() || use.role == role) return "";
  // These kinds explain less than the fault itself.
  const bool reads_json = role == FileRole::program || role == FileRole::scene || role == FileRole::profile ||
                          role == FileRole::effect || role == FileRole::part;
  if (kind == kJsonKind && reads_json) return "";
  const bool may_be_binary = role == FileRole::picture || role == FileRole::scene || role == FileRole::part;
  if (kind == kBinaryKind && may_be_binary) return "";
  const bool is_plural = is_program_kind(kind) && !kind.starts_with("a");
  if (is_plural) return fmt::format("these are {}; `ninebit explain` reads them", kind);
  return fmt::format("this is {}; {}", kind,
                     use.reader.empty() ? fmt::format("expected {}", expected_of(role)) : std::string(use.reader));
}

Diagnostic explained_by_kind(Diagnostic fault, const std::string& file, FileRole role) {
  std::error_code error;
  if (fault.fault != Fault::invalid_input) return fault;
  const std::string beginning = posix::read_file(file, kLookedAt, error);
  if (error) return fault;
  std::string message = wrong_kind(kind_of_file(beginning), role);
  return message.empty() ? fault : Diagnostic{.message = std::move(message), .file = file};
}

}  // namespace ninebit::tools
