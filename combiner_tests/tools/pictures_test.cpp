// The files of a rendering, read back with other people's libraries, and held against each other at every pixel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "combiner_tests/support/slow_build.h"
#include "combiner_tests/support/stored_pictures.h"
#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

using ninebit::Image8;
using ninebit::test::read_exr;
using ninebit::test::read_png;
using ninebit::test::StoredPart;

struct PictureCase {
  const char* name;
  std::string scene;
  Words flags;
  int step = 2;
  bool objects = false;  // what has the indices
  std::string format = "rgb";
};

void PrintTo(const PictureCase& c, std::ostream* out) {
  *out << c.name;
}

constexpr int kWidth = 120, kHeight = 90, kMap = 64;
constexpr std::size_t kPixels = std::size_t{kWidth} * kHeight;
constexpr double kFar = 0xFFFFFF;

// The number whose digits, to the base of how many codes a channel has, are the channels in steps; the first is the
// lowest.
double code_number(const std::vector<double>& channels, int step) {
  const int levels = 255 / step + 1;
  double number = 0.0, weight = 1.0;
  for (const double c : channels) {
    EXPECT_EQ(std::fmod(c, step), 0.0);
    number += weight * c / step;
    weight *= levels;
  }
  return number;
}

// The channels that hold an index of a format: those of a register, and those of index_cube.exr.
Words register_channels(const std::string& format) {
  if (format == "rgb") return {"R", "G", "B"};
  if (format == "la") return {"B", "A"};
  return {format == "l" ? "B" : "A"};
}
Words map_channels(const std::string& format) {
  if (format == "rgb") return {"R", "G", "B"};
  if (format == "la") return {"Y", "A"};
  return {format == "l" ? "Y" : "A"};
}

// A rendering with layers, made once for all tests.
struct Rendered {
  TempFolder folder;
  Json answer;
  std::vector<StoredPart> layers;
  std::map<std::string, std::map<std::string, std::vector<double>>> planes;  // of the layers, by part and channel
};

const Words kSizes{"--size", "120x90", "--map-size", "64", "--json"};

const Rendered& rendered(const PictureCase& c) {
  static std::map<std::string, Rendered> known;
  const auto [found, is_new] = known.try_emplace(c.name);
  Rendered& one = found->second;
  if (!is_new) return one;
  one.answer = json_of(ninebit(small_render(c.scene, one.folder / "out", kSizes + Words{"--layers"} + c.flags)));
  one.layers = read_exr(one.folder / "out/layers.exr");
  for (const StoredPart& part : one.layers) {
    for (const auto& [name, channel] : part.channels) one.planes[part.name][name] = channel.numbers();
  }
  return one;
}

class Pictures : public testing::TestWithParam<PictureCase> {
 protected:
  void SetUp() override {
    if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
    rendered_ = &rendered(GetParam());
    ASSERT_TRUE(rendered_->answer.is_object());
  }
  [[nodiscard]] std::string file(const std::string& name) const { return rendered_->folder / ("out/" + name); }
  [[nodiscard]] const std::vector<double>& plane(const std::string& part, const std::string& channel) const {
    return rendered_->planes.at(part).at(channel);
  }

  // The code number in that layer.
  [[nodiscard]] double number_in(const std::string& part, std::size_t pixel) const {
    std::vector<double> channels;
    for (const std::string& channel : register_channels(GetParam().format)) {
      channels.push_back(plane(part, channel)[pixel]);
    }
    return code_number(channels, GetParam().step);
  }

  // Polygons at equal depth are all compared. The layers show the first one; another one may have marked the pixel.
  void expect_marked_by_another(std::size_t pixel, double polygon) const {
    const std::string at = std::to_string(pixel % kWidth) + "," + std::to_string(pixel / kWidth);
    const Json traced =
        json_of(ninebit(Words{"trace", "--scene", GetParam().scene, "--pixel", at} + kSizes + GetParam().flags));
    int others = 0;
    for (const Json& pass : traced["scene"]["passes"]) {
      if (pass["name"] != "comparison") continue;
      for (const Json& fragment : pass["fragments"]) {
        if (fragment["fate"] == "written" && fragment["polygon"] != polygon) ++others;
      }
    }
    EXPECT_GT(others, 0);
  }

  const Rendered* rendered_ = nullptr;
};

