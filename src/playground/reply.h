// An answer of the playground's engine: one JSON object, or a fault with its place.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "ninebit/language/source_text.h"
#include "ninebit/numerics/result.h"

namespace ninebit::playground {

using Json = nlohmann::ordered_json;

// The members of an answer, or its faults.
using Reply = Parsed<Json>;

// A text on one line. Invalid UTF-8 is replaced with U+FFFD.
[[nodiscard]] std::string text_of(const Json& object);
// The same; of faults {"fault": {"message", "file", "line", "column", "others"}}, with the members that are known.
[[nodiscard]] std::string text_of(const Reply& reply);

// A refusal. `file` says which text the place is in: "request", "effect", "profile" or the name of a file.
[[nodiscard]] Reply refusal(std::string message, std::string file = {}, TextPlace place = {0, 0});
[[nodiscard]] Reply refusal(const Diagnostic& fault);
// Refusals of a text, with their columns as for_page() counts them.
[[nodiscard]] Reply refusals(std::vector<TextFault> faults, std::string_view text);

// The column of a place, counted in UTF-16 units as JavaScript does, where the parsers count bytes.
[[nodiscard]] int utf16_column(std::string_view text, int line, int column);
// The number of UTF-16 units of UTF-8 bytes.
[[nodiscard]] int utf16_length(std::string_view bytes);
// A line of a text, from 1, without its end; empty if there is no such line.
[[nodiscard]] std::string_view line_of(std::string_view text, int line);

}  // namespace ninebit::playground
