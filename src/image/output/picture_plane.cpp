#include <fmt/format.h>

#include <algorithm>
#include <type_traits>
#include <utility>
#include <variant>

#include "ninebit/image/image_io.h"
#include "src/image/output/faults.h"

namespace ninebit {
namespace {

using image_detail::complain_about_size;
using image_detail::invalid_input;

template <class Sample>
const Sample* row_of(const Sample* top, std::ptrdiff_t stride, int row) {
  return top + stride * row;
}

// A function that copies rows and applies `convert` to each sample.
template <class To, class Sample, class Convert>
std::function<void(int, std::span<To>)> rows_of(const Sample* top, std::ptrdiff_t stride, Convert convert) {
  return [top, stride, convert](int row, std::span<To> out) {
    const Sample* const from = row_of(top, stride, row);
    std::transform(from, from + out.size(), out.begin(), convert);
  };
}

// Interleaves the planes, which must all have samples of this type, and writes them.
template <class Sample>
Status write_planes(const std::filesystem::path& file, int width, int height, std::span<const PicturePlane> planes) {
  const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
  Image<Sample> image{width, height, static_cast<int>(planes.size()), {}};
  image.pixels.resize(columns * rows * planes.size());
  for (std::size_t channel = 0; channel < planes.size(); ++channel) {
    const auto* const top = std::get_if<const Sample*>(&planes[channel].top);
    if (top == nullptr) return invalid_input(file, fmt::format("plane {} has other samples than plane 0", channel));
    if (*top == nullptr) return invalid_input(file, fmt::format("plane {} has no samples", channel));
    for (std::size_t row = 0; row < rows; ++row) {
      const Sample* const from = row_of(*top, planes[channel].stride, static_cast<int>(row));
      Sample* const to = image.pixels.data() + row * columns * planes.size() + channel;
      for (std::size_t x = 0; x < columns; ++x) to[x * planes.size()] = from[x];
    }
  }
  return write_png(file, image);
}

}  // namespace

Status write_png(const std::filesystem::path& file, int width, int height, std::span<const PicturePlane> planes) {
  if (std::string complaint = complain_about_size(width, height); !complaint.empty()) {
    return invalid_input(file, "the picture " + complaint);
  }
  if (planes.size() != 1 && planes.size() != 3 && planes.size() != 4) {
    return invalid_input(file, fmt::format("the picture has {} planes; 1, 3 or 4 can be written", planes.size()));
  }
  if (std::holds_alternative<const std::uint8_t*>(planes[0].top)) {
    return write_planes<std::uint8_t>(file, width, height, planes);
  }
  if (std::holds_alternative<const std::uint16_t*>(planes[0].top)) {
    return write_planes<std::uint16_t>(file, width, height, planes);
  }
  return invalid_input(file, "PNG holds 8-bit and 16-bit planes only");
}

ExrChannel exr_channel(std::string name, const PicturePlane& plane) {
  const std::ptrdiff_t stride = plane.stride;
  const auto rows = [stride](const auto* top) -> decltype(ExrChannel::rows) {
    using Sample = std::remove_cvref_t<decltype(*top)>;
    if constexpr (std::is_same_v<Sample, float>) {
      return ExrFloatRow{rows_of<float>(top, stride, [](float v) { return v; })};
    } else if constexpr (std::is_same_v<Sample, Half>) {
      return ExrHalfRow{rows_of<Half>(top, stride, [](Half v) { return v; })};
    } else if constexpr (std::is_same_v<Sample, s9>) {
      return rows_of<float>(top, stride, [](s9 v) { return static_cast<float>(v); });
    } else {
      return rows_of<std::uint32_t>(top, stride, [](Sample v) { return std::uint32_t{v}; });
    }
  };
  if (std::visit([](const auto* top) { return top == nullptr; }, plane.top)) return {std::move(name), ExrIntegerRow{}};
  return {std::move(name), std::visit(rows, plane.top)};
}

}  // namespace ninebit
