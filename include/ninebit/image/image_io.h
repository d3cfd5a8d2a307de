// Writing pictures. The only room that knows OpenImageIO (PNG) and OpenEXR (EXR).
//
// All planes are row-major, row 0 at the TOP of the picture. Every writer reports an error (Fault::cannot_write, naming
// the file) when the file could not be opened, written to the last byte or closed; it then leaves no complete-looking
// file behind. Callers write to StagedFiles::stage() paths.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "ninebit/numerics/result.h"

namespace ninebit {

// Every side of a picture, a part or a cube face is 1 to 16384; sizes, sample counts and names that do not fit are
// reported as Fault::invalid_input, before any file is touched.

// An 8-bit picture, interleaved.
struct Image8 {
  int width = 0;
  int height = 0;
  int channels = 0;                  // 1 grey, 3 RGB, 4 RGBA (alpha not premultiplied)
  std::vector<std::uint8_t> pixels;  // width * height * channels
};

[[nodiscard]] Status write_png(const std::filesystem::path& file, const Image8& image);

// One channel of an EXR part. UINT planes are stored exactly; float planes are stored as half.
struct ExrChannel {
  std::string name;                                                              // "R", "G", "index", …
  std::variant<std::span<const std::uint32_t>, std::span<const float>> samples;  // width * height of the part
};

struct ExrPart {
  std::string name;  // unique in the file
  int width = 0;
  int height = 0;
  std::vector<ExrChannel> channels;
};

// A multi-part scan-line EXR, ZIP compressed. The display window of all parts is that of the first. Values that half
// cannot hold become its nearest, or infinity.
[[nodiscard]] Status write_exr_parts(const std::filesystem::path& file, std::span<const ExrPart> parts);

// Six faces as OpenEXR's own cube environment map (envmap attribute ENVMAP_CUBE, N x 6N, faces +X -X +Y -Y +Z -Z).
// `faces` come in the order and orientation of ARB_texture_cube_map: +X -X +Y -Y +Z -Z, texel (0, 0) first, s to the
// right, t by rows; each has the same channels with size * size samples. The writer turns each face into the
// orientation that OpenEXR's ImfEnvmap defines: a stored pixel holds the texel nearest to its CubeMap::direction
// (OpenEXR puts the outermost pixels on the cube's edges, the extension half a texel inside).
[[nodiscard]] Status write_exr_cube(const std::filesystem::path& file, int size,
                                    std::span<const std::vector<ExrChannel>, 6> faces);

// The number of threads that compress EXR files, in the whole process (1 or less: the calling thread alone, which is
// also the default). It changes no byte of any file. Not to be called while a file is being written.
void set_image_threads(int threads);

}  // namespace ninebit
