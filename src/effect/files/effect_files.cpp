#include "ninebit/effect/effect_files.h"

#include <system_error>
#include <utility>

#include "ninebit/combiner/validate.h"
#include "ninebit/effect/effect_json.h"
#include "ninebit/language/program_text.h"
#include "ninebit/scene/scene_io.h"
#include "src/effect/effect_reader.h"
#include "src/system/inside_folder.h"
#include "src/system/stream.h"

namespace ninebit {
namespace {

Diagnostic fault_of(const std::filesystem::path& file, std::string message) {
  return {.message = std::move(message), .file = file.string()};
}

Result<TextProgram> program_in(const std::filesystem::path& file, const HardwareProfile& profile) {
  std::error_code error;
  const std::string text = posix::read_file(file, kMaxSourceBytes + 1, error);
  if (error) return fault_of(file, "cannot be read: " + error.message());
  if (text.size() > kMaxSourceBytes) return fault_of(file, "is too long for a program");
  const std::string name = file.string();
  auto parsed = parse_program({text, name}, form_of(text), profile);
  if (!parsed) {
    const TextFault& first = parsed.faults()[0];
    return Diagnostic{.message = first.message, .file = name, .line = first.line};
  }
  const auto refused = validate(*parsed, profile);
  if (!refused.empty()) return fault_of(file, refused[0].message);
  return *parsed;
}

}  // namespace

Parsed<Effect> read_effect(const std::filesystem::path& file, const EffectReadOptions& options) {
  const auto unreadable = [&](std::string message) {
    return Parsed<Effect>(std::vector{TextFault{.file = file.string(), .message = std::move(message)}});
  };
  std::error_code error;
  const std::string text = posix::read_file(file, kMaxSourceBytes + 1, error);
  if (error == std::errc::is_a_directory) return unreadable("is a folder; expected an effect file");
  if (error) return unreadable("cannot be opened: " + error.message() + "; expected an effect file");
  if (text.empty()) return unreadable("is empty; expected an effect");
  effect_detail::NameCheck check;
  if (!options.allow_outside) {
    check = [folder = file.parent_path()](const std::string& name) { return posix::why_outside(folder, name); };
  }
  const std::string name = file.string();
  Parsed<Effect> parsed = effect_detail::parse_effect({text, name}, check, options.moment);
  if (parsed) parsed->folder = file.parent_path().string();
  return parsed;
}

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
