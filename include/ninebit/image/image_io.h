// Writing pictures: PNG, and EXR by OpenEXR. zlib compresses both.
//
// All planes are row-major, row 0 at the TOP of the picture. Every writer reports Fault::cannot_write, with the file's
// name, if the file cannot be opened, written to the last byte or closed; it then leaves no complete-looking file
// behind. An existing file is overwritten; a symbolic link is an error. Callers write to paths of StagedFiles::stage().
//
// A file's bytes do not depend on the number of threads.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "ninebit/numerics/codes.h"
#include "ninebit/numerics/half.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// Every side of a picture, a part or a cube face is 1 to 16384. Invalid sizes, sample counts and names, and channels
// without a function, are reported as Fault::invalid_input before a file is opened or a row is requested.

// A picture of 8 or 16 bits per channel, interleaved.
template <class Sample>
struct Image {
  int width = 0;               // pixels
  int height = 0;              // pixels
  int channels = 0;            // 1 grey, 3 RGB, 4 RGBA (alpha not premultiplied)
  std::vector<Sample> pixels;  // width * height * channels
};
// Samples from 0 to 255, or 65535.
using Image8 = Image<std::uint8_t>;
using Image16 = Image<std::uint16_t>;

// Writes a picture. Reports the errors listed at the top of this file.
[[nodiscard]] Status write_png(const std::filesystem::path& file, const Image8& image);
[[nodiscard]] Status write_png(const std::filesystem::path& file, const Image<std::uint16_t>& image);

// The bytes that write_png would write.
[[nodiscard]] Result<std::string> encode_png(const Image8& image);

// One channel of a picture in memory: `top` is the first sample of the top row; the row below starts `stride` samples
// later. Surfaces store their lowest row first; see upside_down.
struct PicturePlane {
  // Not nullptr.
  std::variant<const std::uint8_t*, const std::uint16_t*, const std::uint32_t*, const s9*, const Half*, const float*>
      top;
  std::ptrdiff_t stride = 0;  // samples; negative if the lowest row is stored first
};

// A plane stored from the lowest row up: the lowest row is at `lowest`, each higher row `stride` samples later.
template <class Sample>
[[nodiscard]] PicturePlane upside_down(const Sample* lowest, std::ptrdiff_t stride, int height) {
  return {lowest + stride * (height - 1), -stride};
}

// Writes 1, 3 or 4 planes as the channels of a picture. All of them must be 8-bit, or all 16-bit.
[[nodiscard]] Status write_png(const std::filesystem::path& file, int width, int height,
                               std::span<const PicturePlane> planes);

// Fills `out`, which is uninitialized and as long as the width, with the samples of one row, counted from the top of
// the part or face (t). It must fill `out` completely and must not keep it. The thread that called the writer calls it,
// never two calls at a time. It may throw only std::bad_alloc; the writer passes it on and leaves no file behind.
using ExrIntegerRow = std::function<void(int row, std::span<std::uint32_t> out)>;  // UINT, stored exactly
using ExrRealRow = std::function<void(int row, std::span<float> out)>;             // stored as half
// The same for HALF, stored exactly.
struct ExrHalfRow {
  std::function<void(int row, std::span<Half> out)> fill{};           // as above
  explicit operator bool() const { return static_cast<bool>(fill); }  // whether there is a function
};
// The same for FLOAT, stored exactly.
struct ExrFloatRow {
  std::function<void(int row, std::span<float> out)> fill{};          // as above
  explicit operator bool() const { return static_cast<bool>(fill); }  // whether there is a function
};

// One channel of an EXR part. A writer requests each row once and holds at most a few dozen rows, so that pictures of
// any size can be converted while they are written.
struct ExrChannel {
  std::string name;  // such as "R", "index"
  // The storage type, and the function that fills a row.
  std::variant<ExrIntegerRow, ExrRealRow, ExrHalfRow, ExrFloatRow> rows;
};

// A plane as a channel that stores each sample exactly: 8, 16 and 32 bits as UINT, register codes and halves as half,
// floats as FLOAT. The samples must outlive the channel and have all rows of the part.
[[nodiscard]] ExrChannel exr_channel(std::string name, const PicturePlane& plane);

// One picture of a multi-part file.
struct ExrPart {
  std::string name;                  // unique in the file
  int width = 0;                     // pixels
  int height = 0;                    // pixels
  std::vector<ExrChannel> channels;  // of any kinds
};

// Writes a multi-part scan-line EXR, ZIP compressed. The display window of all parts is that of the first. Values are
// rounded to the nearest half, or to infinity. Rows are requested from the top down, part after part.
[[nodiscard]] Status write_exr_parts(const std::filesystem::path& file, std::span<const ExrPart> parts);

// Writes six faces as OpenEXR's cube environment map (envmap attribute ENVMAP_CUBE, N x 6N, faces +X -X +Y -Y +Z -Z).
// `faces` have the order and orientation of ARB_texture_cube_map: +X -X +Y -Y +Z -Z, texel (0, 0) first, s to the
// right, t by rows; all have the same channels, with rows of `size` samples. The writer converts each face to the
// orientation of OpenEXR's ImfEnvmap: a stored pixel holds the texel nearest to its direction (OpenEXR puts the
// outermost pixels on the edges of the cube, the extension half a texel inside). The rows of a face are requested in
// any order.
[[nodiscard]] Status write_exr_cube(const std::filesystem::path& file, int size,
                                    std::span<const std::vector<ExrChannel>, 6> faces);

}  // namespace ninebit
