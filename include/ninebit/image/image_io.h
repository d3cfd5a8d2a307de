// Writing pictures: PNG by libpng, EXR by OpenEXR.
//
// All planes are row-major, row 0 at the TOP of the picture. Every writer reports an error (Fault::cannot_write, naming
// the file) when the file could not be opened, written to the last byte or closed; it then leaves no complete-looking
// file behind. A file that exists is emptied first; a symbolic link is an error. Callers write to StagedFiles::stage()
// paths.
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

#include "ninebit/numerics/fixed9.h"
#include "ninebit/numerics/half.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// Every side of a picture, a part or a cube face is 1 to 16384; sizes, sample counts and names that do not fit, and
// channels without a function, are reported as Fault::invalid_input, before any file is touched or any row asked for.

// A picture of 8 or 16 bits a channel, interleaved.
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

// Writes a picture. Reports what the head of this file says.
[[nodiscard]] Status write_png(const std::filesystem::path& file, const Image8& image);
[[nodiscard]] Status write_png(const std::filesystem::path& file, const Image<std::uint16_t>& image);

// The bytes that write_png would write.
[[nodiscard]] Result<std::string> encode_png(const Image8& image);

// Samples in memory, one channel of a picture: `top` is the first sample of the top row, and `stride` samples further
// is the first of the row below. Surfaces hold their lowest row first; see upside_down.
struct SamplePlane {
  // The top row's first sample; not nullptr.
  std::variant<const std::uint8_t*, const std::uint16_t*, const std::uint32_t*, const s9*, const Half*, const float*>
      top;
  std::ptrdiff_t stride = 0;  // samples, negative where rows are stored upward
};

// The plane whose lowest row comes first in memory, at `lowest`, and whose rows follow upward, each `stride` further.
template <class Sample>
[[nodiscard]] SamplePlane upside_down(const Sample* lowest, std::ptrdiff_t stride, int height) {
  return {lowest + stride * (height - 1), -stride};
}

// 1, 3 or 4 planes as the channels of a picture; all of them 8-bit, or all 16-bit.
[[nodiscard]] Status write_png(const std::filesystem::path& file, int width, int height,
                               std::span<const SamplePlane> planes);

// Puts the samples of one row, counted from the top of the part or of the face (t), into `out`, which has the width's
// size and arbitrary content before: it is to be filled entirely, and not to be kept. Called by the thread that called
// the writer, never two at a time. It may throw std::bad_alloc, which the writer passes on, leaving no file behind, and
// nothing else.
using ExrIntegerRow = std::function<void(int row, std::span<std::uint32_t> out)>;  // UINT, stored exactly
using ExrRealRow = std::function<void(int row, std::span<float> out)>;             // stored as half
struct ExrFloatRow {                                                               // FLOAT, stored exactly
  std::function<void(int row, std::span<float> out)> fill{};
  explicit operator bool() const { return static_cast<bool>(fill); }  // whether there is a function
};

// One channel of an EXR part. A writer asks for each of its rows once, and holds no more than some dozens of them, so
// that pictures of any size can be converted on their way into the file.
struct ExrChannel {
  std::string name;                                           // "R", "G", "index", …
  std::variant<ExrIntegerRow, ExrRealRow, ExrFloatRow> rows;  // what the channel is stored as, and who fills it
};

// A plane as a channel, each sample exactly: 8, 16 and 32 bits as UINT, register codes and halves as half, floats as
// FLOAT. The plane's samples must outlive the channel, and hold each row that the part's size asks for.
[[nodiscard]] ExrChannel exr_channel(std::string name, const SamplePlane& plane);

// One picture of a multi-part file.
struct ExrPart {
  std::string name;                  // unique in the file
  int width = 0;                     // pixels
  int height = 0;                    // pixels
  std::vector<ExrChannel> channels;  // of any kinds
};

// A multi-part scan-line EXR, ZIP compressed. The display window of all parts is that of the first. Values that half
// cannot hold become its nearest, or infinity. The rows of a channel are asked for from the top down, part after part.
[[nodiscard]] Status write_exr_parts(const std::filesystem::path& file, std::span<const ExrPart> parts);

// Six faces as OpenEXR's own cube environment map (envmap attribute ENVMAP_CUBE, N x 6N, faces +X -X +Y -Y +Z -Z).
// `faces` come in the order and orientation of ARB_texture_cube_map: +X -X +Y -Y +Z -Z, texel (0, 0) first, s to the
// right, t by rows; each has the same channels with rows of `size` samples. The writer turns each face into the
// orientation that OpenEXR's ImfEnvmap defines: a stored pixel holds the texel nearest to its direction
// (OpenEXR puts the outermost pixels on the cube's edges, the extension half a texel inside). The rows of a face are
// asked for in any order.
[[nodiscard]] Status write_exr_cube(const std::filesystem::path& file, int size,
                                    std::span<const std::vector<ExrChannel>, 6> faces);

// The number of threads that compress EXR files, in the whole process (1 or less: the calling thread alone, which is
// also the default). It changes no byte of any file. Not to be called while a file is being written.
void set_image_threads(int threads);

}  // namespace ninebit
