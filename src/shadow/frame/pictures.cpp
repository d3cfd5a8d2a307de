#include "ninebit/shadow/pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "src/shadow/frame/cube_cross.h"
#include "src/shadow/frame/upright.h"

namespace ninebit {
namespace {

// A visible colour for each code number. Steps of the golden ratio put neighbouring numbers far apart on the circle of
// hues, and three brightnesses separate hues that come close again.
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
  return rendering.codes.number(rendering.index_map[face].texel(texel));
}

// An EXR channel whose rows are made from a plane's samples on demand.
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
    for (std::size_t c = 0; c < 4; ++c) {
      const Plane<const std::uint8_t> plane = rendering.index_map[f].plane(static_cast<int>(c));
      if (!plane) continue;
      const char name = c == 0 && rendering.codes.format() != IndexFormat::rgb ? 'Y' : "RGBA"[c];
      faces[f].push_back(channel<float>(std::string(1, name), [plane, size](int row, std::span<float> out) {
        for (int x = 0; x < size; ++x) out[static_cast<std::size_t>(x)] = static_cast<float>(plane.at(x, row)) / 255.0F;
      }));
    }
  }
  return write_exr_cube(file, size, faces);
}

// Layers as the parts of a file, each part at the place of its first layer; the layers must outlive them.
std::vector<ExrPart> parts_of(const std::deque<Layer>& layers) {
  std::vector<ExrPart> parts;
  for (const Layer& layer : layers) {
    auto part = std::find_if(parts.begin(), parts.end(), [&](const ExrPart& p) { return p.name == layer.part; });
    if (part == parts.end()) part = parts.insert(part, ExrPart{layer.part, layer.width, layer.height, {}});
    const auto plane = [&](const auto& samples) { return upside_down(samples.data(), layer.width, layer.height); };
    part->channels.push_back(exr_channel(layer.channel, std::visit(plane, layer.samples)));
  }
  return parts;
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
  std::uint32_t last = 0;  // most texels have the index of the one before
  std::array<std::uint8_t, 3> hue = hue_of(last);
  return cube_cross(rendering.index_map.front().size, [&](std::size_t face, std::size_t texel) {
    const std::uint32_t number = code_number(rendering, face, texel);
    if (number != last) hue = hue_of(last = number);
    return hue;
  });
}

Status write_layers(const std::deque<Layer>& layers, const std::filesystem::path& file) {
  return write_exr_parts(file, parts_of(layers));
}

namespace {

using Path = std::filesystem::path;

// A file of a rendering, and how it is written.
struct RenderedFile {
  std::string name;
  std::function<Status(const Path&)> write;
};

// Writes a picture, averaged if it has the size of the frame.
Status write_picture(const Path& file, const Image8& image, const Rendering& rendering, int supersample) {
  const bool of_frame = image.width == rendering.frame.width() && image.height == rendering.frame.height();
  return write_png(file, of_frame && supersample > 1 ? averaged(image, supersample) : image);
}

std::vector<RenderedFile> files_of(const Rendering& rendering, int supersample) {
  std::vector<RenderedFile> files;
  const auto png = [&](std::string name, auto picture) {
    files.push_back({std::move(name), [&rendering, picture, supersample](const Path& file) {
                       return write_picture(file, picture(rendering), rendering, supersample);
                     }});
  };
  png("color.png", &color_picture);
  png("shadow.png", &stencil_picture);
  if (!rendering.index_map.empty()) {
    files.push_back(
        {"index_cube.png", [&rendering](const Path& file) { return write_png(file, index_cross_picture(rendering)); }});
    files.push_back({"index_cube.exr", [&rendering](const Path& file) { return write_index_cube(rendering, file); }});
  }
  for (const NamedPicture& picture : rendering.pictures) {
    files.push_back({picture.file, [&picture, &rendering, supersample](const Path& file) {
                       return write_picture(file, picture.image, rendering, supersample);
                     }});
  }
  if (rendering.layers.empty()) return files;
  files.push_back({"layers.exr", [&rendering](const Path& file) { return write_layers(rendering.layers, file); }});
  if (rendering.maps.empty()) return files;
  files.push_back({"maps.exr", [&rendering](const Path& file) { return write_layers(rendering.maps, file); }});
  return files;
}

}  // namespace

Image8 averaged(const Image8& image, int n) {
  Image8 out{image.width / n, image.height / n, image.channels, {}};
  const auto channels = static_cast<std::size_t>(image.channels),
             row = channels * static_cast<std::size_t>(image.width);
  const auto side = static_cast<std::size_t>(n);
  const std::uint32_t count = static_cast<std::uint32_t>(side * side);
  for (std::size_t y = 0; y < static_cast<std::size_t>(out.height); ++y) {
    for (std::size_t x = 0; x < static_cast<std::size_t>(out.width); ++x) {
      for (std::size_t c = 0; c < channels; ++c) {
        std::uint32_t sum = count / 2;
        for (std::size_t v = 0; v < side; ++v) {
          for (std::size_t u = 0; u < side; ++u) {
            sum += image.pixels[(y * side + v) * row + (x * side + u) * channels + c];
          }
        }
        out.pixels.push_back(static_cast<std::uint8_t>(sum / count));
      }
    }
  }
  return out;
}

std::vector<std::string> file_names(const Rendering& rendering) {
  std::vector<std::string> names;
  for (RenderedFile& file : files_of(rendering, 1)) names.push_back(std::move(file.name));
  return names;
}

Status write_rendering(const Rendering& rendering, StagedFiles& files, const RenderedFiles& chosen) {
  for (const RenderedFile& file : files_of(rendering, chosen.supersample)) {
    const auto& only = chosen.only;
    if (!only.empty() && std::find(only.begin(), only.end(), file.name) == only.end()) continue;
    if (Status written = file.write(files.stage(file.name)); !written) {
      Diagnostic fault = written.error();
      fault.file = files.files().back().string();
      return fault;
    }
  }
  return {};
}

}  // namespace ninebit
