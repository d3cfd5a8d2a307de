// Reads pictures as textures with OpenImageIO.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <utility>

#include "src/image/output/faults.h"
#include "src/image/texture/texture_file.h"

namespace ninebit::image_detail {
namespace {

// OpenImageIO's message on one line.
std::string reason(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  return text.empty() ? "the reason is unknown" : text;
}

std::string complain_about_spec(const OIIO::ImageSpec& spec) {
  if (spec.deep) return "is a deep picture; expected one sample per pixel";
  if (spec.depth > 1) return "is a volume; expected a picture";
  if (std::string complaint = complain_about_picture_size(spec.width, spec.height); !complaint.empty()) {
    return "the picture " + complaint;
  }
  if (const std::int64_t pixels = std::int64_t{spec.width} * spec.height; pixels > kMostPicturePixels) {
    return fmt::format("the picture has {} pixels; at most {} are read", pixels, kMostPicturePixels);
  }
  if (spec.nchannels < 1 || spec.nchannels > 4) {
    return fmt::format("has {} channels; expected 1 to 4", spec.nchannels);
  }
  return {};
}

bool has_floats(const OIIO::ImageSpec& spec) {
  return spec.format.is_floating_point();
}

// The channels of a picture with `count` channels that become red, green, blue and alpha; -1: none.
std::array<int, 4> channels_of(int count) {
  switch (count) {
    case 1:
      return {0, 0, 0, -1};
    case 2:
      return {0, 0, 0, 1};
    case 3:
      return {0, 1, 2, -1};
    default:
      return {0, 1, 2, 3};
  }
}

// The interleaved samples of the picture. Reports OpenImageIO's message.
template <class T>
Result<std::vector<T>> read_samples(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                                    std::size_t pixels) {
  std::vector<T> samples(pixels * static_cast<std::size_t>(spec.nchannels));
  if (!input.read_image(0, 0, 0, spec.nchannels, type, samples.data())) {
    return Diagnostic{"could not be read to its end: " + reason(input.geterror())};
  }
  return samples;
}

// The planes that the format stores.
template <class T>
std::vector<T> planes_of(const std::vector<T>& interleaved, InternalFormat format, int channels, std::size_t pixels,
                         T opaque) {
  const std::array<bool, 4> stored = stored_components(format);
  const std::array<int, 4> source = channels_of(channels);
  std::vector<T> planes;
  planes.reserve(pixels * static_cast<std::size_t>(std::count(stored.begin(), stored.end(), true)));
  for (std::size_t k = 0; k < 4; ++k) {
    if (!stored[k]) continue;
    for (std::size_t i = 0; i < pixels; ++i) {
      planes.push_back(source[k] < 0
                           ? opaque
                           : interleaved[i * static_cast<std::size_t>(channels) + static_cast<std::size_t>(source[k])]);
    }
  }
  return planes;
}

Result<FileTexture> read_opened(OIIO::ImageInput& input) {
  const OIIO::ImageSpec spec = input.spec();
  if (std::string complaint = complain_about_spec(spec); !complaint.empty()) return Diagnostic{std::move(complaint)};
  const std::size_t pixels = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  FileTexture texture;
  TextureSamples image{spec.width, spec.height};
  if (has_floats(spec)) {
    texture.format = InternalFormat::rgba32f;
    const auto samples = read_samples<float>(input, spec, OIIO::TypeDesc::FLOAT, pixels);
    if (!samples) return samples.error();
    image.samples = planes_of(*samples, texture.format, spec.nchannels, pixels, 1.0F);
  } else {
    constexpr std::array formats{InternalFormat::luminance8, InternalFormat::luminance8_alpha8, InternalFormat::rgb8,
                                 InternalFormat::rgba8};
    texture.format = formats[static_cast<std::size_t>(spec.nchannels - 1)];
    const auto samples = read_samples<std::uint8_t>(input, spec, OIIO::TypeDesc::UINT8, pixels);
    if (!samples) return samples.error();
    image.samples = planes_of(*samples, texture.format, spec.nchannels, pixels, std::uint8_t{255});
  }
  texture.faces.emplace_back().push_back(std::move(image));
  return texture;
}

// A reader of the bytes, which `memory` then refers to; nullptr if there is none or it refuses them.
std::unique_ptr<OIIO::ImageInput> open_bytes(std::span<const std::uint8_t> bytes, const OIIO::ImageSpec& wishes,
                                             std::optional<OIIO::Filesystem::IOMemReader>& memory, std::string& why) {
  const char* const extension = extension_of_bytes(bytes);
  if (extension == nullptr) return nullptr;
  // The name selects the reader; no file of this name is opened.
  const std::string name(extension + 1);
  std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(name);
  if (!input || input->supports("ioproxy") == 0) return nullptr;
  memory.emplace(bytes.data(), bytes.size());
  OIIO::ImageSpec config = wishes;
  void* const proxy = &*memory;
  config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  OIIO::ImageSpec found;
  if (input->open(name, found, config)) return input;
  why = input->geterror();
  return nullptr;
}

}  // namespace

Result<FileTexture> read_picture(const PictureSource& source) {
  const std::filesystem::path& file = source.file;
  try {
    OIIO::ImageSpec wishes;
    wishes.attribute("oiio:UnassociatedAlpha", 1);
    std::optional<OIIO::Filesystem::IOMemReader> memory;
    std::string why;
    const std::unique_ptr<OIIO::ImageInput> input =
        source.bytes ? open_bytes(*source.bytes, wishes, memory, why) : OIIO::ImageInput::open(file.string(), &wishes);
    if (!input && source.bytes && extension_of_bytes(*source.bytes) == nullptr) {
      return invalid_input(file, "is neither a PNG nor a JPEG picture");
    }
    if (!input) return invalid_input(file, "not a readable picture: " + reason(why.empty() ? OIIO::geterror() : why));
    input->threads(1);  // a child process does not have the threads that OpenImageIO started before
    Result<FileTexture> texture = read_opened(*input);
    if (!texture) return invalid_input(file, texture.error().message);
    return texture;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return invalid_input(file, "could not be read: " + reason(error.what()));
  }
}

}  // namespace ninebit::image_detail
