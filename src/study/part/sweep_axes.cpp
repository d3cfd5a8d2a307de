#include "src/study/part/sweep_axes.h"

#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <optional>

namespace ninebit {
namespace {

constexpr std::array kSwept{SweptSettings{.technique = "index-cube", .index = true},
                            SweptSettings{.technique = "light-cookie", .index = true},
                            SweptSettings{.technique = "depth-cube", .depth_cube = true},
                            SweptSettings{.technique = "shadow-map", .shadow_map = true},
                            SweptSettings{.technique = "shadow-volume", .map_size = false}};

std::string name_of(DepthCubeBits bits) {
  return bits == DepthCubeBits::eight ? "8" : bits == DepthCubeBits::sixteen ? "16" : "float";
}

std::string name_of(DepthEncoding encoding) {
  if (const DepthPacking* packing = depth_packing(encoding)) return std::string(packing->name);
  return encoding == DepthEncoding::d16 ? "d16" : "d24";
}

// The double of a float's shortest decimal form: 0.1F becomes 0.1.
double decimal(float value) {
  return std::strtod(fmt::format("{}", value).c_str(), nullptr);
}

// A rendering's fact as a row's value; no value if there is none.
StudyValue fact(const Rendering* rendering, std::string_view name) {
  if (rendering == nullptr) return {};
  for (const Fact& f : rendering->facts) {
    if (f.name == name) return std::visit([](const auto& value) { return StudyValue(value); }, f.value);
  }
  return {};
}

}  // namespace

Result<SweptSettings> swept_settings(const Technique& technique, const RenderSettings& settings,
                                     const ShadowGrid& grid) {
  const bool dark = technique.name != "light-cookie" || settings.light_cookie.shadows;
  for (const SweptSettings& known : kSwept) {
    if (known.technique != technique.name || !dark) continue;
    SweptSettings swept = known;
    // Rows without these columns are those of older parts.
    swept.index_order = known.index && (settings.index.order != IndexOrder::file || !grid.index_orders.empty());
    swept.index_scales = known.index && (settings.index.scales != IndexScales::both || !grid.index_scales.empty());
    return swept;
  }
  return Diagnostic{.message = fmt::format("technique {} draws no shadows to compare", technique.name)};
}

Result<std::vector<SweepAxis>> axes_of(const SweptSettings& known, const ShadowGrid& grid) {
  std::vector<SweepAxis> axes;
  std::string unknown;
  const auto add = [&](const char* flag, const std::vector<std::string>& columns, bool knows, const auto& values,
                       auto set) {
    if (values.empty()) return;
    if (!knows) unknown += fmt::format("{}{}", unknown.empty() ? "" : ", ", flag);
    axes.push_back({.flag = flag,
                    .columns = columns,
                    .size = values.size(),
                    .set = [&values, set](RenderSettings& s, std::size_t i) { set(s, values[i]); }});
  };
  add("--map-sizes", {"map_size"}, known.map_size, grid.map_sizes, [](RenderSettings& s, int v) { s.map_size = v; });
  add("--formats", {"index_format"}, known.index, grid.index_formats,
      [](RenderSettings& s, IndexFormat v) { s.index.format = v; });
  add("--scopes", {"index_scope"}, known.index, grid.index_scopes,
      [](RenderSettings& s, IndexScope v) { s.index.scope = v; });
  add("--steps", {"index_step"}, known.index, grid.index_steps, [](RenderSettings& s, int v) { s.index.step = v; });
  add("--orders", {"index_order"}, known.index, grid.index_orders,
      [](RenderSettings& s, IndexOrder v) { s.index.order = v; });
  add("--scales", {"index_scales"}, known.index, grid.index_scales,
      [](RenderSettings& s, IndexScales v) { s.index.scales = v; });
  add("--depth-bits", {"depth_bits"}, known.depth_cube, grid.depth_bits,
      [](RenderSettings& s, DepthCubeBits v) { s.depth_cube.bits = v; });
  add("--biases", {"bias"}, known.depth_cube, grid.biases, [](RenderSettings& s, float v) { s.depth_cube.bias = v; });
  add("--encodings", {"encoding"}, known.shadow_map, grid.encodings,
      [](RenderSettings& s, DepthEncoding v) { s.shadow_map.encoding = v; });
  add("--polygon-offsets", {"polygon_offset_factor", "polygon_offset_units"}, known.shadow_map, grid.polygon_offsets,
      [](RenderSettings& s, const OffsetArguments& v) { s.shadow_map.polygon_offset = v; });
  if (unknown.empty()) return axes;
  return Diagnostic{.message = fmt::format("technique {} does not support {}", known.technique, unknown)};
}

RowFields settings_fields(const SweptSettings& known, const RenderSettings& settings, const Rendering* rendering) {
  RowFields fields;
  const auto real = [&](const std::optional<float>& given, std::string_view name) {
    return given ? StudyValue(decimal(*given)) : fact(rendering, name);
  };
  if (known.map_size) fields.emplace_back("map_size", std::int64_t{settings.map_size});
  if (known.index) {
    fields.emplace_back("index_format", std::string(name_of(settings.index.format)));
    fields.emplace_back("index_scope", std::string(name_of(settings.index.scope)));
    fields.emplace_back("index_step", std::int64_t{settings.index.step});
  }
  if (known.index_order) fields.emplace_back("index_order", std::string(name_of(settings.index.order)));
  if (known.index_scales) fields.emplace_back("index_scales", std::string(name_of(settings.index.scales)));
  if (known.depth_cube) {
    fields.emplace_back("depth_bits", name_of(settings.depth_cube.bits));
    fields.emplace_back("bias", real(settings.depth_cube.bias, "bias"));
  }
  if (known.shadow_map) {
    std::optional<float> factor, units;
    if (const auto& offset = settings.shadow_map.polygon_offset) {
      factor = offset->factor;
      units = offset->units;
    }
    fields.emplace_back("encoding", name_of(settings.shadow_map.encoding));
    fields.emplace_back("polygon_offset_factor", real(factor, "polygon_offset_factor"));
    fields.emplace_back("polygon_offset_units", real(units, "polygon_offset_units"));
  }
  return fields;
}

std::span<const ErrorCause> causes_of(const SweptSettings& known) {
  ShadowEvidence evidence;
  if (known.map_size) evidence.fetched.resize(1);
  if (known.index) evidence.index_of_triangle.resize(1);
  return causes_of(evidence);
}

}  // namespace ninebit
