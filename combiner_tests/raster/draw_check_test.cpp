// check_draw: what OpenGL accepts, and one may not expect.
#include <gtest/gtest.h>

#include "combiner_tests/raster/texture_support.h"
#include "ninebit/language/rc10.h"

namespace ninebit::test {
namespace {

using Warnings = std::vector<std::string>;

Warnings warnings_of(const std::string& program, std::span<const TextureUnit> units) {
  const auto parsed = parse_rc10({"!!RC1.0\n" + program, "test"}, profiles::geforce2);
  EXPECT_TRUE(parsed) << program;
  PipelineState state;
  state.program = compile(*parsed, profiles::geforce2).value();
  const auto found = check_draw(state, units);
  EXPECT_TRUE(found);
  return *found;
}

// The reasons agree with is_complete, whose cases CompletenessIsThatOfTheSpecification has.
TEST(DrawCheck, SaysWhyAUnitIsOff) {
  Random random(46);
  const Texture flat = random_texture(random, TextureTarget::texture_2d, InternalFormat::rgb8, 8, 2, false);
  const Texture cube = random_texture(random, TextureTarget::cube_map, InternalFormat::rgb8, 4, 4, true);
  const Texture rectangle = random_texture(random, TextureTarget::rectangle, InternalFormat::rgb8, 5, 3, false);
  Texture faceless = cube, shrunk = cube, swapped = cube;
  faceless.faces[3].clear();
  shrunk.faces[5].erase(shrunk.faces[5].begin());
  std::swap(swapped.faces[2][1], swapped.faces[2][2]);
  const Texture empty;
  const auto why = [](const Texture& texture, const Sampler& sampler) {
    const std::vector<TextureUnit> units{{&texture, sampler}};
    const Warnings found = warnings_of("out.rgb = tex0;\n", units);
    EXPECT_EQ(found.empty(), TextureSampler::make(profiles::geforce2, texture, sampler).has_value());
    const std::string start = "texture unit 0 is off, because its texture is incomplete: ";
    EXPECT_TRUE(found.empty() || found[0].starts_with(start)) << found[0];
    return found.empty() ? "" : found[0].substr(start.size());
  };
  EXPECT_EQ(why(flat, kNearestSampler), "");
  EXPECT_EQ(why(flat, {}), "its filter reads mip-maps, and level 1 (4 × 1 texels) is missing");
  EXPECT_EQ(why(with_mipmaps(flat).value(), {}), "");
  EXPECT_EQ(why(cube, {}), "");
  EXPECT_EQ(why(empty, kNearestSampler), "it has no level 0");
  EXPECT_EQ(why(rectangle, {}), "its filter reads mip-maps, which rectangles do not have");
  EXPECT_EQ(why(faceless, kNearestSampler), "level 0 of face 3 (4 × 4 texels) is missing");
  EXPECT_EQ(why(shrunk, kNearestSampler), "level 0 of face 5 has 2 × 2 texels; expected 4 × 4");
  EXPECT_EQ(why(swapped, {}), "its filter reads mip-maps, and level 1 of face 2 has 1 × 1 texels; expected 2 × 2");
  EXPECT_EQ(why(swapped, kNearestSampler), "");
}

// A texture register that a stage writes before another reads it needs no texture.
TEST(DrawCheck, SaysWhichUnitsAreMissing) {
  const Warnings missing{"the program reads texture unit 1, which has no texture; the extension's default applies"};
  EXPECT_EQ(warnings_of("{ rgb { spare0 = tex1 * col0; } }\nout.rgb = spare0;\n", {}), missing);
  EXPECT_EQ(warnings_of("{ rgb { spare0 = col0 * col0; } }\nout.rgb = tex1;\n", {}), missing);
  EXPECT_EQ(warnings_of("{ rgb { tex1 = col0 * col0; } }\n{ rgb { spare0 = tex1 * col0; } }\nout.rgb = spare0;\n", {}),
            Warnings{});
  Random random(46);
  const Texture flat = random_texture(random, TextureTarget::texture_2d, InternalFormat::rgb8, 8, 2, false);
  const std::vector<TextureUnit> units{{}, {&flat, kNearestSampler}};
  EXPECT_EQ(warnings_of("out.rgb = tex1;\n", units), Warnings{});
}

// The stages decide what the registers hold.
TEST(DrawCheck, NamesInconsistentStages) {
  PipelineState state;
  state.profile = profiles::nv2a;
  state.texture_shader.enabled = true;
  state.texture_shader.stage[0].operation = TextureOperation::texture_2d;
  Random random(46);
  const Texture flat = random_texture(random, TextureTarget::texture_2d, InternalFormat::rgb8, 8, 2, false);
  const std::vector<TextureUnit> units{{&flat, {}}};
  const auto found = check_draw(state, units);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->size(), 2U);
  EXPECT_TRUE((*found)[0].starts_with("texture unit 0 is off"));
  EXPECT_EQ((*found)[1], texture_shader_warnings(state, units)->at(0));
  state.texture_shader.stage[0].operation = TextureOperation::offset_2d;
  EXPECT_FALSE(check_draw(state, units));
}

}  // namespace
}  // namespace ninebit::test
