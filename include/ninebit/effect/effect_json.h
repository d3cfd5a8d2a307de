// Effects as JSON text: docs/effect.schema.json describes the format.
#pragma once

#include <filesystem>

#include "ninebit/effect/effect.h"
#include "ninebit/language/source_text.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// When a picture is drawn. Constants, coordinate matrices, and the camera and light of an effect file may depend on it.
struct EffectMoment {
  double time = 0.0;  // seconds
  int frame = 0;      // its number, from 0
  friend bool operator==(const EffectMoment&, const EffectMoment&) = default;
};

// Parses an effect at a moment and checks it with check_effect. Every fault has its place in the text. The effect's
// folder stays empty; the names of files are not checked.
[[nodiscard]] Parsed<Effect> parse_effect(const SourceText& source, const EffectMoment& moment = {});

// How an effect file is read.
struct EffectReadOptions {
  bool allow_outside = false;  // files that the effect names may be anywhere; otherwise only below its own folder
  EffectMoment moment{};       // when it is drawn
};

// Reads an effect file of at most kMaxSourceBytes. The effect's folder is that of the file. A file that cannot be read
// is a fault on line 0; so that no FIFO is waited for, only regular files are read. Unless options.allow_outside, the
// name of a program, texture or mesh is a fault if it is absolute or an address, has "..", or leads out of the folder
// by a link.
[[nodiscard]] Parsed<Effect> read_effect(const std::filesystem::path& file, const EffectReadOptions& options = {});

}  // namespace ninebit
