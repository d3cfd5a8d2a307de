// A rendering as files: pictures, and EXR planes for programs.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "ninebit/frame/pictures.h"
#include "ninebit/image/staged_files.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/shadow/technique.h"

namespace NINEBIT_PUBLIC ninebit {

// Writes layers into one EXR file: a part per name and a channel per layer; register codes and halves as half, bytes
// and integers as UINT, floats as FLOAT; upright.
[[nodiscard]] Status write_layers(const std::deque<Layer>& layers, const std::filesystem::path& file);

// Which files of a rendering are written, and how.
struct RenderedFiles {
  std::span<const std::string> only{};  // their names; empty: those that no name is needed for
  int supersample = 1;                  // pictures of the frame are averaged() by this number
};

// Writes color.png, shadow.png, the rendering's own pictures and, where there are indices, index_cube.png. With layers
// also layers.exr and, if the light drew other maps, maps.exr: one part per name and one channel per layer; register
// codes and halves as half, bytes and integers as UINT, floats as FLOAT; upright. With layers, or by its name, also
// index_cube.exr (channels index, UINT, and as half the codes' bytes over 255: R G B, or Y for a luminance, and A for
// an alpha).
[[nodiscard]] Status write_rendering(const Rendering& rendering, StagedFiles& files, const RenderedFiles& chosen = {});

// All files of a rendering, or those that write_rendering writes without names.
enum class NamedFiles : std::uint8_t { all, unasked };

// Their names, in the order in which write_rendering writes them.
[[nodiscard]] std::vector<std::string> file_names(const Rendering& rendering, NamedFiles which);

}  // namespace ninebit
