// Parts of effects that pictures show only together: clears, constants, warnings, records.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "combiner_tests/effect/program_reader.h"
#include "ninebit/combiner/program.h"
#include "src/effect/combiner_record.h"
#include "src/effect/effect_inputs.h"
#include "src/effect/effect_targets.h"

namespace ninebit::test {
namespace {

// A pass that is not the first clears what it names. If that is all, the draw does it.
TEST(EffectParts, AClearOfSomePlanesKeepsTheOthers) {
  Surface surface = Surface::make(4, 4).value();
  surface.fill({.color = {10, 20, 30, 40}, .depth = 0.5, .stencil = 7});
  RenderTarget target = surface.target();
  EffectClear clear{.color = false, .depth = true, .stencil = true};
  clear.values = {.color = {1, 2, 3, 4}, .depth = 0.0, .stencil = 9};
  const auto later = clear_before_pass(clear, profiles::geforce2, target, false);
  ASSERT_TRUE(later);
  EXPECT_FALSE(later->has_value());
  EXPECT_EQ(surface.color(kRed)[5], 10);
  EXPECT_EQ(surface.depth()[5], 0U);
  EXPECT_EQ(surface.stencil()[5], 9);

  const auto first = clear_before_pass(clear, profiles::geforce2, target, true);
  ASSERT_TRUE(first);
  ASSERT_TRUE(first->has_value());
  EXPECT_EQ((*first)->color, (std::array<std::uint8_t, 4>{})) << "a target's first content";
  EXPECT_EQ((*first)->depth, 0.0);
  clear.color = true;
  const auto all = clear_before_pass(clear, profiles::geforce2, target, false);
  ASSERT_TRUE(all);
  ASSERT_TRUE(all->has_value());
  EXPECT_EQ((*all)->color, clear.values.color);
  EXPECT_EQ(surface.color(kRed)[5], 10) << "the draw clears it";
}

// Constants of one combiner leave those of the others as they are for all.
TEST(EffectParts, ConstantsOfOneCombiner) {
  const EffectReaders readers = reader_of(
      "!!RC1.0\n{ rgb { spare0 = const0 * const1; } }\n{ rgb { spare0 = const0 * const1; } }\nout.rgb = spare0;\n");
  EffectPass pass{.name = "draw"};
  pass.program = "p";
  pass.constants.global = {ColorF{1, 0, 0, 0}, ColorF{0, 1, 0, 0}};
  pass.constants.of_combiner[1][0] = ColorF{0, 0, 1, 0};
  std::vector<std::string> warnings;
  const auto program = effect_program({}, pass, profiles::nv2a, readers, warnings);
  ASSERT_TRUE(program) << program.error().text();
  EXPECT_EQ(program->combiners.general[0].constant0[0], 255);
  EXPECT_EQ(program->combiners.general[0].constant1[1], 255);
  EXPECT_EQ(program->combiners.general[0].constant0[2], 0);
  EXPECT_EQ(program->combiners.general[1].constant0[2], 255);
  EXPECT_EQ(program->combiners.general[1].constant1[1], 255);
  EXPECT_EQ(program->combiners.general[1].constant1[0], 0);
}

// A rectangle is read with its own sides where the readers can do that.
TEST(EffectParts, RectanglesKeepTheirSides) {
  EffectReaders readers;
  const auto texture_of = [](TextureTarget target, int width, int height) {
    TextureSamples samples{.width = width, .height = height};
    samples.samples = std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width * height));
    return make_texture(target, InternalFormat::rgb8, {{samples}});
  };
  readers.texture = [&](std::span<const std::filesystem::path>, const HardwareProfile&) {
    return texture_of(TextureTarget::texture_2d, 4, 8);
  };
  EffectTexture texture{.name = "t", .origin = TextureOrigin::rectangle, .files = {"odd.png"}};
  texture.sampler.min_filter = MinFilter::nearest;
  const auto resampled = effect_texture({}, texture, profiles::nv2a, readers);
  ASSERT_TRUE(resampled) << resampled.error().text();
  EXPECT_EQ(resampled->faces[0][0].width, 4);
  EXPECT_EQ(resampled->target, TextureTarget::rectangle);
  readers.rectangle = [&](const std::filesystem::path& file, const HardwareProfile&) {
    EXPECT_EQ(file.filename(), "odd.png");
    return texture_of(TextureTarget::rectangle, 3, 5);
  };
  const auto kept = effect_texture({}, texture, profiles::nv2a, readers);
  ASSERT_TRUE(kept) << kept.error().text();
  EXPECT_EQ(kept->faces[0][0].width, 3);
  EXPECT_EQ(kept->faces[0][0].height, 5);
}

// A near square before a far one. In the left half the stencil test keeps the near one from writing its depth, so that
// the far one is the last that passes the depth test. An alpha test that the near one fails changes nothing.
TEST(EffectParts, ARecordHasTheFragmentsOfTheDraw) {
  constexpr int kSide = 8;
  PipelineState state;
  state.shade_model = ShadeModel::flat;
  state.depth_test = {.enabled = true, .function = CompareFunction::less, .write = true};
  state.stencil_test = {.enabled = true, .front = {.function = CompareFunction::equal, .reference = 1}};
  state.alpha_test = {.enabled = true, .function = CompareFunction::greater, .reference = 0};
  // Alpha is the primary colour's blue: 0 for the near one. Its red tells them apart.
  const auto combiners = reader_of(
                             "!!RC1.0\n{ rgb { spare0 = col0 * col0; } alpha { spare0 = col0.b * col0.b; } }\n"
                             "out.rgb = col0; out.a = spare0.a;\n")
                             .program({}, profiles::geforce2);
  ASSERT_TRUE(combiners) << combiners.error().text();
  state.program = compile(combiners->state, profiles::geforce2).value();
  std::vector<glm::vec3> positions;
  for (const float z : {-0.5F, 0.5F}) {
    for (const glm::vec2 p : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
      positions.emplace_back(p, z);
    }
  }
  const std::array<ColorBytes, 2> colors{ColorBytes{200, 0, 0, 255}, ColorBytes{100, 0, 255, 255}};
  const VertexArrays arrays{.type = PrimitiveType::quads, .positions = positions, .primitive_colors = colors};
  Surface surface = Surface::make(kSide, kSide).value();
  surface.fill({});
  RenderTarget target = surface.target();
  for (int y = 0; y < kSide; ++y) {
    for (int x = kSide / 2; x < kSide; ++x) target.stencil.at(x, y) = 1;
  }
  const glm::mat4 projection(1.0F);
  const std::optional<ClearValues> no_clear;
  const auto record = record_combiners({state, projection, arrays, {}, no_clear}, target);
  ASSERT_TRUE(record) << record.error().text();
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const auto at = static_cast<std::size_t>(y * kSide + x);
      const int red = x < kSide / 2 ? 100 : 200;
      ASSERT_TRUE(record->drawn[at]);
      ASSERT_EQ(record->inputs[static_cast<std::size_t>(
                    std::find(kRecordedRegisters.begin(), kRecordedRegisters.end(), Register::primary) -
                    kRecordedRegisters.begin())][0][at],
                red)
          << x;
      ASSERT_EQ(int{record->output[0][at]}, red) << x;
    }
  }
}

}  // namespace
}  // namespace ninebit::test
