#include "src/gl_layer/capture/captured_effect.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "ninebit/numerics/fixed9.h"
#include "src/gl_layer/capture/png.h"
#include "src/gl_layer/driver/log.h"

namespace ninebit::gl_layer {
namespace {

using Json = nlohmann::ordered_json;

// The camera of effects without one stands at (0, 0, 3): this is the angle that the rectangle from -1 to 1 fills.
constexpr double kCameraDistance = 3.0;
constexpr double kPi = 3.14159265358979323846;

// As ninebit_codes() of the shader rounds: in floats of 32 bits, in which 0.7 * 255 is 178.5.
unsigned char byte_of(float value) {
  return value > 0.0F ? static_cast<unsigned char>(std::min(value, 1.0F) * 255.0F + 0.5F) : 0;
}

BytePixel bytes_of(const FloatPixel& pixel) {
  return {byte_of(pixel[0]), byte_of(pixel[1]), byte_of(pixel[2]), byte_of(pixel[3])};
}

bool is_drawn(const CapturedDraw& draw, std::size_t i) {
  return draw.primary[i][0] >= 0.0F;
}

// A fog factor in the middle of those that become the same byte under the profile.
float steady_factor(const HardwareProfile& profile, float factor) {
  if (profile.fog_byte.value == StageByte::nearest) return static_cast<float>(byte_of(factor)) / 255.0F;
  return std::min((static_cast<float>(byte_of_fog_factor(profile, factor)) + 0.5F) / 255.0F, 1.0F);
}

// What the mesh has beside positions and primary colours.
struct Varying {
  bool secondary = false, fog = false;
};

// Rectangles one pixel high, each with the same inputs everywhere, as a PLY file whose corners are the pixels' corners.
class PixelMesh {
 public:
  PixelMesh(const CapturedDraw& draw, const HardwareProfile& profile, Varying varying)
      : draw_(draw), profile_(profile), varying_(varying) {
    const auto width = static_cast<std::size_t>(draw.width);
    for (std::size_t row = 0; row < draw.primary.size() / width; ++row) {
      for (std::size_t x = 0; x < width;) x = add_run(row, x, width);
    }
  }

  [[nodiscard]] bool empty() const { return quads_ == 0; }
  [[nodiscard]] std::string ply() const {
    std::string text = "ply\nformat binary_little_endian 1.0\ncomment pixels of a captured draw call\nelement vertex " +
                       std::to_string(4 * quads_) +
                       "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar "
                       "green\nproperty uchar blue\nproperty uchar alpha\n" +
                       (varying_.secondary ? kSecondary : "") + (varying_.fog ? "property float fog_factor\n" : "") +
                       "element face " + std::to_string(quads_) +
                       "\nproperty list uchar int vertex_indices\nend_header\n" + vertices_;
    for (std::size_t quad = 0; quad < quads_; ++quad) {
      text += '\4';
      for (std::size_t corner = 0; corner < 4; ++corner) append(text, static_cast<std::int32_t>(4 * quad + corner));
    }
    return text;
  }

 private:
  static constexpr const char* kSecondary =
      "property uchar secondary_red\nproperty uchar secondary_green\nproperty uchar secondary_blue\nproperty uchar "
      "secondary_alpha\n";

  struct Inputs {
    BytePixel primary{}, secondary{};
    float fog = 0.0F;
    bool operator==(const Inputs&) const = default;
  };

  [[nodiscard]] Inputs inputs_at(std::size_t i) const {
    Inputs inputs{.primary = bytes_of(draw_.primary[i])};
    if (varying_.secondary) inputs.secondary = bytes_of(draw_.secondary[i]);
    if (varying_.fog) inputs.fog = steady_factor(profile_, draw_.fog[i][3]);
    return inputs;
  }

