// Effects as JSON: what is read, and where faults are found.
#include "ninebit/effect/effect_json.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

namespace ninebit::test {
namespace {

constexpr const char* kHead = R"({"ninebit": "effect", "version": 1,)";

Parsed<Effect> parse(const std::string& body) {
  const std::string text = kHead + body + "}";
  return parse_effect({text, "e.json"});
}

TEST(EffectJson, ReadsAllOfAPass) {
  const auto parsed = parse(R"(
    "title": "t", "profile": "nv2a", "size": [64, 32], "color_format": "r5g6b5", "depth_stencil": "d16",
    "scene": {"mesh": "cube", "camera": [0, 1, 5], "fov": 30, "light": [1, 2, 3], "light_type": "spot", "floor": -1},
    "textures": {"a": {"source": "normals:h.png", "steepness": 2, "filter": "linear", "wrap": "clamp"},
                 "c": {"source": "k.png", "filter": "nearest", "wrap": "clamp-to-border", "border_color": [1, 0, 0.5, 1],
                       "border_texels": true, "color_key": "kill:00fF00FF"},
                 "b": {"source": "target:m"}, "d": {"source": "k.png", "cylinder_wrap": "t"}},
    "targets": {"m": {"size": 16, "cube": true, "format": "rgb8", "color_format": "x1a7r8g8b8_o"},
                "s": {"size": 8, "samples": "square_offset_4"}},
    "passes": [{"target": "m", "primary": "index:la,3", "polygon_mode": "point", "point_size": 3.5,
                "units": [{"texture": "a", "coordinates": "point-sprite"}]},
               {"polygon_mode": "line", "line_width": 2.5, "line_smooth": true},
               {"polygon_smooth": true, "polygon_stipple": "1000,0110"},
               {"name": "last", "program": "p.rc1", "constants": {"const1": [0, 0.5, 1, 0.25]},
                "units": [null, {"texture": "b", "coordinates": "from-light",
                                 "matrix": [[1,2,3,4],[5,6,7,8],[9,10,11,12],[13,14,15,16]]}],
                "secondary": "constant:1,0,0.5", "fog": {"factor": "exp:0.5", "color": [1, 0, 0]},
                "clear": {"color": [1, 1, 1, 0], "stencil": 3}, "shade": "flat", "cull": "back", "color_mask": "ra",
                "depth": {"function": "equal", "write": false}, "alpha_test": {"function": "greater", "reference": 7},
                "stencil": {"function": "equal", "reference": 1, "mask": 15, "write_mask": 3, "fail": "zero",
                            "depth_fail": "incr", "pass": "invert"},
                "blend": {"source": "src_alpha", "destination": "one", "equation": "subtract"},
                "polygon_offset": [1, 2]}])");
  ASSERT_TRUE(parsed) << parsed.faults()[0].text();
  const Effect& e = *parsed;
  EXPECT_EQ(e.width, 64);
  EXPECT_EQ(e.height, 32);
  EXPECT_EQ(e.color_format, ColorFormat::r5g6b5);
  EXPECT_EQ(e.targets[0].color_format, ColorFormat::x1a7r8g8b8_o);
  EXPECT_EQ(e.depth_stencil, DepthStencilFormat::d16);
  EXPECT_EQ(e.profile, "nv2a");
  EXPECT_EQ(e.scene.setup.floor, FloorChoice::at_height);
  EXPECT_TRUE(e.scene.setup.light_kinds.spot);
  EXPECT_FALSE(e.scene.setup.light_kinds.point);
  EXPECT_EQ(e.textures[0].origin, TextureOrigin::normals);
  EXPECT_EQ(e.textures[0].sampler.wrap_s, Wrap::clamp);
  const Sampler& keyed = e.textures[1].sampler;
  EXPECT_EQ(keyed.wrap_t, Wrap::clamp_to_border);
  EXPECT_EQ(keyed.border_color, (std::array<float, 4>{1.0F, 0.0F, 0.5F, 1.0F}));
  EXPECT_TRUE(keyed.border_texels);
  EXPECT_EQ(e.textures[3].sampler.cylinder_wrap, (std::array<bool, 2>{false, true}));
  EXPECT_EQ(keyed.color_key.operation, ColorKeyOperation::kill);
  EXPECT_EQ(keyed.color_key.key, 0x00FF00FFU);
  EXPECT_EQ(e.textures[2].sampler.min_filter, MinFilter::nearest) << "the default of targets";
  EXPECT_TRUE(e.targets[0].cube);
  EXPECT_EQ(e.targets[1].samples, SampleMode::square_offset_4);
  ASSERT_EQ(e.passes.size(), 4U);
  EXPECT_EQ(e.passes[0].state.back_mode, PolygonMode::point);
  EXPECT_EQ(e.passes[0].state.point_size, 3.5F);
  EXPECT_EQ(e.passes[0].units[0].coordinates.source, VertexSource::point_sprite);
  EXPECT_EQ(e.passes[1].state.front_mode, PolygonMode::line);
  EXPECT_EQ(e.passes[1].state.line_width, 2.5F);
  EXPECT_TRUE(e.passes[1].state.line_smooth && !e.passes[1].state.polygon_smooth);
  EXPECT_TRUE(e.passes[2].state.polygon_smooth);
  ASSERT_TRUE(e.passes[2].state.polygon_stipple.has_value());
  for (std::size_t y = 0; y < 32; ++y) {
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ((*e.passes[2].state.polygon_stipple)[4 * y + i], y % 2 == 0 ? 0x66 : 0x88) << "the last row is row 0";
    }
  }
  EXPECT_EQ(e.passes[0].name, "pass 1");
  EXPECT_EQ(e.passes[0].primary.index_format, IndexFormat::luminance_alpha);
  EXPECT_EQ(e.passes[0].primary.index_step, 3);
  EXPECT_TRUE(e.passes[0].state.depth_test.enabled) << "a mesh's default";
  const EffectPass& p = e.passes[3];
  EXPECT_FALSE(p.constants.global[0].has_value());
  EXPECT_EQ(p.constants.global[1], (ColorF{0.0F, 0.5F, 1.0F, 0.25F}));
  EXPECT_EQ(p.units[1].coordinates.matrix[0], glm::vec4(1, 5, 9, 13)) << "rows become glm's columns";
  EXPECT_EQ(p.fog.mode, FogMode::exp);
  EXPECT_EQ(p.fog.color[0], 255);
  EXPECT_TRUE(p.clear.color && p.clear.stencil && !p.clear.depth);
  EXPECT_EQ(p.state.color_mask, (std::array<bool, 4>{true, false, false, true}));
  EXPECT_EQ(p.state.depth_test.function, CompareFunction::equal);
  EXPECT_FALSE(p.state.depth_test.write);
  EXPECT_EQ(p.state.alpha_test.reference, 7);
  EXPECT_EQ(p.state.stencil_test.front.depth_pass, StencilOperation::invert);
  EXPECT_EQ(p.state.stencil_test.front.write_mask, 3);
  EXPECT_EQ(p.state.blend.equation, BlendEquation::subtract);
  EXPECT_EQ(p.state.polygon_offset.units, 2.0F);
}

struct Bad {
  const char* body;
  int line;
  const char* words;
};

TEST(EffectJson, NamesEveryMistakeWithItsPlace) {
  const std::vector<Bad> table{
      {R"("passes": [])", 1, "0 passes"},
      {R"("targets": {"m": {"size": 4}}, "passes": [{"target": "m"}])", 1, "no pass draws the picture"},
      {"\n\"passes\": [{\"programm\": \"x\"}]", 2, "unknown key \"programm\""},
      {"\n\"color_format\": \"rgb565\", \"passes\": [{}]", 2, "colour format"},
      {"\n\"color_format\": \"b8\",\n\"passes\": [{\"blend\": {\"source\": \"one\", \"destination\": \"one\"}}]", 3,
       "blends into target 'picture' of format b8, which the chip does not"},
      {"\n\"size\": [0, 4], \"passes\": [{}]", 2, "whole number from 1"},
      {"\n\"passes\": [{}, \n{\"units\": [{\"texture\": \"nothing\"}]}]", 3, "unknown texture 'nothing'"},
      {"\n\"passes\": [{\"target\": \"nowhere\"}]", 2, "unknown target 'nowhere'; expected 'picture'"},
      {"\n\"targets\": {\"a\\u001bb\": {\"size\": 4}}, \"passes\": [{\"target\": \"\\n\"}]", 2,
       "unknown target '\\n'; expected 'picture', 'a\\x1bb'"},
      {"\n\"passes\": [{\"draw\": \"mesh\"}]", 2, "the effect has none"},
      {"\n\"passes\": [{\"primary\": \"uv\"}]", 2, "is not a source of colours"},
      {"\n\"passes\": [{\"primary\": \"constant:2,0,0\"}]", 2, "numbers from 0 to 1"},
      {"\n\"passes\": [{\"primary\": \"index\"}]", 2, "only for the primary colour of a mesh"},
      {"\n\"passes\": [{\"fog\": {\"factor\": \"linear:1,1\"}}]", 2, "two different distances"},
      {"\n\"passes\": [{\"color_mask\": \"rr\"}]", 2, "not a colour mask"},
      {"\n\"passes\": [{\"depth\": {\"function\": \"smaller\"}}]", 2, "expected never, less"},
      {"\n\"passes\": [{\"name\": \"a\"}, {\"name\": \"a\"}]", 2, "defined twice"},
      {"\n\"passes\": [{\"polygon_mode\": \"lines\"}]", 2, "not a polygon mode; expected fill, line or point"},
      {"\n\"passes\": [{\"point_size\": 65}]", 2, "64"},
      {"\n\"passes\": [{\"polygon_stipple\": \"10,0\"}]", 2, "not a stipple pattern"},
      {"\n\"passes\": [{\"polygon_stipple\": \"101\"}]", 2, "not a stipple pattern"},
      {"\n\"passes\": [{\"polygon_stipple\": \"\"}]", 2, "not a stipple pattern"},
      {"\n\"passes\": [{\"polygon_stipple\": \"10,01\", \"polygon_mode\": \"line\"}]", 2,
       "polygon stipple has no effect here; expected polygon mode fill"},
      {"\n\"passes\": [{\"polygon_smooth\": true, \"polygon_mode\": \"point\"}]", 2,
       "polygon smoothing has no effect here; expected polygon mode fill"},
      {"\n\"passes\": [{\"line_smooth\": true}]", 2, "line smoothing has no effect here; expected polygon mode line"},
      {"\n\"passes\": [{\"line_width\": 2}]", 2, "a line width has no effect here; expected polygon mode line"},
      {"\n\"passes\": [{\"point_size\": 2}]", 2, "a point size has no effect here; expected polygon mode point"},
      {"\n\"textures\": {\"t\": {\"source\": \"gradient\"}},\n"
       "\"passes\": [{\"units\": [{\"texture\": \"t\", \"coordinates\": \"point-sprite\"}]}]",
       3, "unit 0: point-sprite coordinates need polygon mode point"},
      {"\n\"textures\": {\"t\": {\"source\": \"gradient\"}},\n"
       "\"passes\": [{\"polygon_mode\": \"point\", \"units\": [{\"texture\": \"t\", \"coordinates\": "
       "\"point-sprite\", \"matrix\": [[2,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}]}]",
       3, "unit 0: point-sprite coordinates have no matrix"},
      {"\n\"passes\": [{\"primary\": \"point-sprite\"}]", 2, "is not a source of colours"},
      {"\n\"targets\": {\"m\": {\"size\": 4, \"samples\": \"4\"}}, \"passes\": [{}]", 2,
       "not a sample mode; expected center_1, center_corner_2 or square_offset_4"},
      {"\n\"targets\": {\"m\": {\"size\": 4, \"cube\": true, \"samples\": \"square_offset_4\"}}, \"passes\": [{}]", 2,
       "is a cube map; expected one sample a pixel"},
      {"\n\"textures\": {\"t\": {\"source\": \"gradient\", \"wrap\": \"border\"}}, \"passes\": [{}]", 2,
       "mirrored-repeat or clamp-to-border"},
      {"\n\"textures\": {\"t\": {\"source\": \"gradient\", \"cylinder_wrap\": \"u\"}}, \"passes\": [{}]", 2,
       "expected s, t or st"},
      {"\n\"textures\": {\"t\": {\"source\": \"gradient\", \"wrap\": \"clamp\", \"cylinder_wrap\": \"s\"}}, "
       "\"passes\": [{}]",
       2, "a cylinder wrap has no effect with this wrap mode; expected repeat"},
      {"\n\"textures\": {\"t\": {\"source\": \"gradient\", \"border_color\": [2, 0, 0, 0]}}, \"passes\": [{}]", 2,
       "from 0"},
      {"\n\"textures\": {\"t\": {\"source\": \"gradient\", \"color_key\": \"kill:FF00FF\"}}, \"passes\": [{}]", 2,
       "not a colour key; expected alpha, rgba or kill"},
      {"\n\"textures\": {\"t\": {\"source\": \"gradient\", \"color_key\": \"drop:00FF00FF\"}}, \"passes\": [{}]", 2,
       "not a colour key"},
      {"\n\"targets\": {\"picture\": {\"size\": 4}}, \"passes\": [{}]", 2, "name of the picture"},
      {"\n\"targets\": {\"m\": {\"size\": [4, 8], \"cube\": true}}, \"passes\": [{}]", 2, "not square"},
      {"\n\"textures\": {\"t\": {\"source\": \"checker:3\"}}, \"passes\": [{}]", 2, "power of two"},
      {"\n\"textures\": {\"t\": {\"source\": \"a,b\"}}, \"passes\": [{}]", 2, "six faces"},
      {"\n\"textures\": {\"t\": {\"source\": \"target:x\"}}, \"passes\": [{}]", 2, "unknown target 'x'"},
      {"\n\"textures\": {\"t\": {\"source\": \"f.png\", \"steepness\": 1}}, \"passes\": [{}]", 2, "only for normals"},
      {"\n\"textures\": {\"t\": {\"source\": \"target:picture\"}},\n\"passes\": [{\"units\": [{\"texture\": \"t\"}]}]",
       3, "which this pass draws into"},
      {"\n\"targets\": {\"m\": {\"size\": 4}}, \"textures\": {\"t\": {\"source\": \"target:m\"}},\n"
       "\"passes\": [{\"units\": [{\"texture\": \"t\"}]}]",
       3, "no earlier pass draws"},
  };
  for (const Bad& bad : table) {
    const auto parsed = parse(bad.body);
    ASSERT_FALSE(parsed) << bad.body;
    EXPECT_EQ(parsed.faults()[0].line, bad.line) << bad.body;
    EXPECT_NE(parsed.faults()[0].message.find(bad.words), std::string::npos) << parsed.faults()[0].text();
  }
}

TEST(EffectJson, ReadsTheGallery) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(NINEBIT_SOURCE_DIR "/scenes/effects")) {
    if (entry.path().extension() != ".json" || entry.path().stem() == "expected_hashes") continue;
    const auto parsed = read_effect(entry.path());
    EXPECT_TRUE(parsed) << parsed.faults()[0].text();
    ++count;
  }
  EXPECT_GE(count, 14U);
}

