// Plain PNG files, read by libpng alone.
#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstring>
#include <fstream>
#include <memory>
#include <new>
#include <sstream>
#include <utility>

#include "src/image/output/faults.h"
#include "src/image/texture/texture_file.h"
#include "src/system/stream.h"

namespace ninebit::image_detail {
namespace {

constexpr std::size_t kStart = 29;  // the signature, and IHDR to its last field
using Start = std::array<std::uint8_t, kStart>;

Start start_of(const PictureSource& source) {
  Start start{};
  if (source.bytes) {
    std::copy_n(source.bytes->begin(), std::min(source.bytes->size(), kStart), start.begin());
  } else {
    std::error_code error;
    const std::string bytes = posix::read_file(source.file, kStart, error);
    std::copy(bytes.begin(), bytes.end(), start.begin());
  }
  return start;
}

// 0: not a kind that is read here.
int channels_of_type(std::uint8_t color_type) {
  switch (color_type) {
    case PNG_COLOR_TYPE_GRAY:
      return 1;
    case PNG_COLOR_TYPE_GRAY_ALPHA:
      return 2;
    case PNG_COLOR_TYPE_RGB:
      return 3;
    case PNG_COLOR_TYPE_RGB_ALPHA:
      return 4;
    default:
      return 0;
  }
}

struct Header {
  std::int64_t width = 0, height = 0;
  int channels = 0;
};

Header header_of(const Start& start) {
  constexpr std::array<std::uint8_t, 16> kBegin{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n',
                                                0,    0,   0,   13,  'I',  'H',  'D',  'R'};
  if (std::memcmp(start.data(), kBegin.data(), kBegin.size()) != 0 || start[24] != 8) return {};
  const auto number = [&](std::size_t at) {
    return std::int64_t{start[at]} << 24 | start[at + 1] << 16 | start[at + 2] << 8 | start[at + 3];
  };
  return {number(16), number(20), channels_of_type(start[25])};
}

// Decodes one picture with libpng, which reports errors by longjmp: only functions without objects that have
// destructors call it.
class PngDecoder {
 public:
  explicit PngDecoder(std::istream& in)
      : in_(in),
        png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, this, &PngDecoder::fail, &PngDecoder::ignore)),
        info_(png_ == nullptr ? nullptr : png_create_info_struct(png_)) {
    if (info_ == nullptr) {
      png_destroy_read_struct(&png_, nullptr, nullptr);
      throw std::bad_alloc();
    }
    png_set_read_fn(png_, this, &PngDecoder::give);
  }
  PngDecoder(const PngDecoder&) = delete;
  PngDecoder& operator=(const PngDecoder&) = delete;
  ~PngDecoder() { png_destroy_read_struct(&png_, &info_, nullptr); }

  // False if libpng failed, or the picture has a transparent colour, which would be a further channel.
  bool decode(std::span<std::uint8_t> samples, std::size_t rows) noexcept {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_info(png_, info_);
    if (png_get_valid(png_, info_, PNG_INFO_tRNS) != 0) return false;
    const int passes = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    if (png_get_rowbytes(png_, info_) * rows != samples.size()) return false;
    for (int pass = 0; pass < passes; ++pass) {
      for (std::size_t row = 0; row < rows; ++row) {
        png_read_row(png_, samples.data() + row * (samples.size() / rows), nullptr);
      }
    }
    return true;
  }

 private:
  [[noreturn]] static void fail(png_structp png, png_const_charp) { png_longjmp(png, 1); }
  static void ignore(png_structp, png_const_charp) {}
  static void give(png_structp png, png_bytep bytes, std::size_t size) {
    auto& in = static_cast<PngDecoder*>(png_get_io_ptr(png))->in_;
    in.read(reinterpret_cast<char*>(bytes), static_cast<std::streamsize>(size));
    if (!in) png_error(png, "the file ends early");
  }

  std::istream& in_;
  png_structp png_;
  png_infop info_;
};

}  // namespace

bool is_plain_png(const PictureSource& source) {
  return header_of(start_of(source)).channels > 0;
}

Result<FileTexture> read_plain_png(const PictureSource& source) {
  const Header header = header_of(start_of(source));
  const Diagnostic refused = invalid_input(source.file, "is not a plain PNG file");
  const bool fits = complain_about_picture_size(header.width, header.height).empty() &&
                    header.width * header.height <= kMostPicturePixels;
  if (header.channels == 0 || !fits) return refused;
  const auto channels = static_cast<std::size_t>(header.channels);
  const auto pixels = static_cast<std::size_t>(header.width * header.height);
  std::vector<std::uint8_t> samples(pixels * channels), planes(pixels * channels);
  std::unique_ptr<std::istream> in;
  if (source.bytes) {
    in = std::make_unique<std::istringstream>(std::string(source.bytes->begin(), source.bytes->end()));
  } else {
    in = std::make_unique<std::ifstream>(source.file, std::ios::binary);
  }
  if (!PngDecoder(*in).decode(samples, static_cast<std::size_t>(header.height))) return refused;
  for (std::size_t c = 0; c < channels; ++c) {
    for (std::size_t i = 0; i < pixels; ++i) planes[c * pixels + i] = samples[i * channels + c];
  }
  constexpr std::array formats{InternalFormat::luminance8, InternalFormat::luminance8_alpha8, InternalFormat::rgb8,
                               InternalFormat::rgba8};
  FileTexture texture;
  texture.format = formats[channels - 1];
  TextureSamples image{static_cast<int>(header.width), static_cast<int>(header.height)};
  image.samples = std::move(planes);
  texture.faces.emplace_back().push_back(std::move(image));
  return texture;
}

}  // namespace ninebit::image_detail