  // Returns where the run ends.
  std::size_t add_run(std::size_t row, std::size_t x, std::size_t width) {
    const std::size_t first = row * width;
    if (!is_drawn(draw_, first + x)) return x + 1;
    const Inputs inputs = inputs_at(first + x);
    std::size_t end = x + 1;
    while (end < width && is_drawn(draw_, first + end) && inputs_at(first + end) == inputs) ++end;
    for (const auto& [column, line] : {std::pair{x, row}, {end, row}, {end, row + 1}, {x, row + 1}}) {
      append(vertices_,
             (2.0F * static_cast<float>(column) - static_cast<float>(draw_.width)) / static_cast<float>(draw_.height));
      append(vertices_, 2.0F * static_cast<float>(line) / static_cast<float>(draw_.height) - 1.0F);
      append(vertices_, 0.0F);
      append(vertices_, inputs.primary);
      if (varying_.secondary) append(vertices_, inputs.secondary);
      if (varying_.fog) append(vertices_, inputs.fog);
    }
    ++quads_;
    return end;
  }

  template <class T>
  static void append(std::string& text, T value) {
    static_assert(std::endian::native == std::endian::little);
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    text.append(bytes, sizeof(T));
  }

  const CapturedDraw& draw_;
  const HardwareProfile& profile_;
  Varying varying_;
  std::string vertices_{};
  std::size_t quads_ = 0;
};

std::size_t power_of_two(int size) {
  return std::bit_ceil(static_cast<std::size_t>(size));
}

// The pixels in a texture whose sides are powers of two; its first row is the picture's lowest.
std::string texture_file(const std::vector<FloatPixel>& pixels, int width, int height) {
  const std::size_t columns = power_of_two(width), rows = power_of_two(height);
  std::vector<BytePixel> texels(columns * rows, BytePixel{});
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const std::size_t x = i % static_cast<std::size_t>(width), y = i / static_cast<std::size_t>(width);
    texels[y * columns + x] = bytes_of(pixels[i]);
  }
  return png_file(texels, columns);
}

std::string picture_file(const CapturedDraw& draw) {
  const auto width = static_cast<std::size_t>(draw.width);
  std::vector<BytePixel> rows;
  rows.reserve(draw.color.size());
  for (std::size_t row = draw.color.size() / width; row-- > 0;) {
    rows.insert(rows.end(), draw.color.begin() + static_cast<std::ptrdiff_t>(row * width),
                draw.color.begin() + static_cast<std::ptrdiff_t>((row + 1) * width));
  }
  return png_file(rows, width);
}

// The bytes that all drawn pixels have; empty: they differ.
std::optional<BytePixel> common_bytes(const CapturedDraw& draw, const std::vector<FloatPixel>& values) {
  std::optional<BytePixel> common;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!is_drawn(draw, i)) continue;
    const BytePixel bytes = bytes_of(values[i]);
    if (common && *common != bytes) return std::nullopt;
    common = bytes;
  }
  return common ? common : BytePixel{};
}

std::string constant_source(const BytePixel& bytes) {
  std::string text = "constant:";
  for (std::size_t c = 0; c < 4; ++c) {
    char number[32];
    std::snprintf(number, sizeof(number), "%s%.9g", c == 0 ? "" : ",", bytes[c] / 255.0);
    text += number;
  }
  return text;
}

Json color_of(const ColorF& color) {
  return Json::array({color[0], color[1], color[2], color[3]});
}

Json matrix_to(const CapturedDraw& draw) {
  const double s = static_cast<double>(draw.width) / static_cast<double>(power_of_two(draw.width));
  const double t = static_cast<double>(draw.height) / static_cast<double>(power_of_two(draw.height));
  return Json::array(
      {Json::array({s, 0, 0, 0}), Json::array({0, t, 0, 0}), Json::array({0, 0, 1, 0}), Json::array({0, 0, 0, 1})});
}

// The fog register's colour; a fog colour that changes within a display list cannot be said.
Json fog_of(const CapturedDraw& draw, bool varying, CapturedFiles& files) {
  std::vector<FloatPixel> colors = draw.fog;
  for (FloatPixel& color : colors) color[3] = 0.0F;
  Json fog = Json::object();
  if (varying) fog["factor"] = "mesh";
  if (const auto color = common_bytes(draw, colors)) {
    fog["color"] = Json::array({(*color)[0] / 255.0, (*color)[1] / 255.0, (*color)[2] / 255.0});
  } else {
    files.left_out.emplace_back("the fog colour differs from pixel to pixel; the effect has 0");
  }
  return fog;
}

