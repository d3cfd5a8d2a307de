#include "src/tools/draw/draw_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "ninebit/combiner/validate.h"
#include "ninebit/effect/effect_json.h"
#include "ninebit/scene/scene_io.h"
#include "src/image/texture/picture_loader.h"
#include "src/tools/common/program_file.h"
#include "src/tools/input/file_kind.h"
#include "src/tools/input/printable.h"

namespace ninebit::tools {
namespace {

bool go_on() {
  return !ProgressLine::stopped();
}

Result<TextProgram> read_program(const std::filesystem::path& path, const HardwareProfile& profile,
                                 const std::vector<std::string>& defines, bool allow_outside,
                                 std::vector<std::string>& warnings) {
  const ProgramFlags flags{.file = path.string(), .defines = defines, .allow_outside = allow_outside};
  auto file = read_program_file(flags, profile);
  if (!file) return file.error();
  for (const TextFault& note : file->parsed.notes) warnings.push_back(note.text());
  if (!defines.empty() && !form_row(file->form).takes_definitions) {
    warnings.push_back(fmt::format("{}: --define is ignored; it is for source files and pixel shaders", file->name));
  }
  if (!file->parsed) {
    const TextFault& first = file->parsed.faults()[0];
    for (std::size_t i = 1; i < file->parsed.faults().size(); ++i) (void)report_fault(file->parsed.faults()[i]);
    return Diagnostic{.message = first.message, .file = first.file, .line = first.line};
  }
  const std::vector<StateDiagnostic> refused = validate(*file->parsed, profile);
  if (refused.empty()) return *file->parsed;
  return Diagnostic{.message = fmt::format("{}: {}", name_of(refused[0].gl_error), refused[0].message),
                    .file = file->name};
}

Result<Texture> read_pictures(std::span<const std::filesystem::path> files, const HardwareProfile& profile,
                              std::vector<std::string>& warnings) {
  TextureReadOptions options{.any_size = files.size() == 1, .isolated = true, .go_on = &go_on};
  options.on_resample = [&](int width, int height) {
    const std::string text = resampled_text(files[0], width, height);
    const auto says_it = [&](const std::string& warning) { return warning.starts_with(text); };
    if (std::any_of(warnings.begin(), warnings.end(), says_it)) return;  // and why
    warnings.push_back(fmt::format(
        "{}, as textures of the time have no other sizes but those named 'rectangle:', whose coordinates count "
        "texels",
        text));
  };
  if (files.size() == 1) {
    return image_detail::read_texture(profile, files[0], options, image_detail::kPictureModule);
  }
  std::array<std::filesystem::path, 6> faces;
  std::copy(files.begin(), files.end(), faces.begin());
  return image_detail::read_cube_texture(profile, faces, options, image_detail::kPictureModule);
}

Result<Texture> read_texture_files(std::span<const std::filesystem::path> files, const HardwareProfile& profile,
                                   std::vector<std::string>& warnings) {
  auto texture = read_pictures(files, profile, warnings);
  if (texture) return texture;
  return explained_by_kind(texture.error(), texture.error().file, FileRole::picture);
}

}  // namespace

std::string resampled_text(const std::filesystem::path& file, int width, int height) {
  return fmt::format("{}: {} x {} is resampled to powers of two", printable(file.string()), width, height);
}

Result<const HardwareProfile*> effect_profile(const Effect& effect, const std::string& file,
                                              const HardwareProfile* given) {
  if (given != nullptr || effect.profile.empty()) return given;
  if (const HardwareProfile* const found = find_profile(effect.profile)) return found;
  std::string names;
  for (const HardwareProfile& profile : hardware_profiles()) {
    names += (names.empty() ? "" : ", ") + std::string(profile.name);
  }
  return Diagnostic{
      .message = fmt::format("profile '{}' is unknown; expected one of {}", printable(effect.profile), names),
      .file = file};
}

DrawnFile read_effect_file(const std::string& file, const EffectReadOptions& options) {
  auto opened = EffectFile::open(file);
  if (!opened) return {.exit_code = report(opened.error())};
  if (!opened->is_effect()) return {};
  auto parsed = read_effect(opened->path(), options);
  if (!parsed) return {.exit_code = report(parsed.faults())};
  return {.file = std::move(*opened), .effect = std::move(*parsed)};
}

EffectReaders effect_readers(bool allow_outside, const std::vector<std::string>& defines,
                             std::vector<std::string>& warnings) {
  EffectReaders readers;
  readers.program = [defines, allow_outside, &warnings, known = std::map<std::filesystem::path, Result<TextProgram>>()](
                        const std::filesystem::path& path, const HardwareProfile& profile) mutable {
    const auto found = known.find(path);
    if (found != known.end()) return found->second;
    return known.emplace(path, read_program(path, profile, defines, allow_outside, warnings)).first->second;
  };
  readers.texture = [&warnings](std::span<const std::filesystem::path> files, const HardwareProfile& profile) {
    return read_texture_files(files, profile, warnings);
  };
  readers.rectangle = [known = std::map<std::filesystem::path, Texture>()](
                          const std::filesystem::path& file,
                          const HardwareProfile& profile) mutable -> Result<Texture> {
    if (const auto found = known.find(file); found != known.end()) return found->second;
    TextureReadOptions options{.rectangle = true, .isolated = true, .go_on = &go_on};
    auto texture = image_detail::read_texture(profile, file, options, image_detail::kPictureModule);
    if (!texture) return explained_by_kind(texture.error(), texture.error().file, FileRole::picture);
    return known.emplace(file, std::move(*texture)).first->second;
  };
  readers.scene = [allow_outside, &warnings](const std::filesystem::path& file, std::optional<UpAxis> up) {
    auto scene = read_scene(file, {.allow_outside = allow_outside, .up = up, .isolated = true, .go_on = &go_on});
    if (!scene) scene = explained_by_kind(scene.error(), file.string(), FileRole::scene);
    if (!scene || scene->notes.empty()) return scene;
    std::string ignored;
    for (const std::string& note : scene->notes) ignored += (ignored.empty() ? "" : "; ") + note;
    warnings.push_back(fmt::format("{}: ignored: {}", printable(file.string()), printable(ignored)));
    return scene;
  };
  return readers;
}

}  // namespace ninebit::tools
