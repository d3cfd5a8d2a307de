// The answers about texts, which need no picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/combiner/program.h"
#include "ninebit/language/program_text.h"
#include "src/playground/request.h"

namespace ninebit::playground {

// {"do": "about"}: what there is to choose from.
[[nodiscard]] Reply about(Request& request);
// {"do": "vocabulary"}: every word of the forms, with help.
[[nodiscard]] Reply vocabulary(Request& request);
// {"do": "read", "text", "profile", "name", "files", "choice"}: what is wrong with a program, and what it computes;
// what there is to choose in it.
[[nodiscard]] Reply read_text(Request& request);
// {"do": "convert", "text", "profile", "to", "name", "files", "choice"}.
[[nodiscard]] Reply convert_text(Request& request);
// {"do": "trace", "text", "profile", "registers", "name"}.
[[nodiscard]] Reply trace_text(Request& request);

// {"do": "evaluate", "text", "profile", "pictures", "registers"}: the colours of the pictures in the buffer, as bytes.
[[nodiscard]] Reply evaluate_pictures(Request& request, std::span<const std::uint8_t> buffer,
                                      std::vector<std::uint8_t>& bytes);

// {"do": "profile", "profile"}: its fields, as `about` lists them for shipped profiles.
[[nodiscard]] Reply list_profile(Request& request);
// {"do": "edit_profile", "profile", "field", "value"}: the profile with that field changed and the fields that depend
// on it, which "coupled" names.
[[nodiscard]] Reply edit_profile(Request& request);

// The name of an effect's program: its file and, of FILE#N, the number N of a program of a source or a log.
struct NumberedName {
  std::string_view file;
  std::optional<std::size_t> number{};
};
// Takes "#N" from the end of a name, unless there is a text of the whole name. The view is of `name`.
[[nodiscard]] NumberedName numbered_name(std::string_view name, const FileTexts& texts);

// The form that a text is read as: one that looks like calls and is read with a choice is a source.
[[nodiscard]] ProgramForm form_to_read(std::string_view text, const SourceSelection& choice);
// A program that the profile accepts, or every fault of its text. It includes texts of `others` by their names beside
// its own. The functions of a choice are for sources, its definitions for pixel shaders, too: other forms with some are
// faults.
[[nodiscard]] Parsed<TextProgram> valid_program(const SourceText& source, const HardwareProfile& profile,
                                                const FileTexts& others = {}, SourceSelection choice = {});
// Reads the text of `others` that stands below the folder of the file `beside`; `others` must outlive it.
[[nodiscard]] SourceInclude include_from(const FileTexts& others, std::string_view beside);

// scenes/index_room.gltf, embedded at build time.

extern const std::string_view kRoomText;

}  // namespace ninebit::playground
