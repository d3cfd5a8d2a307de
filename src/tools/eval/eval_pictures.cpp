#include "src/tools/eval/eval_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "ninebit/combiner/evaluate_arrays.h"
#include "ninebit/combiner/initial_registers.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/image/texture_io.h"
#include "ninebit/numerics/fixed9.h"
#include "src/combiner/given_registers.h"
#include "src/image/texture/picture_loader.h"
#include "src/tools/input/file_kind.h"
#include "src/tools/input/host.h"
#include "src/tools/input/printable.h"

namespace ninebit::tools {
namespace {

// A picture as the codes of a register: red, green, blue and alpha of each texel, the top row first.
struct PictureCodes {
  int width = 0, height = 0;
  std::vector<s9> codes{};
};

Result<PictureCodes> read_codes(const std::string& file, const HardwareProfile& profile) {
  const TextureReadOptions options{
      .rectangle = true, .isolated = true, .go_on = [] { return !ProgressLine::stopped(); }};
  auto texture = image_detail::read_texture(profile, file, options, image_detail::kPictureModule);
  if (!texture) return explained_by_kind(texture.error(), file, FileRole::picture);
  const TextureImage& image = texture->faces[0][0];
  const auto* const planes = std::get_if<std::array<Plane<const std::uint8_t>, 4>>(&image.planes);
  if (planes == nullptr) {
    return Diagnostic{.message = "has no bytes, but floats; expected a picture of 8 or 16 bits a channel",
                      .file = file};
  }
  PictureCodes out{image.width, image.height, {}};
  out.codes.reserve(4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  const std::array<bool, 4> stored = stored_components(texture->format);
  Texel texel{.format = base_format(texture->format)};
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (std::size_t c = 0; c < 4; ++c) {
        if (stored[c]) texel.value[c] = (*planes)[c].at(x, y);
      }
      const Rgba9 codes = texel_codes(profile, texel);
      out.codes.insert(out.codes.end(), codes.begin(), codes.end());
    }
  }
  return out;
}

void read_register(Register reg, const PictureCodes& picture, FragmentArrays& arrays) {
  constexpr std::ptrdiff_t kStride = 4 * sizeof(s9);
  for (std::size_t c = 0; c < 4; ++c) {
    arrays.input[static_cast<std::size_t>(reg)][c] = {picture.codes.data() + c, kStride, ElementType::code};
  }
}

}  // namespace

Result<Image8> evaluate_pictures(const CombinerState& state, const HardwareProfile& profile, const UnitPictures& files,
                                 const RegisterSettings& set) {
  Program program = normalize(state, profile);
  for (const auto& [column, code] : set.constants) replace_constant(program, column.reg, column.component, code);
  FragmentArrays arrays{.otherwise = set.registers};
  std::array<PictureCodes, 4> pictures;
  std::optional<std::size_t> first;
  for (std::size_t unit = 0; unit < pictures.size(); ++unit) {
    if (files[unit].empty()) continue;
    auto picture = read_codes(files[unit], profile);
    if (!picture) return picture.error();
    pictures[unit] = *std::move(picture);
    if (!first) first = unit;
    const PictureCodes &one = pictures[*first], &other = pictures[unit];
    if (one.width != other.width || one.height != other.height) {
      return Diagnostic{
          .message = fmt::format("is {} x {} in size, and {} is {} x {}; eval reads texel by texel", other.width,
                                 other.height, printable(files[*first]), one.width, one.height),
          .file = files[unit]};
    }
    read_register(texture_register(static_cast<int>(unit)), other, arrays);
  }
  // As for a table, spare0's alpha starts as texture 0's, unless it is set.
  InputArray& spare0_alpha = arrays.input[static_cast<std::size_t>(Register::spare0)][kAlpha];
  const bool is_set = std::find(set.set.begin(), set.set.end(), EvalColumn{Register::spare0, kAlpha}) != set.set.end();
  if (!is_set && *first == 0) spare0_alpha = arrays.input[static_cast<std::size_t>(Register::texture0)][kAlpha];

  Image8 out{pictures[*first].width, pictures[*first].height, 4, {}};
  arrays.count = pictures[*first].codes.size() / 4;
  std::vector<s9> codes(4 * arrays.count);
  for (std::size_t c = 0; c < 4; ++c) arrays.color[c] = {codes.data() + c, 4 * sizeof(s9), ElementType::code};
  const BatchProgram batch(program);
  constexpr std::size_t kPart = std::size_t{1} << 16;
  for (std::size_t begin = 0; begin < arrays.count; begin += kPart) {
    if (ProgressLine::stopped()) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
    evaluate(batch, arrays, begin, std::min(begin + kPart, arrays.count));
  }
  out.pixels.reserve(codes.size());
  for (const s9 code : codes) out.pixels.push_back(to_byte(profile, code));
  return out;
}

}  // namespace ninebit::tools