// Damaged effects are read or refused, with a place for every fault.
TEST(EffectJson, SurvivesDamage) {
  std::vector<std::string> texts;
  for (const char* name : {"index_cube", "blur", "point_light"}) {
    std::ifstream in(std::string(NINEBIT_SOURCE_DIR "/scenes/effects/") + name + ".json");
    texts.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  std::mt19937 random(2001);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random()) % n; };
  constexpr std::string_view kBytes = "\"{}[]:,0-9.e:xn \\";
  std::size_t refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string text = texts[below(texts.size())];
    for (std::size_t n = 1 + below(3); n != 0; --n) {
      const std::size_t at = below(text.size());
      switch (below(4)) {
        case 0:
          text[at] = kBytes[below(kBytes.size())];
          break;
        case 1:
          text.erase(at, 1 + below(20));
          break;
        case 2:
          text.insert(at, text.substr(below(text.size()), below(40)));
          break;
        default:
          text.insert(at, 1, kBytes[below(kBytes.size())]);
      }
    }
    const auto parsed = parse_effect({text, "e.json"});
    ASSERT_NE(parsed.ok(), !parsed.faults().empty());
    for (const TextFault& fault : parsed.faults()) ASSERT_GE(fault.line, 1) << fault.text();
    refused += parsed ? 0U : 1U;
  }
  EXPECT_GT(refused, 2000U);
  EXPECT_LT(refused, 3000U);
}

