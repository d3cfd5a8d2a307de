#include "src/raster/fragment/output_planes.h"

#include <type_traits>
#include <variant>

namespace ninebit {
namespace {

template <class T>
inline constexpr bool kIsNumber = std::is_same_v<T, std::uint32_t> || std::is_same_v<T, std::uint16_t>;
template <class T>
inline constexpr bool kIsReal = std::is_same_v<T, float> || std::is_same_v<T, Half>;

bool is_written(const OutputPlane& output, const UncoloredFragment& fragment, const FragmentOutcome& outcome) {
  if (output.owner && output.owner.at(fragment.x, fragment.y) != fragment.primitive) return false;
  return output.time == OutputTime::at_depth_pass ? outcome.depth_passed : outcome.drawn;
}

// A number of the fragment itself: its primitive's number or its depth.
std::uint32_t number_of(const OutputPlane& output, const UncoloredFragment& fragment) {
  return output.source == OutputSource::primitive ? fragment.primitive : fragment.depth;
}

template <class T>
T real_as(float value) {
  if constexpr (std::is_same_v<T, Half>) {
    return half_of(value);
  } else {
    return value;
  }
}

// Writes value(lane) for the fragments that leave something in the plane. The last one at a pixel stays.
template <class T, class Value>
void write_lanes(const OutputPlane& output, const Plane<T>& plane, const BatchResults& results, const Value& value) {
  for (std::size_t i = 0; i < results.fragments.size(); ++i) {
    const UncoloredFragment& fragment = results.fragments[i];
    if (!is_written(output, fragment, results.outcomes[i])) continue;
    plane.at(fragment.x, fragment.y) = value(i);
  }
}

// check_target has checked that the samples fit the source; the other pairs do nothing.
template <class T>
void write_plane(const OutputPlane& output, const Plane<T>& plane, const BatchResults& results) {
  const auto component = static_cast<std::size_t>(output.component);
  switch (output.source) {
    case OutputSource::register_code:
      if constexpr (std::is_same_v<T, s9>) {
        const s9* const codes = (*results.registers)(output.reg, output.component);
        write_lanes(output, plane, results, [&](std::size_t i) { return codes[i]; });
      }
      break;
    case OutputSource::output_code:
      if constexpr (std::is_same_v<T, s9>) {
        const auto& codes = results.output->plane[component];
        write_lanes(output, plane, results, [&](std::size_t i) { return codes[i]; });
      } else if constexpr (std::is_same_v<T, std::uint8_t>) {
        write_lanes(output, plane, results, [&](std::size_t i) { return results.colors[i][component]; });
      }
      break;
    case OutputSource::attribute:
      if constexpr (kIsReal<T>) {
        const float* const values = results.attributes[static_cast<std::size_t>(output.attribute)][component];
        write_lanes(output, plane, results, [&](std::size_t i) { return real_as<T>(values[i]); });
      }
      break;
    case OutputSource::primitive:
    case OutputSource::depth:
      if constexpr (kIsNumber<T>) {
        write_lanes(output, plane, results,
                    [&](std::size_t i) { return static_cast<T>(number_of(output, results.fragments[i])); });
      }
      break;
  }
}

}  // namespace

OutputPlanes::OutputPlanes(const RenderTarget& target) {
  for (const OutputPlane& output : target.outputs) {
    const bool holds = std::visit([](const auto& plane) { return static_cast<bool>(plane); }, output.plane);
    if (!holds) continue;
    planes_.push_back(output);
    const bool as_byte = std::holds_alternative<Plane<std::uint8_t>>(output.plane);
    switch (output.source) {
      case OutputSource::register_code:
        needs_registers_ = true;
        break;
      case OutputSource::output_code:
        (as_byte ? needs_colors_ : needs_output_) = true;
        break;
      case OutputSource::attribute:
        needs_attribute_[static_cast<std::size_t>(output.attribute)] = true;
        need_fragment_alone_ = false;
        break;
      case OutputSource::primitive:
      case OutputSource::depth:
        break;
    }
  }
  need_fragment_alone_ = need_fragment_alone_ && !needs_registers_ && !needs_output_ && !needs_colors_;
}

void OutputPlanes::write(const BatchResults& results) const {
  for (const OutputPlane& output : planes_) {
    std::visit([&](const auto& plane) { write_plane(output, plane, results); }, output.plane);
  }
}

void OutputPlanes::write(const UncoloredFragment& fragment, FragmentOutcome outcome) const {
  for (const OutputPlane& output : planes_) {
    if (!is_written(output, fragment, outcome)) continue;
    const std::uint32_t number = number_of(output, fragment);
    if (const auto* wide = std::get_if<Plane<std::uint32_t>>(&output.plane)) {
      wide->at(fragment.x, fragment.y) = number;
    } else if (const auto* narrow = std::get_if<Plane<std::uint16_t>>(&output.plane)) {
      narrow->at(fragment.x, fragment.y) = static_cast<std::uint16_t>(number);
    }
  }
}

}  // namespace ninebit