INSTANTIATE_TEST_SUITE_P(
    All, Pictures,
    testing::Values(PictureCase{"room", kRoom, {}}, PictureCase{"engine", kEngine, {}},
                    PictureCase{"room_step_5", kRoom, {"--index-step", "5"}, 5},
                    PictureCase{"bunny_objects", kBunny, {"--index-scope", "object"}, 2, true},
                    PictureCase{"room_la", kRoom, {"--index-format", "la"}, 2, false, "la"},
                    PictureCase{"room_l_objects",
                                kRoom,
                                {"--index-format", "l", "--index-scope", "object", "--index-step", "3"},
                                3,
                                true,
                                "l"},
                    PictureCase{
                        "room_a_objects", kRoom, {"--index-format", "a", "--index-scope", "object"}, 2, true, "a"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST_P(Pictures, FilesHaveTheirShapes) {
  for (const auto& [name, width, height, channels] : {std::tuple{"color.png", kWidth, kHeight, 3},
                                                      {"shadow.png", kWidth, kHeight, 1},
                                                      {"index_cube.png", 4 * kMap, 3 * kMap, 3}}) {
    const Image8 picture = read_png(file(name));
    EXPECT_EQ(picture.width, width) << name;
    EXPECT_EQ(picture.height, height) << name;
    EXPECT_EQ(picture.channels, channels) << name;
  }
  const std::vector<std::pair<std::string, std::map<std::string, char>>> wanted{
      {"primary", {{"R", 'h'}, {"G", 'h'}, {"B", 'h'}, {"A", 'h'}}},
      {"texture0", {{"R", 'h'}, {"G", 'h'}, {"B", 'h'}, {"A", 'h'}}},
      {"spare0", {{"R", 'h'}, {"G", 'h'}, {"B", 'h'}, {"A", 'h'}}},
      {"spare1", {{"R", 'h'}, {"G", 'h'}, {"B", 'h'}, {"A", 'h'}}},
      {"output", {{"A", 'h'}}},
      {"stencil", {{"stencil", 'u'}}},
      {"depth", {{"depth", 'u'}}},
      {"polygon", {{"polygon", 'u'}}},
      {"object", {{"object", 'u'}}},
  };
  const std::vector<StoredPart>& layers = rendered_->layers;
  ASSERT_EQ(layers.size(), wanted.size());
  for (std::size_t p = 0; p < wanted.size(); ++p) {
    EXPECT_EQ(layers[p].name, wanted[p].first);
    EXPECT_EQ(layers[p].types(), wanted[p].second) << layers[p].name;
    EXPECT_EQ(layers[p].width, kWidth);
    EXPECT_EQ(layers[p].height, kHeight);
    EXPECT_FALSE(layers[p].cube);
  }
}

// The result of the article's stages for the two indices, pixel by pixel.
TEST_P(Pictures, LayersAgreeWithEachOther) {
  const auto& stencil = plane("stencil", "stencil");
  const auto& depth = plane("depth", "depth");
  const auto& polygon = plane("polygon", "polygon");
  const auto& object = plane("object", "object");
  const auto& alpha = plane("output", "A");
  const auto& index = GetParam().objects ? object : polygon;
  const double triangles = rendered_->answer["triangles"].get<double>();
  std::map<double, double> object_of;
  std::uint64_t background = 0, lit = 0, shadowed = 0, tied = 0;
  for (std::size_t i = 0; i < kPixels; ++i) {
    SCOPED_TRACE("pixel " + std::to_string(i % kWidth) + ", " + std::to_string(i / kWidth));
    double squares = 0.0;
    for (const std::string& channel : register_channels(GetParam().format)) {
      const double difference = plane("primary", channel)[i] - plane("texture0", channel)[i];
      const double scaled = std::clamp(4.0 * difference, -255.0, 255.0);
      // A luminance alone is compared in the alpha portions.
      ASSERT_EQ(plane("spare0", GetParam().format == "l" ? "A" : channel)[i], scaled);
      squares += scaled * scaled;
    }
    ASSERT_EQ(plane("spare1", GetParam().format == "rgb" ? "B" : "A")[i],
              depth[i] == kFar ? 0.0 : std::min(std::floor(4.0 * squares / 255.0), 255.0));
    ASSERT_EQ(alpha[i], plane("spare1", GetParam().format == "rgb" ? "B" : "A")[i]);
    if (depth[i] == kFar) {
      ++background;
      for (const double value : {polygon[i], object[i], alpha[i], stencil[i], number_in("primary", i)})
        ASSERT_EQ(value, 0);
      continue;
    }
    ASSERT_GE(polygon[i], 1);
    ASSERT_LE(polygon[i], triangles);
    ASSERT_GE(object[i], 1);
    ASSERT_EQ(object_of.try_emplace(polygon[i], object[i]).first->second, object[i]);
    ASSERT_EQ(number_in("primary", i), index[i]);
    const bool same = number_in("texture0", i) == index[i];
    ASSERT_EQ(alpha[i] == 0, same);
    if (stencil[i] == 0 || !same) {
      ASSERT_EQ(stencil[i], same ? 0 : 1);
    } else {
      ASSERT_EQ(stencil[i], 1);
      expect_marked_by_another(i, polygon[i]);
      ++tied;
    }
    ++(stencil[i] == 0 ? lit : shadowed);
  }
  EXPECT_EQ(rendered_->answer["pixels"], (Json{{"background", background}, {"lit", lit}, {"shadowed", shadowed}}));
  EXPECT_LT(tied, 10U);
  EXPECT_GT(lit, kPixels / 20);
  EXPECT_GT(shadowed, kPixels / 200);
  EXPECT_GT(object_of.size(), 20U) << "polygons in view";
}

TEST_P(Pictures, PngsAgreeWithTheLayers) {
  const Image8 color = read_png(file("color.png")), shadow = read_png(file("shadow.png"));
  const auto& stencil = plane("stencil", "stencil");
  const auto& depth = plane("depth", "depth");
  ASSERT_EQ(shadow.pixels.size(), kPixels);
  ASSERT_EQ(color.pixels.size(), 3 * kPixels);
  std::set<std::array<unsigned char, 3>> behind, drawn;
  for (std::size_t i = 0; i < kPixels; ++i) {
    ASSERT_EQ(shadow.pixels[i], stencil[i] != 0 ? 255 : 0) << i;
    (depth[i] == kFar ? behind : drawn).insert({color.pixels[3 * i], color.pixels[3 * i + 1], color.pixels[3 * i + 2]});
  }
  EXPECT_LE(behind.size(), 1U);
  EXPECT_GT(drawn.size(), 20U);
}

TEST_P(Pictures, TheCubeHoldsTheIndicesThatWereFetched) {
  const auto parts = read_exr(file("index_cube.exr"));
  ASSERT_EQ(parts.size(), 1U);
  const StoredPart& cube = parts[0];
  EXPECT_TRUE(cube.cube);
  ASSERT_EQ(cube.width, kMap);
  ASSERT_EQ(cube.height, 6 * kMap);
  std::map<std::string, char> types{{"index", 'u'}};
  for (const std::string& channel : map_channels(GetParam().format)) types[channel] = 'h';
  EXPECT_EQ(cube.types(), types);
  const std::vector<double> index = cube.channels.at("index").numbers();
  std::set<double> seen;
  for (std::size_t i = 0; i < index.size(); ++i) {
    std::vector<double> bytes;
    for (const std::string& channel : map_channels(GetParam().format)) {
      bytes.push_back(std::round(cube.channels.at(channel).reals[i] * 255.0));
    }
    ASSERT_EQ(code_number(bytes, GetParam().step), index[i]) << i;
    seen.insert(index[i]);
  }
  EXPECT_LE(*seen.rbegin(), rendered_->answer["index"]["used"].get<double>());
  for (std::size_t i = 0; i < kPixels; ++i) {
    if (plane("depth", "depth")[i] == kFar) continue;
    const double number = number_in("texture0", i);
    ASSERT_TRUE(seen.contains(number)) << "pixel " << i << " fetched " << number;
  }
}

// The cross has every index in a colour of its own; faces lie as ARB_texture_cube_map orients them, s to the right and
// t down, which OpenEXR mirrors.
TEST_P(Pictures, TheCrossShowsTheCube) {
  const Image8 cross = read_png(file("index_cube.png"));
  const auto parts = read_exr(file("index_cube.exr"));
  const std::vector<double> index = parts.at(0).channels.at("index").numbers();
  constexpr std::array<std::array<int, 2>, 6> kPlace{{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}};
  std::map<double, std::set<std::array<unsigned char, 3>>> colors;
  for (std::size_t face = 0; face < 6; ++face) {
    const bool is_y = face == 2 || face == 3;
    for (int y = 0; y < kMap; ++y) {
      for (int x = 0; x < kMap; ++x) {
        const int row = static_cast<int>(face) * kMap + (is_y ? kMap - 1 - y : y), column = is_y ? x : kMap - 1 - x;
        const auto at = static_cast<std::size_t>(row * kMap + column);
        const auto pixel =
            static_cast<std::size_t>(((kPlace[face][1] * kMap + y) * 4 * kMap + kPlace[face][0] * kMap + x) * 3);
        colors[index.at(at)].insert({cross.pixels[pixel], cross.pixels[pixel + 1], cross.pixels[pixel + 2]});
      }
    }
  }
  std::set<std::array<unsigned char, 3>> different;
  for (const auto& [number, shades] : colors) {
    ASSERT_EQ(shades.size(), 1U) << "index " << number;
    different.insert(*shades.begin());
    const bool black = *shades.begin() == std::array<unsigned char, 3>{0, 0, 0};
    EXPECT_EQ(black, number == 0) << "index " << number;
  }
  EXPECT_GT(different.size(), colors.size() / 4);
}

}  // namespace
}  // namespace tools_test
