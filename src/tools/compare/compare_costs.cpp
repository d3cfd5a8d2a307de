#include "src/tools/compare/compare_costs.h"

#include <string_view>
#include <variant>

namespace ninebit::tools {
namespace {

std::optional<std::uint64_t> counted_fact(const Rendering& rendering, std::string_view name) {
  for (const Fact& fact : rendering.facts) {
    const auto* count = std::get_if<std::uint64_t>(&fact.value);
    if (fact.name == name && count != nullptr) return *count;
  }
  return std::nullopt;
}

std::uint64_t texel_bytes(IndexFormat format) {
  if (format == IndexFormat::rgb) return 4;
  return format == IndexFormat::luminance_alpha ? 2 : 1;
}

std::uint64_t texel_bytes(DepthCubeBits bits) {
  return bits == DepthCubeBits::real ? 4 : bits == DepthCubeBits::sixteen ? 2 : 1;
}

// The passes that all techniques share: depth, lit and shadowed colour.
constexpr std::uint64_t kSharedPasses = 3;
constexpr std::uint64_t kCubeFaces = 6;
// Of a reflective shadow map: depth, and positions, normals and flux of three halves each.
constexpr std::uint64_t kReflectiveTexel = 4 + 3 * 3 * 2;

}  // namespace

TechniqueCosts costs_of(const std::string& technique, const RenderSettings& settings, const Rendering& rendering) {
  const std::uint64_t texels =
      static_cast<std::uint64_t>(settings.map_size) * static_cast<std::uint64_t>(settings.map_size);
  TechniqueCosts costs{.texture_units = std::nullopt, .passes = kSharedPasses};
  const bool indices = technique == "index-cube" || (technique == "light-cookie" && settings.light_cookie.shadows);
  if (indices) {
    costs.texture_units = 1;
    costs.passes += kCubeFaces + 1;
    costs.map_bytes = kCubeFaces * texels * texel_bytes(settings.index.format);
  } else if (technique == "depth-cube") {
    const bool floats = settings.depth_cube.bits == DepthCubeBits::real;
    if (!floats) costs.texture_units = counted_fact(rendering, "texture_units");
    costs.passes += kCubeFaces + (floats ? 1 : counted_fact(rendering, "comparison_passes").value_or(0));
    costs.map_bytes = kCubeFaces * texels * texel_bytes(settings.depth_cube.bits);
  } else if (technique == "shadow-map" || technique == "reflective") {
    costs.texture_units = counted_fact(rendering, "texture_units");
    costs.passes += 2;
    costs.map_bytes = texels * (settings.shadow_map.encoding == DepthEncoding::d16 ? 2 : 4);
    if (technique == "reflective") {
      costs.passes += 3;  // the reflective map, the visible surface, the gathering
      costs.map_bytes += texels * kReflectiveTexel;
    }
  } else if (technique == "shadow-volume") {
    costs.texture_units = 0;
    costs.passes += (settings.shadow_volume.two_sided ? 1 : 2) + 1;  // the volumes, the background
  } else if (technique == "light-cookie") {
    costs.texture_units = 0;
  }
  if (settings.light_facing) costs.passes += 1;
  return costs;
}

}  // namespace ninebit::tools
