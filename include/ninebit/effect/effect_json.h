// Effects as JSON text: docs/effect.schema.json describes the format.
#pragma once

#include <filesystem>

#include "ninebit/effect/effect.h"
#include "ninebit/language/source_text.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// Parses an effect and checks it with check_effect. Every fault has its place in the text. The effect's folder stays
// empty.
[[nodiscard]] Parsed<Effect> parse_effect(const SourceText& source);

// Reads an effect file of at most kMaxSourceBytes. The effect's folder is that of the file. A file that cannot be read
// is a fault on line 0.
[[nodiscard]] Parsed<Effect> read_effect(const std::filesystem::path& file);

}  // namespace ninebit
