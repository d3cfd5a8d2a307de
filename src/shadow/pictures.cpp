#include "ninebit/shadow/pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

namespace ninebit {
namespace {

// Larger faces are shown by every second, fourth, … texel: the cross is for people.
constexpr std::size_t kLargestCrossFace = 1024;

// Where sample i of a plane, lowest row first, stands in a picture, highest row first.
std::size_t upright_index(std::size_t i, int width, int height) {
  const auto row = static_cast<std::size_t>(width);
  return (static_cast<std::size_t>(height) - 1 - i / row) * row + i % row;
}

// A visible colour for each code number. Steps of the golden ratio put neighbouring numbers far apart on the circle of
// hues, and three brightnesses tell apart what comes close again.
std::array<std::uint8_t, 3> hue_of(std::uint32_t number) {
  if (number == 0) return {0, 0, 0};
  const double hue = std::fmod(static_cast<double>(number) * 0.6180339887498949, 1.0) * 6.0;
  const double value = 255.0 - 45.0 * (number % 3);
  const double low = value * 0.25;
  const auto ramp = [&](double offset) {
    const double h = std::fmod(hue + offset, 6.0);
    const double level = std::clamp(std::fabs(h - 3.0) - 1.0, 0.0, 1.0);
    return static_cast<std::uint8_t>(low + (value - low) * level + 0.5);
  };
  return {ramp(0.0), ramp(4.0), ramp(2.0)};
}

std::uint32_t code_number(const Rendering& rendering, std::size_t face, std::size_t texel) {
  const auto& color = rendering.index_map[face].color;
  return rendering.codes.number(color[kRed][texel], color[kGreen][texel], color[kBlue][texel]);
}

// Rows of an EXR channel, made from a plane's samples as they are asked for.
template <class To, class Value>
ExrChannel channel(std::string name, Value value_at_row) {
  return {std::move(name), std::function<void(int, std::span<To>)>(std::move(value_at_row))};
}

Status write_index_cube(const Rendering& rendering, const std::filesystem::path& file) {
  const int size = rendering.index_map.front().size;
  const auto n = static_cast<std::size_t>(size);
  std::array<std::vector<ExrChannel>, 6> faces;
  for (std::size_t f = 0; f < 6; ++f) {
    faces[f].push_back(channel<std::uint32_t>("index", [&rendering, f, n](int row, std::span<std::uint32_t> out) {
      for (std::size_t x = 0; x < n; ++x) out[x] = code_number(rendering, f, static_cast<std::size_t>(row) * n + x);
    }));
    for (std::size_t c = 0; c < 3; ++c) {
      faces[f].push_back(channel<float>(std::string(1, "RGB"[c]), [&rendering, f, c, n](int row, std::span<float> out) {
        const std::uint8_t* const bytes = rendering.index_map[f].color[c].data() + static_cast<std::size_t>(row) * n;
        for (std::size_t x = 0; x < n; ++x) out[x] = static_cast<float>(bytes[x]) / 255.0F;
      }));
    }
  }
  return write_exr_cube(file, size, faces);
}

// The parts of layers.exr. Planes have their lowest row first, EXR parts their highest; the planes must outlive this.
class LayerParts {
 public:
  LayerParts(int width, int height) : width_(width), height_(height) {}

  template <std::size_t N>
  void add_codes(const std::string& name, const std::array<std::vector<s9>, N>& planes) {
    ExrPart& part = add(name);
    for (std::size_t c = 0; c < N; ++c) part.channels.push_back(upright<float>(std::string(1, "RGBA"[c]), planes[c]));
  }
  void add_codes(const std::string& name, const std::string& channel_name, const std::vector<s9>& plane) {
    add(name).channels.push_back(upright<float>(channel_name, plane));
  }
  template <class T>
  void add_integers(const std::string& name, const std::vector<T>& plane) {
    add(name).channels.push_back(upright<std::uint32_t>(name, plane));
  }
  [[nodiscard]] const std::vector<ExrPart>& parts() const { return parts_; }

 private:
  ExrPart& add(const std::string& name) { return parts_.emplace_back(ExrPart{name, width_, height_, {}}); }

