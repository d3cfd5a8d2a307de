#include "src/frame/surface_groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "ninebit/combiner/program.h"
#include "src/frame/shading.h"
#include "src/raster/texture/texture_level.h"

namespace ninebit {
namespace {

// Each group is drawn by itself.
constexpr std::size_t kMostGroups = 2049;

// The least byte that passes a cutoff; 256: none.
int least_byte(float cutoff) {
  return static_cast<int>(std::ceil(std::clamp(cutoff, 0.0F, 2.0F) * 255.0F));
}

bool same_wraps(const Sampler& a, const Sampler& b) {
  return a.wrap_s == b.wrap_s && a.wrap_t == b.wrap_t;
}

bool same_group(const SurfaceGroup& a, const SurfaceGroup& b) {
  if (a.texture != b.texture || a.least_alpha != b.least_alpha || a.alpha != b.alpha) return false;
  return a.texture == nullptr || (a.sampler.min_filter == b.sampler.min_filter &&
                                  a.sampler.mag_filter == b.sampler.mag_filter && same_wraps(a.sampler, b.sampler));
}

std::shared_ptr<const Texture> white_texture() {
  const auto made = make_texture(TextureTarget::texture_2d, InternalFormat::alpha8,
                                 {{TextureSamples{1, 1, std::vector<std::uint8_t>{255}}}});
  return std::make_shared<const Texture>(*made);
}

Status check_scene_texture(const Material& material, const SceneTexture& from) {
  const Texture& texture = *from.texture;
  if (Status checked = check_texture(texture); !checked) return checked;
  if (texture.target == TextureTarget::texture_2d && is_complete(texture, uses_mipmaps(material.sampler.min_filter)))
    return {};
  return Diagnostic{.message = fmt::format("the texture '{}' of material \"{}\" is not a complete 2D texture",
                                           from.name, material.name)};
}

}  // namespace

Result<SurfaceGroups> SurfaceGroups::make(const Scene& scene, const RenderSettings& settings) {
  SurfaceGroups out;
  out.groups_.emplace_back();
  std::vector<std::uint32_t> of_material(scene.materials.size(), 0);
  std::vector<bool> used(scene.materials.size(), false);
  for (const std::uint32_t m : scene.triangle_material) used[m] = true;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const Material& material = scene.materials[m];
    if (!used[m]) continue;
    const SceneTexture* const from = material.base_texture ? &scene.textures[*material.base_texture] : nullptr;
    const bool loaded = from != nullptr && from->texture && !scene.texture_coordinates.empty();
    if (loaded) {
      if (Status checked = check_scene_texture(material, *from); !checked) return checked.error();
    }
    SurfaceGroup group;
    if (material.alpha_mode == AlphaMode::mask && (from == nullptr || loaded)) {
      const int least = least_byte(material.alpha_cutoff);
      group.alpha = static_cast<std::uint8_t>(std::clamp(material.alpha, 0.0F, 1.0F) * 255.0F + 0.5F);
      // A cutoff above 1: no alpha is large enough, so the product is made 0.
      if (least > 255) group.alpha = 0;
      if (least > 0) group.least_alpha = static_cast<std::uint8_t>(std::min(least, 255));
      if (!group.least_alpha) group.alpha = 255;
    }
    if (loaded && (!settings.cartoon || group.least_alpha)) {
      group.texture = from->texture.get();
      group.sampler = material.sampler;
    } else if (group.least_alpha) {
      if (!out.white_) out.white_ = white_texture();
      group.texture = out.white_.get();
      group.sampler = kNearestSampler;
    }
    const auto known = std::find_if(out.groups_.begin(), out.groups_.end(),
                                    [&](const SurfaceGroup& other) { return same_group(other, group); });
    of_material[m] = static_cast<std::uint32_t>(known - out.groups_.begin());
    if (known == out.groups_.end()) out.groups_.push_back(group);
    if (out.groups_.size() > kMostGroups) {
      return Diagnostic{.message = fmt::format("the materials have more than {} different textures and alpha tests",
                                               kMostGroups - 1)};
    }
  }
  for (SurfaceGroup& group : out.groups_) {
    if (group.texture == nullptr) continue;
    out.masked_ = out.masked_ || group.least_alpha;
    out.textured_ = out.textured_ || !settings.cartoon;
    auto shaded = surface_program(settings.profile, SurfaceColor::primary_times_texture, group.alpha);
    if (!shaded) return shaded.error();
    group.shaded = std::move(*shaded);
    auto masked = surface_program(settings.profile, SurfaceColor::primary, group.alpha);
    if (!masked) return masked.error();
    group.masked = std::move(*masked);
  }
  if (out.groups_.size() > 1) {
    for (const std::uint32_t m : scene.triangle_material) out.group_of_.push_back(of_material[m]);
    for (const std::uint32_t g : out.group_of_) ++out.groups_[g].triangles;
    // A scene without texture coordinates may still have masks.
    out.coordinates_.assign(scene.positions.size(), glm::vec3(0.0F));
    for (std::size_t i = 0; i < scene.texture_coordinates.size(); ++i)
      out.coordinates_[i] = glm::vec3(scene.texture_coordinates[i], 0.0F);
  }
  return out;
}

