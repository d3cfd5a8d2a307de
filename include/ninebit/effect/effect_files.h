// Reading the files of effects.
#pragma once

#include <filesystem>
#include <functional>
#include <span>

#include "ninebit/effect/effect_renderer.h"
#include "ninebit/image/texture_io.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// Reads one 2D texture or cube map from a file, or a cube map from six.
using TextureFilesReader =
    std::function<Result<Texture>(std::span<const std::filesystem::path> files, const HardwareProfile& profile)>;

// Readers of files: programs in any form (program_text.h), textures by `textures`, scenes by read_scene() in a child
// process. A program with faults is reported with the first of them.
[[nodiscard]] EffectReaders file_readers(TextureFilesReader textures);

// The same with read_texture() and read_cube_texture(); a picture of any size is resampled to powers of two, unless it
// is a rectangle.
[[nodiscard]] inline EffectReaders file_readers() {
  EffectReaders readers =
      file_readers([](std::span<const std::filesystem::path> files, const HardwareProfile& profile) {
        if (files.size() == 6) return read_cube_texture(profile, std::span<const std::filesystem::path, 6>(files));
        TextureReadOptions options;
        options.any_size = true;
        return read_texture(profile, files[0], options);
      });
  readers.rectangle = [](const std::filesystem::path& file, const HardwareProfile& profile) {
    TextureReadOptions options;
    options.rectangle = true;
    return read_texture(profile, file, options);
  };
  return readers;
}

}  // namespace ninebit
