#include "ninebit/shadow/pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

namespace ninebit {
namespace {

// Rows of a plane in the order of a picture: the highest first.
template <class To, class From>
std::vector<To> upright(const std::vector<From>& plane, int width) {
  std::vector<To> out(plane.size());
  const auto row = static_cast<std::size_t>(width);
  const std::size_t rows = plane.size() / row;
  for (std::size_t y = 0; y < rows; ++y) {
    for (std::size_t x = 0; x < row; ++x) out[(rows - 1 - y) * row + x] = static_cast<To>(plane[y * row + x]);
  }
  return out;
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
  const Surface& s = rendering.index_map[face];
  return rendering.codes.number(s.color(kRed)[texel], s.color(kGreen)[texel], s.color(kBlue)[texel]);
}

Status write_index_cube(const Rendering& rendering, const std::filesystem::path& file) {
  const int size = rendering.index_map.front().width();
  std::array<std::vector<std::uint32_t>, 6> numbers;
  std::array<std::array<std::vector<float>, 3>, 6> colors;
  std::array<std::vector<ExrChannel>, 6> faces;
  for (std::size_t f = 0; f < 6; ++f) {
    const std::size_t texels = rendering.index_map[f].depth_z24().size();
    numbers[f].resize(texels);
    for (std::size_t i = 0; i < texels; ++i) numbers[f][i] = code_number(rendering, f, i);
    faces[f].push_back({"index", std::span<const std::uint32_t>(numbers[f])});
    for (int c = 0; c < 3; ++c) {
      std::vector<float>& plane = colors[f][static_cast<std::size_t>(c)];
      const std::vector<std::uint8_t>& bytes = rendering.index_map[f].color(c);
      plane.resize(texels);
      std::transform(bytes.begin(), bytes.end(), plane.begin(),
                     [](std::uint8_t b) { return static_cast<float>(b) / 255.0F; });
      faces[f].push_back({std::string(1, "RGB"[c]), std::span<const float>(plane)});
    }
  }
  return write_exr_cube(file, size, faces);
}

// Collects EXR parts whose samples it owns.
class LayerParts {
 public:
  LayerParts(int width, int height) : width_(width), height_(height) {}

  template <std::size_t N>
  void add_codes(const std::string& name, const std::array<std::vector<s9>, N>& planes) {
    ExrPart& part = add(name);
    for (std::size_t c = 0; c < N; ++c) {
      part.channels.push_back({std::string(1, "RGBA"[c]), keep(upright<float>(planes[c], width_))});
    }
  }
  void add_codes(const std::string& name, const std::string& channel, const std::vector<s9>& plane) {
    add(name).channels.push_back({channel, keep(upright<float>(plane, width_))});
  }
  template <class T>
  void add_integers(const std::string& name, const std::vector<T>& plane) {
    integers_.push_back(upright<std::uint32_t>(plane, width_));
    add(name).channels.push_back({name, std::span<const std::uint32_t>(integers_.back())});
  }
  [[nodiscard]] const std::vector<ExrPart>& parts() const { return parts_; }

 private:
  ExrPart& add(const std::string& name) { return parts_.emplace_back(ExrPart{name, width_, height_, {}}); }
  std::span<const float> keep(std::vector<float> plane) { return reals_.emplace_back(std::move(plane)); }

  int width_, height_;
  std::vector<ExrPart> parts_;
  std::vector<std::vector<float>> reals_;  // moving a vector keeps its samples in place
  std::vector<std::vector<std::uint32_t>> integers_;
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
  parts.add_integers("depth", rendering.frame.depth_z24());
  parts.add_integers("polygon", layers.polygon);
  parts.add_integers("object", layers.object);
  return write_exr_parts(file, parts.parts());
}

}  // namespace

Image8 color_picture(const Rendering& rendering) {
  const int width = rendering.frame.width(), height = rendering.frame.height();
  Image8 image{width, height, 3, {}};
  image.pixels.resize(rendering.frame.stencil().size() * 3);
  for (int c = 0; c < 3; ++c) {
    const std::vector<std::uint8_t> plane = upright<std::uint8_t>(rendering.frame.color(c), width);
    for (std::size_t i = 0; i < plane.size(); ++i) image.pixels[i * 3 + static_cast<std::size_t>(c)] = plane[i];
  }
  return image;
}

Image8 stencil_picture(const Rendering& rendering) {
  const int width = rendering.frame.width(), height = rendering.frame.height();
  Image8 image{width, height, 1, upright<std::uint8_t>(rendering.frame.stencil(), width)};
  for (std::uint8_t& pixel : image.pixels) pixel = pixel != 0 ? 255 : 0;
  return image;
}

Image8 index_cross_picture(const Rendering& rendering) {
  constexpr std::array<std::array<int, 2>, 6> place{{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}};
  const int size = rendering.index_map.front().width();
  const auto n = static_cast<std::size_t>(size);
  Image8 image{4 * size, 3 * size, 3, {}};
  image.pixels.assign(12 * n * n * 3, 24);
  for (std::size_t f = 0; f < 6; ++f) {
    const std::size_t left = static_cast<std::size_t>(place[f][0]) * n, top = static_cast<std::size_t>(place[f][1]) * n;
    for (std::size_t y = 0; y < n; ++y) {
      for (std::size_t x = 0; x < n; ++x) {
        const auto color = hue_of(code_number(rendering, f, y * n + x));
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
