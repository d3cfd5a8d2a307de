// Writing pictures. The only room that knows OpenImageIO (PNG) and OpenEXR (EXR).
//
// All planes are row-major, row 0 at the TOP of the picture. Every writer reports an error (Fault::cannot_write, naming
// the file) when the file could not be opened, written to the last byte or closed; it then leaves no complete-looking
// file behind. Callers write to StagedFiles::stage() paths.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "ninebit/numerics/result.h"

namespace ninebit {

// Every side of a picture, a part or a cube face is 1 to 16384; sizes, sample counts and names that do not fit, and
// channels without a function, are reported as Fault::invalid_input, before any file is touched or any row asked for.

// An 8-bit picture, interleaved.
struct Image8 {
  int width = 0;
  int height = 0;
  int channels = 0;                  // 1 grey, 3 RGB, 4 RGBA (alpha not premultiplied)
  std::vector<std::uint8_t> pixels;  // width * height * channels
};

[[nodiscard]] Status write_png(const std::filesystem::path& file, const Image8& image);

// Puts the samples of one row, counted from the top of the part or of the face (t), into `out`, which has the width's
// size and arbitrary content before: it is to be filled entirely, and not to be kept. Called by the thread that called
// the writer, never two at a time. It may throw std::bad_alloc, which the writer passes on, leaving no file behind, and
// nothing else.
using ExrIntegerRow = std::function<void(int row, std::span<std::uint32_t> out)>;  // UINT, stored exactly
using ExrRealRow = std::function<void(int row, std::span<float> out)>;             // stored as half

// One channel of an EXR part. A writer asks for each of its rows once, and holds no more than some dozens of them, so
// that pictures of any size can be converted on their way into the file.
struct ExrChannel {
  std::string name;  // "R", "G", "index", …
  std::variant<ExrIntegerRow, ExrRealRow> rows;
};

struct ExrPart {
  std::string name;  // unique in the file
  int width = 0;
  int height = 0;
  std::vector<ExrChannel> channels;
};

// A multi-part scan-line EXR, ZIP compressed. The display window of all parts is that of the first. Values that half
// cannot hold become its nearest, or infinity. The rows of a channel are asked for from the top down, part after part.
[[nodiscard]] Status write_exr_parts(const std::filesystem::path& file, std::span<const ExrPart> parts);

// Six faces as OpenEXR's own cube environment map (envmap attribute ENVMAP_CUBE, N x 6N, faces +X -X +Y -Y +Z -Z).
// `faces` come in the order and orientation of ARB_texture_cube_map: +X -X +Y -Y +Z -Z, texel (0, 0) first, s to the
// right, t by rows; each has the same channels with rows of `size` samples. The writer turns each face into the
// orientation that OpenEXR's ImfEnvmap defines: a stored pixel holds the texel nearest to its CubeMap::direction
// (OpenEXR puts the outermost pixels on the cube's edges, the extension half a texel inside). The rows of a face are
// asked for in any order.
[[nodiscard]] Status write_exr_cube(const std::filesystem::path& file, int size,
                                    std::span<const std::vector<ExrChannel>, 6> faces);

// The number of threads that compress EXR files, in the whole process (1 or less: the calling thread alone, which is
// also the default). It changes no byte of any file. Not to be called while a file is being written.
void set_image_threads(int threads);

}  // namespace ninebit
