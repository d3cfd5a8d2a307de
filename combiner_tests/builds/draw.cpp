// Draws each scene that it is given with every technique, as scenes/expected_hashes.json says, and prints the hashes:
// a line of tab-separated words for each, SCENE, FLAGS, PLANES, HASH; before them the vector code that drew.
#include <fmt/format.h>
#include <hwy/highway.h>

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "ninebit/scene/scene_io.h"
#include "ninebit/shadow/technique.h"
#include "src/image/texture/texture_file.h"
#include "src/tools/common/picture_hashes.h"

namespace {

using namespace ninebit;

template <class T>
T valid(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().text());
  return std::move(result).value();
}

struct Way {
  std::string_view technique;
  std::string_view flags;  // as in the file, after the size
};
constexpr Way kWays[]{
    {"index-cube", ""},
    {"depth-cube", " --technique depth-cube --depth-bits 16"},
    {"shadow-map", " --technique shadow-map"},
    {"shadow-volume", " --technique shadow-volume"},
    {"reflective", " --technique reflective --light-type directional --samples 40"},
    {"light-cookie", " --technique light-cookie --cookie scenes/cookies/labels.dds"},
};

void draw(const std::string& file, const Way& way) {
  const Technique& technique = *find_technique(way.technique);
  const bool slow = technique.name == "reflective";
  RenderSettings settings;
  settings.width = slow ? 160 : 320;
  settings.height = slow ? 120 : 240;
  settings.map_size = slow ? 128 : 256;
  settings.depth_cube.bits = DepthCubeBits::sixteen;
  settings.reflective.samples = 40;
  settings.light_cookie.cookie = std::make_shared<Texture>(
      valid(image_detail::read_texture(settings.profile, "scenes/cookies/labels.dds", {}, {})));
  SceneSetup setup;
  setup.light_kinds = technique.lights;
  if (slow) setup.light_kinds = {.point = false, .spot = false, .directional = true};
  const Scene scene = valid(complete_scene(valid(read_scene(file)), setup, 4.0F / 3.0F));
  const Rendering rendering = valid(technique.render(scene, settings, {}));
  for (const auto& [planes, hash] : tools::picture_hashes(rendering)) {
    // Shadow volumes have no map.
    const std::string map = way.technique == "shadow-volume" ? "" : fmt::format(" --map-size {}", settings.map_size);
    fmt::print("{}\t--size {}x{}{}{}\t{}\t{}\n", std::filesystem::path(file).filename().string(), settings.width,
               settings.height, map, way.flags, planes, hash);
  }
}

}  // namespace

int main(int count, char** files) try {
  fmt::print("{}\n", hwy::TargetName(HWY_STATIC_TARGET));
  for (int i = 1; i < count; ++i) {
    for (const Way& way : kWays) draw(files[i], way);
  }
} catch (const std::exception& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 1;
}
