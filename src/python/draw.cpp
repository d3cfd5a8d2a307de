// Draws effects; the returned arrays are copies.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ninebit/effect/effect_files.h"
#include "ninebit/effect/effect_json.h"
#include "src/image/texture/texture_file.h"
#include "src/python/module.h"

namespace py = pybind11;

namespace ninebit::python {
namespace {

using Pixels = py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>;

// A texture of an array (height, width) or (height, width, 1 to 4), the first row at t = 0. Throws Error for others.
Texture texture_of(const Pixels& pixels, const std::string& file) {
  const py::ssize_t components = pixels.ndim() == 3 ? pixels.shape(2) : 1;
  if ((pixels.ndim() != 2 && pixels.ndim() != 3) || components < 1 || components > 4) {
    throw Error{file + ": read_picture must return an array of the shape (height, width) or (height, width, 1 to 4)"};
  }
  constexpr std::array kFormats{InternalFormat::luminance8, InternalFormat::luminance8_alpha8, InternalFormat::rgb8,
                                InternalFormat::rgba8};
  TextureSamples samples{.width = static_cast<int>(pixels.shape(1)), .height = static_cast<int>(pixels.shape(0))};
  std::vector<std::uint8_t> planes;
  const auto count = static_cast<std::size_t>(pixels.size()), step = static_cast<std::size_t>(components);
  planes.reserve(count);
  for (std::size_t c = 0; c < step; ++c) {
    for (std::size_t i = c; i < count; i += step) planes.push_back(pixels.data()[i]);
  }
  samples.samples = std::move(planes);
  auto texture = make_texture(TextureTarget::texture_2d, kFormats[step - 1], {{std::move(samples)}});
  if (!texture) throw Error{file + ": " + texture.error().message};
  return std::move(*texture);
}

// DDS files are read here, pictures by the function.
EffectReaders readers_with(const std::optional<py::function>& read_picture) {
  return file_readers([read_picture](std::span<const std::filesystem::path> files,
                                     const HardwareProfile& profile) -> Result<Texture> {
    const std::string name = files[0].string();
    if (files.size() == 1 && (files[0].extension() == ".dds" || files[0].extension() == ".DDS")) {
      return image_detail::read_texture(profile, files[0], {}, {});
    }
    if (!read_picture) {
      return Diagnostic{.message = "is not a DDS file; expected read_picture, a function that reads it", .file = name};
    }
    std::vector<Texture> faces;
    for (const std::filesystem::path& file : files) {
      faces.push_back(texture_of((*read_picture)(file.string()).cast<Pixels>(), file.string()));
    }
    if (faces.size() == 1) return faces[0];
    Texture cube = faces[0];
    cube.target = TextureTarget::cube_map;
    for (std::size_t f = 1; f < faces.size(); ++f) {
      if (faces[f].format != cube.format) return Diagnostic{.message = "has other components than +X", .file = name};
      cube.faces[f] = faces[f].faces[0];
    }
    cube.storage = std::make_shared<std::vector<Texture>>(std::move(faces));
    if (Status checked = check_texture(cube); !checked)
      return Diagnostic{.message = checked.error().message, .file = name};
    return cube;
  });
}

template <class T>
py::array_t<T> upright_copy(const PlaneSamples<T>& plane, int width, int height) {
  py::array_t<T> out(std::vector<py::ssize_t>{plane.empty() ? 0 : height, plane.empty() ? 0 : width});
  const auto row = static_cast<std::size_t>(width);
  for (int y = 0; y < (plane.empty() ? 0 : height); ++y) {
    const T* const from = plane.data() + static_cast<std::size_t>(height - 1 - y) * row;
    std::copy(from, from + row, out.mutable_data(y, 0));
  }
  return out;
}

py::dict draw(const std::string& file, const std::optional<std::string>& profile,
              const std::optional<std::pair<int, int>>& size, const std::optional<py::function>& read_picture) {
  auto parsed = read_effect(file);
  if (!parsed) throw Error{parsed.faults()[0].text()};
  Effect& effect = *parsed;
  if (size) {
    effect.width = size->first;
    effect.height = size->second;
  }
  const std::string own = effect.profile.empty() ? "geforce2" : effect.profile;
  auto renderer = EffectRenderer::make(effect, profile_named(profile.value_or(own)), readers_with(read_picture));
  if (!renderer) throw Error{renderer.error().text()};
  Status drawn;
  {
    const py::gil_scoped_release others_may_run;
    drawn = renderer->draw();
  }
  if (!drawn) throw Error{drawn.error().text()};
  const Surface& picture = renderer->picture();
  py::dict answer;
  constexpr std::array kColors{"red", "green", "blue", "alpha"};
  for (int c = 0; c < 4; ++c) {
    answer[kColors[static_cast<std::size_t>(c)]] = upright_copy(picture.color(c), picture.width(), picture.height());
  }
  answer["depth"] = upright_copy(picture.depth(), picture.width(), picture.height());
  answer["stencil"] = upright_copy(picture.stencil(), picture.width(), picture.height());
  answer["warnings"] = renderer->warnings();
  return answer;
}

}  // namespace

void add_draw(py::module_& module) {
  module.def(
      "draw", &draw, py::arg("effect"), py::kw_only(), py::arg("profile") = py::none(), py::arg("size") = py::none(),
      py::arg("read_picture") = py::none(),
      "Draws an effect file. Returns 'red', 'green', 'blue', 'alpha', 'stencil' (uint8) and 'depth' (uint32 codes) of "
      "the picture as arrays of the shape (height, width), and 'warnings'. read_picture is called with the path of "
      "each "
      "texture that is not a DDS file and returns it as an array of the shape (height, width) or (height, width, 1 to "
      "4) of uint8, the first row on top: imageio.v3.imread, for example. profile and size replace those of the file.");
}

}  // namespace ninebit::python
