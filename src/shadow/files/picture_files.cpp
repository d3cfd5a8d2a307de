#include "ninebit/shadow/picture_files.h"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "src/frame/packed_map.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

// A channel of the index cube: the code numbers.
ExrIntegerRow number_rows(const IndexCodes& codes, const IndexMapFace& face) {
  return [&codes, &face](int row, std::span<std::uint32_t> out) {
    face.read_numbers(codes, static_cast<std::size_t>(row) * out.size(), out);
  };
}

// A channel of the index cube: a component of the codes, 0 to 1. `levels` has the values of all bytes.
ExrHalfRow component_rows(const Plane<const std::uint8_t>& plane, const std::array<Half, 256>& levels) {
  return {[plane, &levels](int row, std::span<Half> out) {
    const std::uint8_t* from = plane.row(row);
    for (Half& level : out) {
      level = levels[*from];
      from += plane.step;
    }
  }};
}

Status write_index_cube(const Rendering& rendering, const std::filesystem::path& file) {
  std::array<Half, 256> levels{};
  for (std::size_t k = 0; k < levels.size(); ++k) levels[k] = half_of(static_cast<float>(k) / 255.0F);
  std::array<std::vector<ExrChannel>, 6> faces;
  for (std::size_t f = 0; f < 6; ++f) {
    const IndexMapFace& face = rendering.index_map[f];
    faces[f].push_back({"index", number_rows(rendering.codes, face)});
    for (std::size_t c = 0; c < 4; ++c) {
      const Plane<const std::uint8_t> plane = face.plane(static_cast<int>(c));
      if (!plane) continue;
      const char name = c == 0 && rendering.codes.format() != IndexFormat::rgb ? 'Y' : "RGBA"[c];
      faces[f].push_back({std::string(1, name), component_rows(plane, levels)});
    }
  }
  return write_exr_cube(file, rendering.index_map.front().size, faces);
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

Status write_layers(const std::deque<Layer>& layers, const std::filesystem::path& file) {
  return write_exr_parts(file, parts_of(layers));
}

namespace {

using Path = std::filesystem::path;

// A file of a rendering, and how it is written.
struct RenderedFile {
  std::string name;
  std::function<Status(const Path&)> write;
  bool by_name_alone = false;  // not one of those that a rendering writes without being asked
};

// A file on its way to the disk.
struct StagedRendering {
  RenderedFile file;
  Path temporary, target;
  Status written{};
};

// Files are written at the same time up to this size of a rendering: each is made in memory as a whole.
constexpr std::size_t kMostPixelsAtOnce = std::size_t{1} << 24;

// The planes of the frame and of the maps.
std::size_t pixels_of(const Rendering& rendering) {
  std::size_t pixels =
      static_cast<std::size_t>(rendering.frame.width()) * static_cast<std::size_t>(rendering.frame.height());
  for (const auto& face : rendering.index_map) {
    pixels += static_cast<std::size_t>(face.size) * static_cast<std::size_t>(face.size);
  }
  return pixels;
}

std::vector<RenderedFile> files_of(const Rendering& rendering, int supersample) {
  std::vector<RenderedFile> files;
  const auto png = [&](std::string name, auto picture) {
    files.push_back({.name = std::move(name), .write = [&rendering, picture, supersample](const Path& file) {
                       return write_png(file, as_shown(picture(rendering), rendering, supersample));
                     }});
  };
  png("color.png", &color_picture);
  png("shadow.png", &stencil_picture);
  if (!rendering.index_map.empty()) {
    files.push_back({.name = "index_cube.png", .write = [&rendering](const Path& file) {
                       return write_png(file, index_cross_picture(rendering));
                     }});
    files.push_back({.name = "index_cube.exr",
                     .write = [&rendering](const Path& file) { return write_index_cube(rendering, file); },
                     .by_name_alone = rendering.layers.empty()});
  }
  for (const NamedPicture& picture : rendering.pictures) {
    files.push_back({.name = picture.file, .write = [&picture, &rendering, supersample](const Path& file) {
                       return write_png(file, as_shown(picture.image, rendering, supersample));
                     }});
  }
  if (rendering.layers.empty()) return files;
  files.push_back(
      {.name = "layers.exr", .write = [&rendering](const Path& file) { return write_layers(rendering.layers, file); }});
  if (rendering.maps.empty()) return files;
  files.push_back(
      {.name = "maps.exr", .write = [&rendering](const Path& file) { return write_layers(rendering.maps, file); }});
  return files;
}

}  // namespace

std::vector<std::string> file_names(const Rendering& rendering, NamedFiles which) {
  std::vector<std::string> names;
  for (RenderedFile& file : files_of(rendering, 1)) {
    if (which == NamedFiles::all || !file.by_name_alone) names.push_back(std::move(file.name));
  }
  return names;
}

Status write_rendering(const Rendering& rendering, StagedFiles& files, const RenderedFiles& chosen) {
  std::vector<StagedRendering> staged;
  for (RenderedFile& file : files_of(rendering, chosen.supersample)) {
    const auto& only = chosen.only;
    const bool is_named = std::find(only.begin(), only.end(), file.name) != only.end();
    if (only.empty() ? file.by_name_alone : !is_named) continue;
    const Path temporary = files.stage(file.name);
    staged.push_back({std::move(file), temporary, files.files().back()});
  }
  const auto write = [&](std::size_t i) { staged[i].written = staged[i].file.write(staged[i].temporary); };
  if (pixels_of(rendering) <= kMostPixelsAtOnce) {
    parallel_for(staged.size(), 1, write);
  } else {
    for (std::size_t i = 0; i < staged.size(); ++i) write(i);
  }
  for (const StagedRendering& one : staged) {
    if (one.written) continue;
    Diagnostic fault = one.written.error();
    fault.file = one.target.string();
    return fault;
  }
  return {};
}

}  // namespace ninebit
