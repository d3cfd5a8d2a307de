#include "ninebit/effect/effect_files.h"

#include <fstream>
#include <system_error>
#include <utility>

#include "ninebit/combiner/validate.h"
#include "ninebit/language/program_text.h"
#include "ninebit/scene/scene_io.h"

namespace ninebit {
namespace {

Diagnostic fault_of(const std::filesystem::path& file, std::string message) {
  return {.message = std::move(message), .file = file.string()};
}

Result<CombinerState> program_in(const std::filesystem::path& file, const HardwareProfile& profile) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return fault_of(file, "is not a file; expected a program");
  std::ifstream in(file, std::ios::binary);
  std::string text(kMaxSourceBytes + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!in.eof() || in.bad()) return fault_of(file, "cannot be read, or is too long for a program");
  text.resize(static_cast<std::size_t>(in.gcount()));
  const std::string name = file.string();
  auto parsed = parse_program({text, name}, form_of(text), profile);
  if (!parsed) {
    const TextFault& first = parsed.faults()[0];
    return Diagnostic{.message = first.message, .file = name, .line = first.line};
  }
  const auto refused = validate(parsed->state, profile);
  if (!refused.empty()) return fault_of(file, refused[0].message);
  return parsed->state;
}

}  // namespace

EffectReaders file_readers(TextureFilesReader textures) {
  EffectReaders readers;
  readers.program = &program_in;
  readers.texture = std::move(textures);
  readers.scene = [](const std::filesystem::path& file, std::optional<UpAxis> up) {
    return read_scene(file, {.up = up, .isolated = true});
  };
  return readers;
}

}  // namespace ninebit
