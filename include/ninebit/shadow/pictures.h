// A rendering as files: pictures, and EXR planes for programs.
#pragma once

#include <deque>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "ninebit/image/image_io.h"
#include "ninebit/image/staged_files.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/shadow/technique.h"

namespace NINEBIT_PUBLIC ninebit {

// The frame's colours, upright.
[[nodiscard]] Image8 color_picture(const Rendering& rendering);

// The stencil buffer: white where it is not 0, in shadow.
[[nodiscard]] Image8 stencil_picture(const Rendering& rendering);

// The index cube map as a cross of 4 × 3 faces (+Y on top, then -X +Z +X -Z, -Y below), texel t = 0 on top as the
// extension's faces have it. Neighbouring indices get far-apart hues; the cleared map is black. Faces above 1,024
// texels a side show only every second, fourth, … texel.
[[nodiscard]] Image8 index_cross_picture(const Rendering& rendering);

// Writes layers into one EXR file: a part per name and a channel per layer; register codes and halves as half, bytes
// and integers as UINT, floats as FLOAT; upright.
[[nodiscard]] Status write_layers(const std::deque<Layer>& layers, const std::filesystem::path& file);

// Which files of a rendering are written, and how.
struct RenderedFiles {
  std::span<const std::string> only{};  // their names; empty: all
  int supersample = 1;                  // pictures of the frame are averaged() by this number
};

// Writes color.png, shadow.png, the rendering's own pictures and, where there are indices, index_cube.png and
// index_cube.exr (channels index, UINT, and as half the codes' bytes over 255: R G B, or Y for a luminance, and A for
// an alpha). With layers also layers.exr and, if the light drew other maps, maps.exr: one part per name and one channel
// per layer; register codes and halves as half, bytes and integers as UINT, floats as FLOAT; upright.
[[nodiscard]] Status write_rendering(const Rendering& rendering, StagedFiles& files, const RenderedFiles& chosen = {});

// The names of the files that write_rendering writes, in its order.
[[nodiscard]] std::vector<std::string> file_names(const Rendering& rendering);

// A picture whose pixels are the means of n × n pixels, each component by itself: (sum + n² / 2) / n², rounded down.
// The sides must be multiples of n. That GeForce 2's antialiasing rounded to nearest is assumed.
[[nodiscard]] Image8 averaged(const Image8& image, int n);

}  // namespace ninebit
