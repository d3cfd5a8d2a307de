#include "src/image/texture/picture_loader.h"

#include <fmt/format.h>

#include <string_view>
#include <system_error>
#include <utility>

#include "src/image/output/faults.h"
#include "src/image/texture/picture_module.h"
#include "src/system/process.h"

namespace ninebit::image_detail {
namespace {

namespace fs = std::filesystem;

fs::path given_folder;  // empty: none

Result<fs::path> find_module() {
  std::error_code error;
  if (!given_folder.empty()) {
    const fs::path given = given_folder / kPictureModuleFile;
    if (fs::exists(given, error)) return given;
    return Diagnostic{
        fmt::format("the module that reads pictures other than DDS is missing: {} does not exist", given.string())};
  }
  const fs::path program = fs::read_symlink(posix::program_file(), error);
  if (error) {
    return Diagnostic{fmt::format("the path of the program is unknown, so {} cannot be found: {}", kPictureModuleFile,
                                  error.message())};
  }
  const fs::path folder = program.parent_path();
  const fs::path beside = folder / kPictureModuleFile;
  const fs::path installed = folder.parent_path() / "lib/ninebit" / kPictureModuleFile;
  if (fs::exists(beside, error)) return beside;
  if (fs::exists(installed, error)) return installed;
  return Diagnostic{fmt::format("the module that reads pictures other than DDS is missing: neither {} nor {} exists",
                                beside.string(), installed.string())};
}

struct PictureModule {
  PictureModuleRead read;
};

// It stays loaded until the program ends.
Result<PictureModule> load_module() {
  const auto path = find_module();
  if (!path) return path.error();
  void* const module = posix::load_library(*path);
  if (module == nullptr) {
    return Diagnostic{fmt::format("the module {}, which reads pictures other than DDS, cannot be loaded: {}",
                                  path->string(), posix::library_error())};
  }
  const auto build = reinterpret_cast<const char* (*)()>(posix::find_symbol(module, kPictureBuildSymbol));
  const auto read = reinterpret_cast<PictureModuleRead>(posix::find_symbol(module, kPictureReadSymbol));
  if (build == nullptr || read == nullptr || std::string_view(build()) != kPictureModuleBuild) {
    return Diagnostic{fmt::format("the module {} belongs to another build of the program; expected {}", path->string(),
                                  kPictureModuleBuild)};
  }
  return PictureModule{read};
}

const Result<PictureModule>& the_module() {
  static const Result<PictureModule> module = load_module();
  return module;
}

}  // namespace

void set_picture_folder(fs::path folder) {
  given_folder = std::move(folder);
}

Result<std::shared_ptr<void>> load_picture_module(const std::filesystem::path& file) {
  const Result<PictureModule>& pictures = the_module();
  if (!pictures) return invalid_input(file, "cannot be read: " + pictures.error().message);
  return std::shared_ptr<void>();
}

Result<FileTexture> load_picture(const PictureSource& source) {
  if (const auto loaded = load_picture_module(source.file); !loaded) return loaded.error();
  Result<FileTexture> texture = FileTexture{};
  the_module()->read(source, texture);
  return texture;
}

}  // namespace ninebit::image_detail