  template <class To, class From>
  ExrChannel upright(const std::string& name, const std::vector<From>& plane) const {
    return channel<To>(name, [&plane, height = height_](int row, std::span<To> out) {
      const From* const from = plane.data() + static_cast<std::size_t>(height - 1 - row) * out.size();
      std::transform(from, from + out.size(), out.begin(), [](From v) { return static_cast<To>(v); });
    });
  }

  int width_, height_;
  std::vector<ExrPart> parts_;
};

Status write_layers(const Rendering& rendering, const std::filesystem::path& file) {
  const ComparisonLayers& layers = *rendering.layers;
  LayerParts parts(rendering.frame.width(), rendering.frame.height());
  parts.add_codes("primary", layers.primary);
  parts.add_codes("texture0", layers.texture0);
  parts.add_codes("spare0", layers.spare0);
  parts.add_codes("spare1", layers.spare1);
  parts.add_codes("output", "A", layers.output_alpha);
  parts.add_integers("stencil", rendering.frame.stencil());
  parts.add_integers("depth", rendering.frame.depth());
  parts.add_integers("polygon", layers.polygon);
  parts.add_integers("object", layers.object);
  return write_exr_parts(file, parts.parts());
}

}  // namespace

Image8 color_picture(const Rendering& rendering) {
  const int width = rendering.frame.width(), height = rendering.frame.height();
  Image8 image{width, height, 3, {}};
  image.pixels.resize(rendering.frame.stencil().size() * 3);
  for (std::size_t i = 0; i < rendering.frame.stencil().size(); ++i) {
    const std::size_t to = upright_index(i, width, height) * 3;
    for (std::size_t c = 0; c < 3; ++c) image.pixels[to + c] = rendering.frame.color(static_cast<int>(c))[i];
  }
  return image;
}

Image8 stencil_picture(const Rendering& rendering) {
  const int width = rendering.frame.width(), height = rendering.frame.height();
  Image8 image{width, height, 1, {}};
  image.pixels.resize(rendering.frame.stencil().size());
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[upright_index(i, width, height)] = rendering.frame.stencil()[i] != 0 ? 255 : 0;
  }
  return image;
}

Image8 index_cross_picture(const Rendering& rendering) {
  constexpr std::array<std::array<int, 2>, 6> place{{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}};
  const auto texels = static_cast<std::size_t>(rendering.index_map.front().size);
  const std::size_t n = std::min(texels, kLargestCrossFace), stride = texels / n;
  Image8 image{static_cast<int>(4 * n), static_cast<int>(3 * n), 3, {}};
  image.pixels.assign(12 * n * n * 3, 24);
  for (std::size_t f = 0; f < 6; ++f) {
    const std::size_t left = static_cast<std::size_t>(place[f][0]) * n, top = static_cast<std::size_t>(place[f][1]) * n;
    for (std::size_t y = 0; y < n; ++y) {
      for (std::size_t x = 0; x < n; ++x) {
        const auto color = hue_of(code_number(rendering, f, (y * texels + x) * stride));
        std::copy(color.begin(), color.end(),
                  image.pixels.begin() + static_cast<std::ptrdiff_t>(((top + y) * 4 * n + left + x) * 3));
      }
    }
  }
  return image;
}

Status write_rendering(const Rendering& rendering, StagedFiles& files) {
  using Path = std::filesystem::path;
  // Stages one file and names it by its final path in an error.
  const auto write = [&](const char* name, const std::function<Status(const Path&)>& writer) -> Status {
    Status written = writer(files.stage(name));
    if (written) return written;
    Diagnostic fault = written.error();
    fault.file = files.files().back().string();
    return fault;
  };
  Status s = write("color.png", [&](const Path& file) { return write_png(file, color_picture(rendering)); });
  if (s) s = write("shadow.png", [&](const Path& file) { return write_png(file, stencil_picture(rendering)); });
  if (s && !rendering.index_map.empty()) {
    s = write("index_cube.png", [&](const Path& file) { return write_png(file, index_cross_picture(rendering)); });
    if (s) s = write("index_cube.exr", [&](const Path& file) { return write_index_cube(rendering, file); });
  }
  if (s && rendering.layers) s = write("layers.exr", [&](const Path& file) { return write_layers(rendering, file); });
  return s;
}

}  // namespace ninebit
