#include "src/raster/setup/arrays_check.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <utility>

#include "ninebit/texture_shader/validate_stages.h"
#include "src/raster/setup/primitive_assembly.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

// The least and the greatest size of points and lines, in pixels.
constexpr float kLeastPointSize = 0.0F, kLeastLineWidth = 0.125F, kGreatestSize = 64.0F;

Diagnostic fault(std::string message) {
  return Diagnostic{.message = std::move(message)};
}

// Points and lines have sizes in eighths of a pixel.
Status check_size(const std::string& what, float size, float least) {
  if (size >= least && size <= kGreatestSize && 8.0F * size == std::floor(8.0F * size)) return {};
  return fault(what + ' ' + std::to_string(size) + "; expected " + std::to_string(least) + " to " +
               std::to_string(kGreatestSize) + " in steps of 1/8");
}

// A non-empty array must have one entry for each vertex.
Status check_length(const char* what, std::size_t length, std::size_t vertices) {
  if (length == 0 || length == vertices) return {};
  return fault("there are " + std::to_string(length) + ' ' + what + " for " + std::to_string(vertices) + " vertices");
}

Status check_lengths(const VertexArrays& arrays, std::size_t primitives) {
  const std::size_t vertices = arrays.vertex_count();
  Status s = check_length("vertex colours", arrays.vertex_colors.size(), vertices);
  if (s) s = check_length("secondary colours", arrays.secondary_colors.size(), vertices);
  if (s) s = check_length("fog factors", arrays.fog_factors.size(), vertices);
  for (const auto& coordinates : arrays.texture_coordinates) {
    if (s) s = check_length("texture coordinates of one unit", coordinates.size(), vertices);
  }
  for (const auto& q : arrays.texture_q) {
    if (s) s = check_length("texture coordinates q of one unit", q.size(), vertices);
  }
  for (const auto& attribute : arrays.attributes) {
    if (s) s = check_length("values of one attribute", attribute.size(), vertices);
  }
  if (!s) return s;
  if (!arrays.primitive_colors.empty() && arrays.primitive_colors.size() != primitives) {
    return fault("there are " + std::to_string(arrays.primitive_colors.size()) + " primitive colours for " +
                 std::to_string(primitives) + " primitives");
  }
  if (!arrays.vertex_colors.empty() && !arrays.primitive_colors.empty()) {
    return fault("primary colours are given per vertex and per primitive; expected one of them");
  }
  return {};
}

}  // namespace

Status check_state(const PipelineState& state, const RenderTarget& target) {
  if (state.program && state.program->datapath != datapath_of(state.profile)) {
    return fault("the program was not compiled for profile " + std::string(state.profile.name));
  }
  if (const auto faults = validate(state.texture_shader, state.profile); !faults.empty()) {
    return fault(faults[0].message);
  }
  if (state.profile.subpixel_bits < 0 || state.profile.subpixel_bits > 4) {
    return fault("the rasterizer's integers hold 0 to 4 subpixel bits, not " +
                 std::to_string(state.profile.subpixel_bits.value));
  }
  if (Status s = check_size("points of size", state.point_size, kLeastPointSize); !s) return s;
  if (Status s = check_size("lines of width", state.line_width, kLeastLineWidth); !s) return s;
  if (state.point_sprite.enabled && !state.profile.point_sprites) {
    return fault("profile " + std::string(state.profile.name) + " has no point sprites; disable them");
  }
  if (std::isnan(state.depth_near) || std::isnan(state.depth_far)) return fault("the depth range is not a number");
  if (!std::isfinite(state.polygon_offset.factor) || !std::isfinite(state.polygon_offset.units)) {
    return fault("the polygon offset's factor and units are not both finite");
  }
  if (!std::isfinite(state.fog.bias) || !std::isfinite(state.fog.slope)) {
    return fault("the fog's bias and slope are not both finite");
  }
  if (state.float_depth_one && (!std::isfinite(*state.float_depth_one) || *state.float_depth_one <= 0.0F)) {
    return fault("the number of window depth 1 is " + std::to_string(*state.float_depth_one) +
                 "; expected a finite one above 0");
  }
  if (!state.viewport) return {};
  const PixelRect& v = *state.viewport;
  const bool inside = v.x >= 0 && v.y >= 0 && v.width >= 0 && v.height >= 0 && v.x <= target.width &&
                      v.y <= target.height && v.width <= target.width - v.x && v.height <= target.height - v.y;
  if (inside) return {};
  return fault("the viewport, " + std::to_string(v.width) + "x" + std::to_string(v.height) + " at (" +
               std::to_string(v.x) + ", " + std::to_string(v.y) + "), is not within the target of " +
               std::to_string(target.width) + "x" + std::to_string(target.height));
}

