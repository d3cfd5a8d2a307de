#include "src/bench/effect_workloads.h"

#include <cmath>
#include <utility>

#include "ninebit/language/glsl.h"
#include "ninebit/language/rc10.h"
#include "src/bench/programs.h"
#include "src/effect/effect_inputs.h"

namespace ninebit::bench {
namespace {

constexpr const char* kSepia =
    "!!RC1.0\nconst0 = (0.3, 0.59, 0.11, 1.0);\nconst1 = (1.0, 0.85, 0.63, 1.0);\n"
    "{ rgb { spare0 = tex0 . const0; } }\nout.rgb = spare0 * const1;\nout.a = unsigned_invert(zero);\n";
constexpr const char* kEmboss =
    "!!RC1.0\nconst0 = (0.5, 0.5, 0.5, 0.5);\n"
    "{ rgb { discard = tex0; discard = -tex1; spare0 = sum(); scale_by_two(); } }\n"
    "{ rgb { discard = spare0; discard = const0; spare0 = sum(); } }\n"
    "out.rgb = spare0;\nout.a = unsigned_invert(zero);\n";
constexpr const char* kLightMapDetail =
    "!!RC1.0\n{ rgb { spare0 = tex0 * tex1; scale_by_two(); } }\nout.rgb = spare0 * col0;\n"
    "out.a = unsigned_invert(zero);\n";

constexpr const char* kSepiaFragment =
    "void main() { float y = dot(texture(tex0, uv).rgb, vec3(0.3, 0.59, 0.11));\n"
    "  color = vec4(clamp(y, 0.0, 1.0) * vec3(1.0, 0.85, 0.63), 1.0); }\n";
constexpr const char* kEmbossFragment =
    "void main() { vec3 slope = 2.0 * (texture(tex0, 2.0 * uv).rgb - texture(tex1, 2.0 * uv - 0.01171875).rgb);\n"
    "  color = vec4(clamp(clamp(slope, -1.0, 1.0) + 0.5, 0.0, 1.0), 1.0); }\n";
constexpr const char* kLightMapDetailFragment =
    "void main() { vec3 light = texture(tex0, uv).rgb * texture(tex1, 6.0 * uv).rgb * 2.0;\n"
    "  color = vec4(clamp(light, 0.0, 1.0) * vec3(0.95, 0.85, 0.7), 1.0); }\n";

constexpr const char* kWater = "!!RC1.0\nout.rgb = tex1;\nout.a = unsigned_invert(zero);\n";
constexpr const char* kReflect = "!!RC1.0\nout.rgb = tex3;\nout.a = unsigned_invert(zero);\n";

// ds and dt are 128ths, GLSL's signed bytes 127ths.
constexpr const char* kWaterFragment =
    "void main() { vec2 moved = texture(tex0, 3.0 * uv).rg * (127.0 / 128.0);\n"
    "  color = vec4(texture(tex1, uv + 0.05 * moved).rgb, 1.0); }\n";
// The rectangle lies in z = 0, with the eye at (0, 0, 3).
constexpr const char* kReflectFragment =
    "void main() { vec3 n = texture(tex0, 3.0 * uv).rgb, eye = vec3(1.0 - 2.0 * uv.x, 2.0 * uv.y - 1.0, 3.0);\n"
    "  color = vec4(texture(cube1, 2.0 * n * dot(n, eye) - eye * dot(n, n)).rgb, 1.0); }\n";

// The colours are those of program_workloads() in bytes; a unit without a texture and a fog without one are as in it.
constexpr const char* kProgramMain =
    "void main() {\n"
    "  ivec4 t0 = ivec4(texture(tex0, uv) * 255.0 + 0.5), t1 = ivec4(texture(tex1, uv) * 255.0 + 0.5);\n"
    "  ivec4 c = ninebit_combine(ivec4(153, 102, 204, 51), ivec4(51, 204, 102, 255), ivec4(0), t0, t1, ivec4(0, 0, 0, "
    "255),\n"
    "                            ivec4(0, 0, 0, 255), t0.a);\n"
    "  color = vec4(c) / 255.0; }\n";

// Coordinates uv times `scale`, plus `shift`.
CoordinateSource scaled(float scale, float shift) {
  CoordinateSource source;
  source.matrix[0][0] = source.matrix[1][1] = scale;
  source.matrix[3][0] = source.matrix[3][1] = shift;
  return source;
}

EffectWorkload workload(const char* name, const char* program, const char* fragment) {
  EffectWorkload out{.name = name, .effect = {}, .fragment = fragment};
  EffectPass pass{.name = name, .geometry = EffectGeometry::rectangle, .program = program};
  pass.state.depth_test.enabled = false;
  out.effect.passes.push_back(std::move(pass));
  return out;
}

void add_texture(EffectWorkload& to, const Sampler& sampler, const CoordinateSource& coordinates) {
  const std::size_t unit = to.effect.textures.size();
  const std::string name = std::to_string(unit);
  to.effect.textures.push_back({.name = name, .files = {name}, .sampler = sampler});
  to.effect.passes[0].units[unit] = {.texture = name, .coordinates = coordinates};
}

// Textures that are made of the first picture, or of nothing.
EffectTexture made_texture(std::string name, TextureOrigin origin, const Sampler& sampler) {
  EffectTexture texture{.name = std::move(name), .origin = origin, .files = {"0"}, .size = kEffectTexels};
  texture.sampler = sampler;
  texture.steepness = 8.0F;
  return texture;
}

EffectWorkload water(const Sampler& linear) {
  EffectWorkload out = workload("water", kWater, kWaterFragment);
  out.effect.textures = {made_texture("0", TextureOrigin::offsets, linear),
                         {.name = "1", .files = {"1"}, .sampler = linear}};
  EffectPass& pass = out.effect.passes[0];
  pass.units[0] = {.texture = "0", .coordinates = scaled(3.0F, 0.0F)};
  pass.units[1] = {.texture = "1", .coordinates = {}};
  TextureShaderState& stages = pass.state.texture_shader;
  stages.enabled = true;
  stages.stage[0].operation = TextureOperation::texture_2d;
  stages.stage[1].operation = TextureOperation::offset_2d;
  stages.stage[1].matrix = {0.05F, 0.0F, 0.0F, 0.05F};
  return out;
}

EffectWorkload reflect(const Sampler& linear) {
  EffectWorkload out = workload("reflect", kReflect, kReflectFragment);
  Sampler normals = linear, cube = linear;
  cube.wrap_s = cube.wrap_t = Wrap::clamp_to_edge;
  normals.is_signed = {true, true, true, false};
  out.effect.textures = {made_texture("0", TextureOrigin::signed_normals, normals),
                         made_texture("1", TextureOrigin::normalize_cube, cube)};
  EffectPass& pass = out.effect.passes[0];
  pass.units[0] = {.texture = "0", .coordinates = scaled(3.0F, 0.0F)};
  pass.units[1].coordinates.source = VertexSource::tangent_to_world_x;
  pass.units[2].coordinates.source = VertexSource::tangent_to_world_y;
  pass.units[3] = {.texture = "1", .coordinates = {.source = VertexSource::tangent_to_world_z}};
  TextureShaderState& stages = pass.state.texture_shader;
  stages.enabled = true;
  stages.stage[0].operation = TextureOperation::texture_2d;
  stages.stage[1].operation = stages.stage[2].operation = TextureOperation::dot_product;
  stages.stage[3].operation = TextureOperation::dot_product_reflect_cube_map;
  return out;
}

// The texels of a picture: red, green, blue, alpha, the first row at t = 0.
std::vector<std::uint8_t> effect_texels(std::size_t number) {
  std::vector<std::uint8_t> out;
  for (int y = 0; y < kEffectTexels; ++y) {
    for (int x = 0; x < kEffectTexels; ++x) {
      for (int c = 0; c < 3; ++c) {
        const double wave = std::sin(0.1 * (x + 3 * c)) * std::cos(0.07 * (y - 5 * c + 20 * static_cast<int>(number)));
        out.push_back(static_cast<std::uint8_t>(127.5 + 120.0 * wave));
      }
      out.push_back(255);
    }
  }
  return out;
}

}  // namespace

std::vector<EffectWorkload> effect_workloads(int width, int height, const HardwareProfile& profile) {
  const Sampler nearest{.min_filter = MinFilter::nearest, .mag_filter = MagFilter::nearest};
  const Sampler linear{.min_filter = MinFilter::linear, .mag_filter = MagFilter::linear};
  const Sampler trilinear{.min_filter = MinFilter::linear_mipmap_linear, .mag_filter = MagFilter::linear};
  std::vector<EffectWorkload> all{
      workload("sepia", kSepia, kSepiaFragment), workload("emboss", kEmboss, kEmbossFragment),
      workload("light_map_detail", kLightMapDetail, kLightMapDetailFragment), water(linear), reflect(linear)};
  add_texture(all[0], nearest, {});
  add_texture(all[1], linear, scaled(2.0F, 0.0F));
  add_texture(all[1], linear, scaled(2.0F, -0.01171875F));
  add_texture(all[2], trilinear, {});
  add_texture(all[2], trilinear, scaled(6.0F, 0.0F));
  all[2].effect.passes[0].primary.constant = {0.95F, 0.85F, 0.7F, 1.0F};
  for (EffectWorkload& one : all) {
    const bool has_stages = one.effect.passes[0].state.texture_shader.enabled;
    one.profile = has_stages && !profile.texture_shaders ? profiles::nv2a : profile;
    one.effect.width = width;
    one.effect.height = height;
  }
  return all;
}

Result<std::vector<EffectWorkload>> program_workloads(int width, int height, const HardwareProfile& profile) {
  const auto programs = measured_programs(profile);
  if (!programs) return programs.error();
  std::vector<EffectWorkload> all;
  for (const MeasuredProgram& measured : *programs) {
    if (measured.name == "default") continue;
    const auto text = print_rc10(measured.state, measured.profile);
    if (!text) return text.error();
    const auto program = compile(measured.state, measured.profile);
    if (!program) return program.error();
    const auto glsl = emit_glsl(*program, GlslVersion::glsl_330);
    if (!glsl) return glsl.error();
    const std::string function = glsl->substr(glsl->find('\n') + 1);  // without its #version
    EffectWorkload one = workload(std::string(measured.name).c_str(), text->c_str(), (function + kProgramMain).c_str());
    const Sampler nearest{.min_filter = MinFilter::nearest, .mag_filter = MagFilter::nearest};
    add_texture(one, nearest, {});
    add_texture(one, nearest, {});
    one.effect.passes[0].primary.constant = {0.6F, 0.4F, 0.8F, 0.2F};
    one.effect.passes[0].secondary.constant = {0.2F, 0.8F, 0.4F, 1.0F};
    one.effect.width = width;
    one.effect.height = height;
    one.profile = measured.profile;
    all.push_back(std::move(one));
  }
  return all;
}

EffectReaders workload_readers() {
  EffectReaders readers;
  readers.program = [](const std::filesystem::path& text, const HardwareProfile& profile) -> Result<TextProgram> {
    auto parsed = parse_rc10({text.string(), "benchmark"}, profile);
    if (!parsed) return Diagnostic{.message = parsed.faults()[0].text()};
    return TextProgram{.state = *parsed};
  };
  readers.texture = [](std::span<const std::filesystem::path> files, const HardwareProfile&) -> Result<Texture> {
    TextureSamples samples{.width = kEffectTexels, .height = kEffectTexels};
    const std::vector<std::uint8_t> texels = effect_texels(files[0] == "0" ? 0 : 1);
    std::vector<std::uint8_t> planes;
    for (std::size_t c = 0; c < 4; ++c) {
      for (std::size_t i = c; i < texels.size(); i += 4) planes.push_back(texels[i]);
    }
    samples.samples = planes;
    return make_texture(TextureTarget::texture_2d, InternalFormat::rgba8, {{samples}});
  };
  return readers;
}

Result<Texture> workload_texture(const EffectWorkload& workload, std::size_t number) {
  return effect_texture(workload.effect, workload.effect.textures[number], profiles::nv2a, workload_readers());
}

}  // namespace ninebit::bench
