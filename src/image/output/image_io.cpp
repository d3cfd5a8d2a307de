#include "ninebit/image/image_io.h"

#include <fmt/format.h>
#include <png.h>

#include <array>
#include <bit>
#include <csetjmp>
#include <cstring>
#include <filesystem>
#include <new>
#include <string>
#include <string_view>
#include <utility>

#include "src/image/output/faults.h"
#include "src/system/checked_file.h"

namespace ninebit {

namespace {

using image_detail::cannot_write;
using image_detail::complain_about_size;
using image_detail::invalid_input;
using posix::CheckedFile;

// With no filters: on flat pictures ×4 as fast as libpng's defaults, and at most a quarter larger.
constexpr int kPngZipLevel = 2;

// Encodes one picture with libpng; the bytes go to `Sink::write`. libpng reports errors by longjmp, which must not
// cross an object with a destructor: only functions without such objects call it.
template <class Sink>
class PngEncoder {
 public:
  explicit PngEncoder(Sink& sink)
      : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, this, &PngEncoder::fail, &PngEncoder::ignore)),
        info_(png_ == nullptr ? nullptr : png_create_info_struct(png_)) {
    if (info_ == nullptr) {
      png_destroy_write_struct(&png_, nullptr);
      throw std::bad_alloc();
    }
    png_set_write_fn(png_, &sink, &PngEncoder::write, &PngEncoder::flush);
  }
  PngEncoder(const PngEncoder&) = delete;
  PngEncoder& operator=(const PngEncoder&) = delete;
  ~PngEncoder() { png_destroy_write_struct(&png_, &info_); }

  // False if libpng failed; see reason(). Throws std::bad_alloc if memory ran out.
  template <class Sample>
  bool encode(const Image<Sample>& image) {
    if (encode_or_jump(image)) return true;
    if (std::string_view(reason()).find("memory") != std::string_view::npos) throw std::bad_alloc();
    return false;
  }

  [[nodiscard]] const char* reason() const { return reason_.data(); }

 private:
  template <class Sample>
  bool encode_or_jump(const Image<Sample>& image) noexcept {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    const int color_type = image.channels == 1   ? PNG_COLOR_TYPE_GRAY
                           : image.channels == 3 ? PNG_COLOR_TYPE_RGB
                                                 : PNG_COLOR_TYPE_RGB_ALPHA;
    png_set_IHDR(png_, info_, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height),
                 8 * sizeof(Sample), color_type, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_compression_level(png_, kPngZipLevel);
    png_set_filter(png_, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
    png_write_info(png_, info_);
    if (sizeof(Sample) == 2 && std::endian::native == std::endian::little) png_set_swap(png_);
    const std::size_t stride = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
    for (std::size_t row = 0; row < static_cast<std::size_t>(image.height); ++row) {
      png_write_row(png_, reinterpret_cast<png_const_bytep>(image.pixels.data() + row * stride));
    }
    png_write_end(png_, nullptr);
    return true;
  }
  [[noreturn]] static void fail(png_structp png, png_const_charp message) {
    auto& reason = static_cast<PngEncoder*>(png_get_error_ptr(png))->reason_;
    std::strncpy(reason.data(), message, reason.size() - 1);
    png_longjmp(png, 1);
  }
  static void ignore(png_structp, png_const_charp) {}  // warnings concern chunks that are not written here
  static void write(png_structp png, png_bytep bytes, std::size_t size) {
    if (!static_cast<Sink*>(png_get_io_ptr(png))->write(bytes, size)) png_error(png, "its bytes cannot be kept");
  }
  static void flush(png_structp) {}

  std::array<char, 128> reason_{};
  png_structp png_;
  png_infop info_;
};

// Stores the bytes in memory. An exception must not cross libpng.
struct TextSink {
  std::string text{};
  bool full = false;
  bool write(const void* bytes, std::size_t size) noexcept try {
    text.append(static_cast<const char*>(bytes), size);
    return true;
  } catch (const std::bad_alloc&) {
    full = true;
    return false;
  }
};

template <class Sample>
Status check(const std::filesystem::path& file, const Image<Sample>& image) {
  if (std::string complaint = complain_about_size(image.width, image.height); !complaint.empty()) {
    return invalid_input(file, "the picture " + complaint);
  }
  if (image.channels != 1 && image.channels != 3 && image.channels != 4) {
    return invalid_input(file, fmt::format("the picture has {} channels; 1, 3 or 4 can be written", image.channels));
  }
  const std::size_t needed = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                             static_cast<std::size_t>(image.channels);
  if (image.pixels.size() != needed) {
    return invalid_input(file,
                         fmt::format("the picture has {} samples; its size requires {}", image.pixels.size(), needed));
  }
  return {};
}

template <class Sample>
Status write_image(const std::filesystem::path& file, const Image<Sample>& image) {
  if (Status status = check(file, image); !status) return status;
  CheckedFile output(file);
  if (!output.failed()) {
    PngEncoder encoder(output);
    // close_written reports errors of the file.
    if (!encoder.encode(image) && !output.failed()) {
      return cannot_write(file, fmt::format("could not be encoded as PNG: {}", encoder.reason()));
    }
  }
  return image_detail::close_written(output);
}

}  // namespace

Status write_png(const std::filesystem::path& file, const Image8& image) {
  return write_image(file, image);
}

Status write_png(const std::filesystem::path& file, const Image16& image) {
  return write_image(file, image);
}

Result<std::string> encode_png(const Image8& image) {
  if (Status status = check({}, image); !status) return status.error();
  TextSink sink;
  PngEncoder encoder(sink);
  if (!encoder.encode(image)) {
    if (sink.full) throw std::bad_alloc();
    return Diagnostic{fmt::format("a picture could not be encoded as PNG: {}", encoder.reason())};
  }
  return std::move(sink.text);
}

}  // namespace ninebit