TEST(EffectJson, ReportsFilesThatCannotBeRead) {
  EXPECT_FALSE(read_effect(NINEBIT_SOURCE_DIR "/scenes/effects"));
  EXPECT_FALSE(read_effect(NINEBIT_SOURCE_DIR "/scenes/effects/no_such_file.json"));
}

TEST(EffectJson, ReadsTextureShaders) {
  const auto parsed = parse(R"(
    "profile": "nv2a",
    "textures": {"d": {"source": "offsets:h.png", "steepness": 2}, "n": {"source": "signed-normals:h.png"},
                 "h": {"source": "hilo-heights:h.png"}, "v": {"source": "3d:v.png"}},
    "passes": [{"texture_shader": {"stages": [{"operation": "texture_2d"},
                                              {"operation": "offset_2d", "matrix": [0.5, 0, 0, 2]},
                                              {"operation": "cull_fragment"}]},
                "units": [{"texture": "d"}, {"texture": "n"}, {"texture": null, "coordinates": "position"}]}])");
  ASSERT_TRUE(parsed) << parsed.faults()[0].text();
  const TextureShaderState& stages = parsed->passes[0].state.texture_shader;
  EXPECT_TRUE(stages.enabled);
  EXPECT_EQ(stages.stage[1].operation, TextureOperation::offset_2d);
  EXPECT_EQ(stages.stage[1].matrix, (std::array<float, 4>{0.5F, 0.0F, 0.0F, 2.0F}));
  EXPECT_EQ(parsed->passes[0].units[2].coordinates.source, VertexSource::position);
  EXPECT_EQ(parsed->textures[0].origin, TextureOrigin::offsets);
  EXPECT_EQ(parsed->textures[0].sampler.min_filter, MinFilter::linear_mipmap_linear);
  EXPECT_TRUE(parsed->textures[1].sampler.is_signed[2]);
  EXPECT_EQ(parsed->textures[2].sampler.min_filter, MinFilter::linear) << "without mip-maps";

  const auto refused = parse(R"(
    "profile": "nv2a",
    "passes": [{"texture_shader": {"stages": [{"operation": "offset_2d"}]}}])");
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.faults()[0].text().find("e.json:3:"), std::string::npos) << refused.faults()[0].text();
  EXPECT_NE(refused.faults()[0].text().find("texture stage 0"), std::string::npos) << refused.faults()[0].text();
  EXPECT_FALSE(parse(R"("profile": "geforce2",
    "passes": [{"texture_shader": {"stages": [{"operation": "texture_2d"}]}}])"));
}

}  // namespace
}  // namespace ninebit::test