// The effect's pass; the program file holds the constants of the state when it was first drawn with.
Json pass_of(const CapturedDraw& draw, const CombinerState& state, const HardwareProfile& profile,
             const std::string& program, Varying varying, CapturedFiles& files) {
  Json pass{{"name", draw.call}, {"program", program}, {"primary", "color"}, {"shade", "flat"}, {"depth", nullptr}};
  Json& constants = pass["constants"];
  constants = {{"const0", color_of(state.constant0)}, {"const1", color_of(state.constant1)}};
  if (profile.per_stage_constants && state.per_stage_constants) {
    constants["combiners"] = Json::array();
    for (int i = 0; i < state.num_general_combiners; ++i) {
      const GeneralCombiner& general = state.general[static_cast<std::size_t>(i)];
      constants["combiners"].push_back(
          {{"const0", color_of(general.constant0)}, {"const1", color_of(general.constant1)}});
    }
  }
  pass["secondary"] =
      varying.secondary ? "secondary-color" : constant_source(common_bytes(draw, draw.secondary).value_or(BytePixel{}));
  pass["fog"] = fog_of(draw, varying.fog, files);
  return pass;
}

}  // namespace

bool write_file(const std::filesystem::path& file, const std::string& content) {
  const std::filesystem::path unfinished = file.string() + ".part";
  std::ofstream stream(unfinished, std::ios::binary);
  stream << content;
  stream.close();
  std::error_code fault;
  if (stream) std::filesystem::rename(unfinished, file, fault);
  if (stream && !fault) return true;
  log_line(file.string() + ": cannot be written");
  std::filesystem::remove(unfinished, fault);
  return false;
}

CapturedFiles write_effect(const std::filesystem::path& folder, const std::string& name, const CapturedDraw& draw,
                           const CombinerState& state, const HardwareProfile& profile, const std::string& program) {
  CapturedFiles files;
  const auto write = [&](const std::string& file, const std::string& content) {
    if (write_file(folder / file, content)) files.files.push_back(folder.filename().string() + '/' + file);
  };
  write(name + ".png", picture_file(draw));
  for (std::size_t i = 0; i < draw.primary.size(); ++i) files.pixels += is_drawn(draw, i) ? 1U : 0U;
  const Varying varying{.secondary = !common_bytes(draw, draw.secondary), .fog = draw.inputs.fog != FogFactor::off};
  const PixelMesh mesh(draw, profile, varying);
  if (mesh.empty()) return files;
  write(name + ".ply", mesh.ply());
  Json effect{{"ninebit", "effect"},
              {"version", 1},
              {"title", "Captured: " + draw.call},
              {"profile", profile.name},
              {"size", Json::array({draw.width, draw.height})},
              {"scene",
               {{"mesh", name + ".ply"},
                {"camera", Json::array({0, 0, kCameraDistance})},
                {"look_at", Json::array({0, 0, 0})},
                {"fov", 2.0 * std::atan(1.0 / kCameraDistance) * 180.0 / kPi},
                {"light", Json::array({-1, 1, 1})}}}};
  Json pass = pass_of(draw, state, profile, program, varying, files);
  for (std::size_t i = 0; i < kLayerUnits; ++i) {
    if (draw.texels[i].empty()) {
      pass["units"].push_back(nullptr);
      continue;
    }
    const std::string texture = "texel" + std::to_string(i), file = name + '.' + texture + ".png";
    write(file, texture_file(draw.texels[i], draw.width, draw.height));
    effect["textures"][texture] = {{"source", file}, {"filter", "nearest"}, {"wrap", "clamp-to-edge"}};
    pass["units"].push_back({{"texture", texture}, {"coordinates", "screen"}, {"matrix", matrix_to(draw)}});
  }
  effect["passes"] = Json::array({pass});
  write(name + ".json", effect.dump(2) + '\n');
  return files;
}

}  // namespace ninebit::gl_layer
