#include "src/tools/common/cookie_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>
#include <vector>

#include "src/image/texture/picture_loader.h"
#include "src/tools/input/file_kind.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {
namespace {

std::vector<std::filesystem::path> files_of(const std::string& text) {
  std::vector<std::filesystem::path> files;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    files.emplace_back(text.substr(start, end - start));
    start = end + 1;
  }
  return files;
}

}  // namespace

std::string check_cookie(const std::string& text) {
  const auto files = files_of(text);
  const bool nameless = std::any_of(files.begin(), files.end(), [](const auto& file) { return file.empty(); });
  if (!nameless && (files.size() == 1 || files.size() == 6)) return {};
  return fmt::format("'{}' names {} file{}{}; expected one DDS file, or six pictures +X,-X,+Y,-Y,+Z,-Z", text,
                     files.size(), files.size() == 1 ? "" : "s", nameless ? ", one of them empty" : "");
}

Result<std::shared_ptr<const Texture>> read_cookie(const HardwareProfile& profile, const std::string& text) {
  const auto files = files_of(text);
  const TextureReadOptions options{.isolated = true, .go_on = [] { return !ProgressLine::stopped(); }};
  auto read = [&] {
    if (files.size() == 1) return image_detail::read_texture(profile, files[0], options, image_detail::kPictureModule);
    std::array<std::filesystem::path, 6> faces;
    std::copy(files.begin(), files.end(), faces.begin());
    return image_detail::read_cube_texture(profile, faces, options, image_detail::kPictureModule);
  }();
  if (!read) return explained_by_kind(read.error(), read.error().file, FileRole::picture);
  if (read->target != TextureTarget::cube_map) {
    return Diagnostic{
        .message = "is a 2D texture; expected a cube map, a DDS file of six faces or six pictures +X,-X,+Y,-Y,+Z,-Z",
        .file = files[0].string()};
  }
  return std::shared_ptr<const Texture>(std::make_shared<Texture>(std::move(read).value()));
}

}  // namespace ninebit::tools