Status check_arrays(const PipelineState& state, const VertexArrays& arrays, std::span<const TextureUnit> units) {
  if (!arrays.positions.empty() && !arrays.homogeneous_positions.empty()) {
    return fault("positions are given with and without w; expected one of them");
  }
  if (arrays.vertex_count() > 0xFFFFFFFF) return fault("one draw call takes at most 4,294,967,295 vertices");
  const std::size_t primitives = PrimitiveAssembly(arrays).primitives();
  if (primitives > 0xFFFFFFFE) return fault("one draw call takes at most 4,294,967,294 primitives");
  if (Status lengths = check_lengths(arrays, primitives); !lengths) return lengths;
  const int available = std::clamp(state.profile.texture_units.value, 0, kMaxTextureUnits);
  if (units.size() > static_cast<std::size_t>(available)) {
    return fault("profile " + std::string(state.profile.name) + " has " + std::to_string(available) +
                 " texture units, not " + std::to_string(units.size()));
  }
  for (std::size_t unit = 0; unit < units.size(); ++unit) {
    if (units[unit].texture == nullptr) continue;
    if (Status checked = check_texture(*units[unit].texture); !checked) {
      return fault("texture unit " + std::to_string(unit) + ": " + checked.error().message);
    }
    const Sampler& sampler = units[unit].sampler;
    if (Status checked = check_sampler(*units[unit].texture, sampler); !checked) {
      return fault("texture unit " + std::to_string(unit) + ": " + checked.error().message);
    }
    const bool is_keyed = sampler.color_key.operation == ColorKeyOperation::kill;
    if (!state.texture_shader.enabled || (!is_keyed && sampler.cylinder_wrap == std::array<bool, 2>{})) continue;
    const TextureOperationInfo& info = info_of(state.texture_shader.stage[unit].operation);
    if (info.target != StageTarget::none && info.input == StageInput::none) continue;
    return fault(
        "texture unit " + std::to_string(unit) + ": " + (is_keyed ? "a killing colour key" : "a cylinder wrap") +
        " needs a texture-shader stage that reads the texture at its own coordinates: what it does to others is "
        "not known");
  }
  return {};
}

Status check_indices(const VertexArrays& arrays) {
  const auto vertices = static_cast<std::uint32_t>(arrays.vertex_count());
  constexpr std::size_t kGrain = 65536;
  const auto are_in_range = [&](std::size_t begin, std::size_t end) {
    // No early exit, and 32 bits: compilers vectorize this loop.
    std::uint32_t beyond = 0;
    const std::uint32_t* const indices = arrays.indices.data();
    for (std::size_t i = begin; i < end; ++i) beyond |= indices[i] >= vertices ? 1U : 0U;
    return beyond == 0;
  };
  std::atomic<bool> in_range = true;
  if (arrays.indices.size() <= kGrain) {
    in_range = are_in_range(0, arrays.indices.size());
  } else {
    parallel_ranges(arrays.indices.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      if (!are_in_range(begin, end)) in_range = false;
    });
  }
  if (in_range) return {};
  return fault("an index is out of range; there are " + std::to_string(vertices) + " vertices");
}

Status check_coordinates(const VertexArrays& arrays, std::size_t unit) {
  if (arrays.texture_coordinates[unit].size() == arrays.vertex_count()) return {};
  return fault("texture unit " + std::to_string(unit) + " has " +
               std::to_string(arrays.texture_coordinates[unit].size()) + " texture coordinates for " +
               std::to_string(arrays.vertex_count()) + " vertices");
}

}  // namespace ninebit
