// Reads pictures in a child process, and defines the layout of its answer.
#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <system_error>
#include <type_traits>
#include <utility>
#include <variant>

#include "src/image/output/faults.h"
#include "src/image/texture/texture_file.h"
#include "src/system/isolated_call.h"

namespace ninebit::image_detail {
namespace {

constexpr const char* kWho = "OpenImageIO's reader";
constexpr std::uint64_t kSecond = std::uint64_t{4} << 20U;  // bytes of a file that add one second

// Enough for 2^26 pixels of bytes, or for a large picture of floats. A small file that needs more is hardly a picture.
posix::CallLimits limits_for(std::span<const PictureSource> sources) {
  posix::CallLimits limits{.memory_bytes = std::uint64_t{3} << 29U, .seconds = 8};
  for (const PictureSource& source : sources) {
    std::error_code error;
    const std::uintmax_t size = source.bytes ? source.bytes->size() : std::filesystem::file_size(source.file, error);
    if (error) continue;
    limits.memory_bytes += 64 * size;
    limits.seconds += static_cast<int>(size / kSecond);
  }
  return limits;
}

// The answer for a file: 1, the format and one picture; or 0 and the message of the error.
void write(posix::AnswerWriter& to, const Result<FileTexture>& texture) {
  to.value(std::uint8_t{texture.ok()});
  if (!texture) return to.text(texture.error().message);
  const TextureSamples& image = texture->faces[0][0];
  to.value(static_cast<std::uint8_t>(texture->format));
  to.value(std::array{image.width, image.height});
  std::visit([&](const auto& samples) { to.values(std::span(samples)); }, image.samples);
}

// Reads all samples that the format stores at this size; false if the answer has more or fewer.
template <class T>
bool read_samples(posix::AnswerReader& from, InternalFormat format, TextureSamples& image) {
  const std::array<bool, 4> stored = stored_components(format);
  const auto planes = static_cast<std::uint64_t>(std::count(stored.begin(), stored.end(), true));
  const std::uint64_t pixels = static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
  auto& samples = image.samples.emplace<std::vector<T>>();
  return from.values(samples) && samples.size() == planes * pixels;
}

// One file's answer, checked as untrusted data; empty if it is invalid or incomplete.
std::optional<Result<FileTexture>> read(posix::AnswerReader& from) {
  std::uint8_t good = 0, format = 0;
  if (!from.value(good)) return std::nullopt;
  if (good == 0) {
    std::string message;
    if (!from.text(message)) return std::nullopt;
    return Diagnostic{std::move(message)};
  }
  std::array<int, 2> size{};
  if (!from.value(format) || !from.value(size)) return std::nullopt;
  if (!complain_about_picture_size(size[0], size[1]).empty()) return std::nullopt;
  FileTexture texture;
  TextureSamples image{size[0], size[1]};
  texture.format = static_cast<InternalFormat>(format);
  switch (texture.format) {
    case InternalFormat::luminance8:
    case InternalFormat::luminance8_alpha8:
    case InternalFormat::rgb8:
    case InternalFormat::rgba8:
      if (!read_samples<std::uint8_t>(from, texture.format, image)) return std::nullopt;
      break;
    case InternalFormat::rgba32f:
      if (!read_samples<float>(from, texture.format, image)) return std::nullopt;
      break;
    default:
      return std::nullopt;
  }
  texture.faces.emplace_back().push_back(std::move(image));
  return texture;
}

}  // namespace

Result<std::vector<FileTexture>> read_isolated(std::span<const PictureSource> sources, const PictureReader& reader,
                                               const std::function<bool()>& go_on) {
  std::shared_ptr<void> ready;
  if (reader.prepare != nullptr) {
    auto prepared = reader.prepare(sources[0].file);
    if (!prepared) return prepared.error();
    ready = std::move(prepared).value();
  }
  const posix::CallLimits limits = limits_for(sources);
  const auto work = [&](posix::AnswerWriter& answer) {
    for (const PictureSource& source : sources) write(answer, reader.read(source));
  };
  std::vector<std::filesystem::path> files;
  for (const PictureSource& source : sources) {
    if (!source.bytes) files.push_back(source.file);
  }
  posix::CallResult call = posix::call_isolated(limits, files, work, go_on);
  if (call.end == posix::CallEnd::stopped) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
  std::vector<FileTexture> textures;
  for (const PictureSource& source : sources) {
    const std::filesystem::path& file = source.file;
    std::optional<Result<FileTexture>> texture = read(call.answer);
    if (!texture && call.end == posix::CallEnd::answered)
      return invalid_input(file, std::string(kWho) + " returned no picture");
    // A child that ended early has answered for all files before the one that ended it.
    if (!texture) return invalid_input(file, posix::describe(call.end, limits, kWho));
    if (!*texture) return invalid_input(file, texture->error().message);
    textures.push_back(std::move(*texture).value());
  }
  return textures;
}

}  // namespace ninebit::image_detail