template <class Take>
TrianglePart SurfaceGroups::select(const Scene& scene, bool numbered, const Take& take) const {
  TrianglePart part;
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    const bool taken = group_of_.empty() || take(group_of_[t]);
    if (!taken && !numbered) continue;
    part.triangles.push_back(taken ? scene.triangles[t] : glm::uvec3(scene.triangles[t].x));
    part.numbers.push_back(static_cast<std::uint32_t>(t));
  }
  return part;
}

TrianglePart SurfaceGroups::part(const Scene& scene, std::size_t group, bool numbered) const {
  return select(scene, numbered, [group](std::uint32_t g) { return g == group; });
}

TrianglePart SurfaceGroups::opaque_part(const Scene& scene, bool numbered) const {
  return select(scene, numbered, [this](std::uint32_t g) { return !groups_[g].least_alpha.has_value(); });
}

PipelineState SurfaceGroups::masked_state(const PipelineState& plain, const SurfaceGroup& group) {
  PipelineState state = plain;
  state.program = group.masked;
  state.alpha_test = {.enabled = true, .function = CompareFunction::gequal, .reference = group.least_alpha.value_or(0)};
  return state;
}

// The frame's alpha stays that of the background, as for plain triangles.
PipelineState SurfaceGroups::shaded_state(const PipelineState& plain, const SurfaceGroup& group) {
  PipelineState state = plain;
  if (!group.shaded) return state;
  state.program = group.shaded;
  state.color_mask[kAlpha] = false;
  if (group.least_alpha) {
    state.alpha_test = {.enabled = true, .function = CompareFunction::gequal, .reference = *group.least_alpha};
  }
  return state;
}

VertexArrays SurfaceAttributes::arrays() const {
  VertexArrays arrays;
  for (std::size_t a = 0; a < values.size(); ++a) arrays.attributes[a] = values[a];
  return arrays;
}

SurfaceAttributes surface_attributes(const Scene& scene, const glm::vec3& color) {
  SurfaceAttributes out;
  for (auto& values : out.values) values.resize(scene.positions.size());
  const std::vector<std::uint32_t> material = vertex_materials(scene);
  for (std::size_t v = 0; v < scene.positions.size(); ++v) {
    out.values[SurfaceAttributes::kPosition][v] = glm::vec4(scene.positions[v], 1.0F);
    out.values[SurfaceAttributes::kNormal][v] = glm::vec4(scene.normals[v], 0.0F);
    out.values[SurfaceAttributes::kColor][v] = glm::vec4(scene.materials[material[v]].base_color * color, 1.0F);
  }
  return out;
}

glm::vec3 unit_or_zero(const glm::vec3& v) {
  const float length = std::sqrt(glm::dot(v, v));
  return length > 0.0F ? v / length : glm::vec3(0.0F);
}

namespace {

using PositionBits = std::array<std::uint32_t, 3>;

PositionBits bits_of_position(const glm::vec3& p) {
  return {std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y), std::bit_cast<std::uint32_t>(p.z)};
}

std::size_t hash_of_bits(const PositionBits& bits) {
  std::uint64_t hash = 0;
  for (const std::uint32_t word : bits) {
    hash = (hash ^ word) * 0x9e3779b97f4a7c15U;
    hash ^= hash >> 29;
  }
  return static_cast<std::size_t>(hash);
}

}  // namespace

WeldedVertices weld_vertices(std::span<const glm::uvec3> triangles, std::span<const glm::vec3> positions) {
  WeldedVertices out;
  out.of_vertex.assign(positions.size(), kNoPlace);
  // An open hash table of vertices, one for each place, at most half full.
  std::vector<std::uint32_t> table(std::bit_ceil(2 * positions.size() + 1), kNoPlace);
  const std::size_t mask = table.size() - 1;
  const auto place_of_vertex = [&](std::uint32_t vertex) {
    const PositionBits bits = bits_of_position(positions[vertex]);
    for (std::size_t at = hash_of_bits(bits) & mask;; at = (at + 1) & mask) {
      if (table[at] == kNoPlace) {
        table[at] = vertex;
        return static_cast<unsigned int>(out.places++);
      }
      if (bits_of_position(positions[table[at]]) == bits) return out.of_vertex[table[at]];
    }
  };
  for (const glm::uvec3& triangle : triangles) {
    for (glm::length_t corner = 0; corner < 3; ++corner) {
      unsigned int& place = out.of_vertex[triangle[corner]];
      if (place == kNoPlace) place = place_of_vertex(triangle[corner]);
    }
  }
  return out;
}

}  // namespace ninebit
