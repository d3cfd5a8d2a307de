#include "src/tools/draw/draw_sizes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "src/effect/effect_inputs.h"
#include "src/system/stream.h"
#include "src/tools/draw/draw_files.h"
#include "src/tools/input/printable.h"

namespace ninebit::tools {
namespace {

struct Sides {
  int width = 0, height = 0;
};

// A PNG file says it in its first bytes; other files are read.
std::optional<Sides> size_of(const std::filesystem::path& file, const HardwareProfile& profile,
                             const EffectReaders& readers) {
  constexpr std::string_view kPng = "\x89PNG\r\n\x1a\n";
  constexpr std::size_t kWidth = 16, kHeight = 20, kHeader = 24;
  std::error_code error;
  const std::string start = posix::read_file(file, kHeader, error);
  if (!error && start.size() == kHeader && start.starts_with(kPng)) {
    const auto number_at = [&](std::size_t at) {
      std::uint32_t number = 0;
      for (std::size_t i = 0; i < 4; ++i) number = number << 8U | static_cast<unsigned char>(start[at + i]);
      return number;
    };
    const std::uint32_t width = number_at(kWidth), height = number_at(kHeight);
    if (width == 0 || height == 0 || width > kMaxSurfaceSize || height > kMaxSurfaceSize) return std::nullopt;
    return Sides{static_cast<int>(width), static_cast<int>(height)};
  }
  const auto picture = readers.rectangle(file, profile);
  if (!picture) return std::nullopt;
  const TextureImage& image = picture->faces[0][0];
  return Sides{image.width, image.height};
}

bool has_power_of_two(const Sides& size) {
  return std::has_single_bit(static_cast<unsigned>(size.width)) &&
         std::has_single_bit(static_cast<unsigned>(size.height));
}

bool repeats(Wrap wrap) {
  return wrap == Wrap::repeat || wrap == Wrap::mirrored_repeat;
}

// Why a rectangle texture cannot be read so, with the flags that would change it; empty: it can.
std::string why_not_rectangle(const Sampler& sampler, std::size_t unit) {
  std::vector<std::string> reasons, remedies;
  const auto check = [&](bool applies, const char* reason, const std::string& remedy) {
    if (!applies) return;
    reasons.emplace_back(reason);
    remedies.push_back(remedy);
  };
  check(needs_mipmaps(sampler), "its filter reads mip-maps", fmt::format("--filter{} linear", unit));
  check(repeats(sampler.wrap_s) || repeats(sampler.wrap_t), "its wrap repeats",
        fmt::format("--wrap{} clamp-to-edge", unit));
  check(sampler.cylinder_wrap[0] || sampler.cylinder_wrap[1], "it wraps around a cylinder",
        fmt::format("no --cylinder-wrap{}", unit));
  check(sampler.border_texels, "it has border texels", fmt::format("no --border-texels{}", unit));
  if (reasons.empty()) return {};
  return fmt::format("as {}; with {} it keeps its size", fmt::join(reasons, " and "), fmt::join(remedies, " and "));
}

// A picture that is seen as it lies in its file.
bool is_picture(const EffectTexture& texture) {
  return texture.files.size() == 1 && texture.origin != TextureOrigin::one_dimensional &&
         texture.origin != TextureOrigin::volume;
}

// `texel_by_texel`: the drawing has the picture's size, so that the nearest texel is the pixel's own. Coordinates that
// count texels are too coarse for a linear filter to find its centre everywhere. Returns why the picture cannot become
// a rectangle texture; empty: it is one.
std::string become_rectangle(const DrawFlags& flags, std::size_t unit, const Sides& size, bool on_mesh,
                             bool texel_by_texel, EffectUnit& read, EffectTexture& texture) {
  EffectTexture rectangle = parse_texture_source("rectangle:" + texture.files[0]).value();
  rectangle.name = texture.name;
  if (texel_by_texel) (void)parse_filter("nearest", rectangle.sampler);
  set_sampler(flags, unit, rectangle.sampler);
  // A mesh's coordinates may lie outside of the picture, where a 2D texture repeats by default.
  std::string why = why_not_rectangle(on_mesh ? texture.sampler : rectangle.sampler, unit);
  if (!why.empty()) return why;
  texture = std::move(rectangle);
  glm::mat4& matrix = read.coordinates.matrix;
  for (int column = 0; column < 4; ++column) {
    matrix[column][0] *= static_cast<float>(size.width);
    matrix[column][1] *= static_cast<float>(size.height);
  }
  return {};
}

}  // namespace

void keep_sizes(const DrawFlags& flags, const HardwareProfile& profile, const EffectReaders& readers, Effect& effect,
                std::vector<std::string>& warnings) {
  EffectPass& pass = effect.passes[0];
  const bool on_mesh = pass.geometry != EffectGeometry::rectangle;
  struct Odd {
    std::size_t unit = 0;
    Sides size{};
    EffectTexture* texture = nullptr;
  };
  std::vector<Odd> odd;  // pictures whose sides are not powers of two
  bool is_sized = on_mesh || !flags.size.empty();
  for (std::size_t i = 0; i < kEffectUnits; ++i) {
    const auto texture = std::find_if(effect.textures.begin(), effect.textures.end(),
                                      [&](const EffectTexture& t) { return t.name == pass.units[i].texture; });
    if (texture == effect.textures.end() || !is_picture(*texture)) continue;
    const auto size = size_of(texture->files[0], profile, readers);
    if (!size) continue;
    if (!is_sized) {
      effect.width = size->width;
      effect.height = size->height;
      is_sized = true;
    }
    const bool reads_vertices = pass.units[i].coordinates.source != VertexSource::point_sprite;
    if (texture->origin == TextureOrigin::file && reads_vertices && !has_power_of_two(*size)) {
      odd.push_back({i, *size, &*texture});
    }
  }
  if (odd.empty()) return;
  const auto program = readers.program(pass.program, profile);
  if (!program) return;
  for (const Odd& one : odd) {
    const std::string file = one.texture->files[0];
    const bool same = !on_mesh && one.size.width == effect.width && one.size.height == effect.height;
    const std::string why =
        program->texture_shader.enabled
            ? fmt::format(
                  "as the program's texture-shader stages name the kind of texture that they read; with "
                  "rectangle:{} and an operation for rectangle textures it keeps its size",
                  printable(file))
            : become_rectangle(flags, one.unit, one.size, on_mesh, same, pass.units[one.unit], *one.texture);
    if (!why.empty()) warnings.push_back(resampled_text(file, one.size.width, one.size.height) + ", " + why);
  }
}

}  // namespace ninebit::tools
