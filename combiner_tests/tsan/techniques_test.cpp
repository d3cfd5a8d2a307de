// Every technique, its judge and every study, with one thread and with four: the same answer, and no race on the way.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>

#include "combiner_tests/raster/in_threads.h"
#include "combiner_tests/study/support.h"
#include "combiner_tests/support/index_room.h"
#include "combiner_tests/support/random.h"
#include "ninebit/combiner/program.h"
#include "ninebit/raster/texture.h"
#include "ninebit/scene/scene_io.h"
#include "ninebit/shadow/ground_truth.h"
#include "ninebit/shadow/technique.h"
#include "ninebit/study/datapath_error.h"
#include "ninebit/study/depth_packing_error.h"
#include "ninebit/study/exhaustive_sum.h"
#include "ninebit/study/index_steps.h"
#include "ninebit/study/program_error.h"
#include "ninebit/study/shadow_sweep.h"

namespace ninebit::test {
namespace {

constexpr int kThreads = 4;

// Wide enough for tiles and rows for all threads.
RenderSettings settings_of(const Technique& technique) {
  RenderSettings settings;
  settings.width = 200;
  settings.height = 150;
  settings.map_size = 64;
  settings.layers = true;
  settings.evidence = technique.name != "reflective";
  settings.light_cookie.cookie = noisy_cookie();
  settings.reflective.samples = 20;
  settings.reflective.gather_scale = 2;
  return settings;
}

struct Answer {
  Rendering rendering;
  std::vector<ErrorCause> cause;
};

Answer answer_of(const Technique& technique, const Scene& scene) {
  const RenderSettings settings = settings_of(technique);
  auto rendering = technique.render(scene, settings, {});
  if (!rendering) throw std::runtime_error(rendering.error().text());
  Answer answer{std::move(rendering).value(), {}};
  if (settings.evidence) {
    const auto rays = GroundTruthScene::make(scene);
    if (!rays) throw std::runtime_error(rays.error().text());
    const auto truth = measure(*rays, settings, answer.rendering);
    if (!truth) throw std::runtime_error(truth.error().text());
    answer.cause = truth->cause;
  }
  return answer;
}

TEST(TechniqueThreads, EachDrawsTheSame) {
  for (const Technique& technique : techniques()) {
    const Scene scene = index_room(technique.lights);
    std::optional<Answer> one, several;
    with_threads(1, [&] { one.emplace(answer_of(technique, scene)); });
    with_threads(kThreads, [&] { several.emplace(answer_of(technique, scene)); });
    const Rendering &a = one->rendering, &b = several->rendering;
    EXPECT_GT(a.lit, 5000U) << technique.name;
    for (int c = 0; c < 4; ++c) EXPECT_TRUE(a.frame.color(c) == b.frame.color(c)) << technique.name;
    EXPECT_TRUE(a.frame.stencil() == b.frame.stencil()) << technique.name;
    ASSERT_EQ(a.layers.size(), b.layers.size());
    for (std::size_t i = 0; i < a.layers.size(); ++i) EXPECT_TRUE(a.layers[i].samples == b.layers[i].samples);
    ASSERT_EQ(a.maps.size(), b.maps.size());
    for (std::size_t i = 0; i < a.maps.size(); ++i) EXPECT_TRUE(a.maps[i].samples == b.maps[i].samples);
    EXPECT_TRUE(one->cause == several->cause) << technique.name;
  }
}

// Up to `most` units, those of the studies' own tests being many.
std::vector<StudyRow> rows_of(const Study& study, std::size_t most, int threads) {
  std::vector<StudyRow> rows;
  with_threads(threads, [&] {
    for (std::size_t unit = 0; unit < std::min(study.units(), most); ++unit) {
      const auto more = study.run(unit, [] { return true; });
      if (!more) throw std::runtime_error(more.error().text());
      rows.insert(rows.end(), more->begin(), more->end());
    }
  });
  return rows;
}

TEST(StudyThreads, EachFindsTheSame) {
  const HardwareProfile small = small_profile(31);
  const auto state = index_variant_state(profiles::geforce2, StudyFormat::channel, index_variants()[0]);
  ASSERT_TRUE(state.ok());
  const Technique& index_cube = techniques().front();
  const ShadowGrid grid{{"map-size", {"32"}}};

  std::vector<std::unique_ptr<Study>> studies;
  studies.push_back(valid(index_steps_study({.profiles = {profiles::geforce2}, .first_step = 12})));
  studies.push_back(valid(make_depth_packing_study({.packings = {"rgba8-mod"},
                                                    .storages = {ChannelStorage::round},
                                                    .sets = {DepthSet::bits16},
                                                    .float_step = 4096})));
  studies.push_back(valid(datapath_study({.study = "datapath", .profile = "small"}, std::span(&small, 1))));
  studies.push_back(valid(exhaustive_sum_study({.study = "datapath", .profile = "small"}, small, kOutputForms)));
  studies.push_back(valid(program_error_study({.study = "datapath", .profile = "geforce2"}, profiles::geforce2,
                                              compile(*state, profiles::geforce2).value(),
                                              {.components = {{Register::texture0, kAlpha}}})));
  studies.push_back(valid(make_shadow_sweep({.study = "shadows", .profile = "geforce2"}, index_room(index_cube.lights),
                                            index_cube, settings_of(index_cube), grid)));
  for (const auto& study : studies) {
    const std::string& name = study->question().study;
    const std::vector<StudyRow> one = rows_of(*study, 4, 1), several = rows_of(*study, 4, kThreads);
    EXPECT_FALSE(one.empty()) << name;
    EXPECT_TRUE(one == several) << name;
    const auto report = study->report(several, std::min<std::size_t>(study->units(), 4));
    EXPECT_TRUE(report.ok()) << name;
  }
}

}  // namespace
}  // namespace ninebit::test
