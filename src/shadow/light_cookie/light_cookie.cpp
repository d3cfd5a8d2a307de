// The technique's entry point: renders one frame.
#include "ninebit/shadow/light_cookie.h"

#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "ninebit/combiner/program.h"
#include "ninebit/language/gl_nv.h"
#include "src/frame/camera_frame.h"
#include "src/frame/drawn_passes.h"
#include "src/frame/shading.h"
#include "src/shadow/index_cube/index_cube_renderer.h"

namespace ninebit {

namespace {

Status check_cookie(const Texture* cookie) {
  if (cookie == nullptr) {
    return Diagnostic{.message = "light-cookie has no cookie; expected a cube map of the light (--cookie)"};
  }
  if (cookie->target != TextureTarget::cube_map) {
    return Diagnostic{.message = "the cookie is a 2D texture; expected a cube map"};
  }
  if (Status checked = check_texture(*cookie); !checked) return checked;
  if (is_complete(*cookie, false)) return {};
  return Diagnostic{.message = "the cookie is incomplete; expected six faces of one size"};
}

// Positions in the light's own space, which are the cube map's texture coordinates. They are not normalized, because a
// cube map's face and coordinates are quotients of the components.
std::vector<glm::vec3> light_space(const Scene& scene, const Light& light, const glm::mat3& rotation) {
  std::vector<glm::vec3> out;
  out.reserve(scene.positions.size());
  for (const glm::vec3& position : scene.positions) {
    const glm::vec3 d = position - light.position;
    // A rotation's inverse is its transpose.
    out.emplace_back(glm::dot(rotation[0], d), glm::dot(rotation[1], d), glm::dot(rotation[2], d));
  }
  return out;
}

// One frame; with shadows, the index cube's renderer marks them.
class LightCookieFrame {
 public:
  LightCookieFrame(PipelineState lit, PipelineState textured) : lit_(std::move(lit)), textured_(std::move(textured)) {}

  Status make(const Scene& scene, const RenderSettings& settings) {
    if (settings.light_cookie.shadows) {
      auto made = IndexCubeRenderer::make(scene, settings);
      if (!made) return made.error();
      indices_.emplace(std::move(*made));
    } else {
      auto made = CameraFrame::make(scene, settings, {.point = true});
      if (!made) return made.error();
      alone_.emplace(std::move(*made));
    }
    const Light& light = scene.lights[0];
    colors_ = light_vertices(scene, light, settings);
    from_light_ = light_space(scene, light, light_rotation(settings.light_cookie.rotate_degrees));
    // In shadow, as in the cookie's dark parts, there is only ambient light. A cartoon's shadow is ink.
    if (!settings.cartoon) frame().shading().shadowed = colors_.ambient;
    return {};
  }

  [[nodiscard]] CameraFrame& frame() { return indices_ ? indices_->frame() : *alone_; }

  Status draw_maps() { return indices_ ? indices_->draw_maps() : Status(); }
  Status draw_shadows() { return indices_ ? indices_->draw_shadows() : frame().draw_depth(); }

  Status add_evidence() {
    if (indices_) return indices_->add_evidence();
    frame().rendering().evidence.reset();  // no shadows are drawn
    return {};
  }

  Status draw_lit() {
    RenderTarget target = lit_target();
    VertexArrays arrays;
    arrays.texture_coordinates[0] = from_light_;
    arrays.vertex_colors = colors_.diffuse;
    arrays.secondary_colors = colors_.ambient;
    const Texture& cookie = *frame().settings().light_cookie.cookie;
    const std::array<TextureUnit, 1> units{TextureUnit{&cookie, kCookieSampler}};
    const auto state_of = [this](const SurfaceGroup& group) { return group.texture == nullptr ? lit_ : textured_; };
    return frame().draw_colors("lit", lit_, arrays, {.before = units, .target = &target, .state_of = state_of});
  }

 private:
  // The frame's capturing target, plus planes for the secondary colour and the final combiner's colour.
  RenderTarget lit_target() {
    Rendering& rendering = frame().rendering();
    RenderTarget whole = rendering.frame.target();
    if (!frame().settings().layers) return whole;
    RenderTarget target = frame().capturing_target(1, "lit_");
    const auto add = [&](OutputSource source, Register reg, int component, const char* part) {
      const std::string channel(1, "RGB"[component]);
      auto& plane = add_layer<s9>(rendering.layers, part, channel, whole.width, whole.height);
      target.outputs.push_back({.source = source,
                                .reg = reg,
                                .component = component,
                                .time = OutputTime::at_depth_pass,
                                .plane = Plane<s9>{plane.data(), whole.width},
                                .owner = frame().owner()});
    };
    for (int c = 0; c < 3; ++c) add(OutputSource::register_code, Register::secondary, c, "lit_secondary");
    for (int c = 0; c < 3; ++c) add(OutputSource::output_code, Register::spare0, c, "lit_output");
    target.outputs.insert(target.outputs.end(), whole.outputs.begin(), whole.outputs.end());
    return target;
  }

  PipelineState lit_, textured_;
  std::optional<IndexCubeRenderer> indices_;
  std::optional<CameraFrame> alone_;  // without indices_
  VertexLight colors_;
  std::vector<glm::vec3> from_light_;
};

}  // namespace

Result<Rendering> render_light_cookie(const Scene& scene, const RenderSettings& settings, const Progress& progress) {
  const Texture* const cookie = settings.light_cookie.cookie.get();
  if (Status checked = check_cookie(cookie); !checked) return checked.error();
  auto lit = light_cookie_pass(settings);
  if (!lit) return lit.error();
  auto textured = light_cookie_textured_pass(settings);
  if (!textured) return textured.error();

  LightCookieFrame passes(std::move(*lit), std::move(*textured));
  PassTimer timer(progress);
  double transform = 0.0, maps = 0.0, shadows = 0.0, shading = 0.0, shadow = 0.0;
  Status status = timer.run("vertices", 0.0, transform, [&] { return passes.make(scene, settings); });
  if (status) status = timer.run("index cube map", 0.1, maps, [&] { return passes.draw_maps(); });
  if (status) status = timer.run("depth and shadows", 0.4, shadows, [&] { return passes.draw_shadows(); });
  if (status) status = timer.run("lit", 0.6, shading, [&] { return passes.draw_lit(); });
  if (status) status = timer.run("shadow", 0.9, shadow, [&] { return passes.frame().draw_shadow(); });
  if (status) status = passes.add_evidence();
  if (!status) return status.error();

  CameraFrame& frame = passes.frame();
  frame.finish();
  Rendering& rendering = frame.rendering();
  rendering.times.transform = transform;
  rendering.times.maps = maps;
  rendering.times.lit = shading;
  if (!settings.light_cookie.shadows) rendering.times.camera = shadows;
  rendering.facts.push_back({"cookie_size", static_cast<std::uint64_t>(cookie->faces[0][0].width)});
  return std::move(rendering);
}

namespace {

// Scaling a rounded register by 6 would multiply its rounding error. So the last stage computes the product again at
// full precision, and takes only the smaller summand of 6 = 4 + 2 from a register: 4 (product + spare0 / 8), with
// spare0 = 4 · product. A register holds at most 1; where spare0 is clamped to 1, the result is 1 anyway.
constexpr float kEighth = 32.0F / 255.0F;

// If narrowing drops fractions, stage 0 adds (8/255)². Times 4 this is one code, and half a code after the eighth and
// the scale of stage 1, so the result is rounded instead of truncated.
constexpr float kRounding = 8.0F / 255.0F;

Result<CombinerState> cookie_state(const HardwareProfile& profile, bool textured) {
  using namespace gl;
  return combiner_state_after(profile, "two stages of light-cookie", [&profile, textured] {
    glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);
    const float rounding = profile.general_narrowing.value == Narrowing::toward_zero ? kRounding : 0.0F;
    const std::array<GLfloat, 4> constant0{kEighth, kEighth, kEighth, 0.0F};
    const std::array<GLfloat, 4> constant1{rounding, rounding, rounding, 0.0F};
    glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, constant0.data());
    glCombinerParameterfvNV(GL_CONSTANT_COLOR1_NV, constant1.data());

    // Stage 0, RGB: spare0 = 4 (primary · texture0 + constant1 · constant1).
    glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, GL_PRIMARY_COLOR_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_B_NV, GL_TEXTURE0_ARB, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_C_NV, GL_CONSTANT_COLOR1_NV, GL_UNSIGNED_IDENTITY_NV,
                      GL_RGB);
    glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_D_NV, GL_CONSTANT_COLOR1_NV, GL_UNSIGNED_IDENTITY_NV,
                      GL_RGB);
    glCombinerOutputNV(GL_COMBINER0_NV, GL_RGB, GL_DISCARD_NV, GL_DISCARD_NV, GL_SPARE0_NV, GL_SCALE_BY_FOUR_NV,
                       GL_NONE, GL_FALSE, GL_FALSE, GL_FALSE);
    discard_portion(GL_COMBINER0_NV, GL_ALPHA);

    // Stage 1, RGB: spare0 = 4 (primary · texture0 + spare0 · constant0).
    glCombinerInputNV(GL_COMBINER1_NV, GL_RGB, GL_VARIABLE_A_NV, GL_PRIMARY_COLOR_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glCombinerInputNV(GL_COMBINER1_NV, GL_RGB, GL_VARIABLE_B_NV, GL_TEXTURE0_ARB, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glCombinerInputNV(GL_COMBINER1_NV, GL_RGB, GL_VARIABLE_C_NV, GL_SPARE0_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glCombinerInputNV(GL_COMBINER1_NV, GL_RGB, GL_VARIABLE_D_NV, GL_CONSTANT_COLOR0_NV, GL_UNSIGNED_IDENTITY_NV,
                      GL_RGB);
    glCombinerOutputNV(GL_COMBINER1_NV, GL_RGB, GL_DISCARD_NV, GL_DISCARD_NV, GL_SPARE0_NV, GL_SCALE_BY_FOUR_NV,
                       GL_NONE, GL_FALSE, GL_FALSE, GL_FALSE);
    discard_portion(GL_COMBINER1_NV, GL_ALPHA);

    // Final combiner, alpha = 1: RGB = spare0 · 1 + secondary, or texture1 · (spare0 + secondary).
    glFinalCombinerInputNV(GL_VARIABLE_A_NV, textured ? GL_TEXTURE1_ARB : GL_SPARE0_NV, GL_UNSIGNED_IDENTITY_NV,
                           GL_RGB);
    glFinalCombinerInputNV(GL_VARIABLE_B_NV, textured ? GL_SPARE0_PLUS_SECONDARY_COLOR_NV : GL_ZERO,
                           textured ? GL_UNSIGNED_IDENTITY_NV : GL_UNSIGNED_INVERT_NV, GL_RGB);
    glFinalCombinerInputNV(GL_VARIABLE_C_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glFinalCombinerInputNV(GL_VARIABLE_D_NV, textured ? GL_ZERO : GL_SECONDARY_COLOR_NV, GL_UNSIGNED_IDENTITY_NV,
                           GL_RGB);
    glFinalCombinerInputNV(GL_VARIABLE_G_NV, GL_ZERO, GL_UNSIGNED_INVERT_NV, GL_ALPHA);
  });
}

Result<PipelineState> pass_with(const RenderSettings& settings, const Result<CombinerState>& state) {
  if (!state) return state.error();
  const auto program = compile(*state, settings.profile);
  if (!program) return program.error();
  PipelineState pass = frame_passes(settings).lit;
  pass.program = *program;
  return pass;
}

}  // namespace

Result<CombinerState> light_cookie_state(const HardwareProfile& profile) {
  return cookie_state(profile, false);
}

Result<CombinerState> light_cookie_textured_state(const HardwareProfile& profile) {
  return cookie_state(profile, true);
}

Result<PipelineState> light_cookie_pass(const RenderSettings& settings) {
  return pass_with(settings, light_cookie_state(settings.profile));
}

Result<PipelineState> light_cookie_textured_pass(const RenderSettings& settings) {
  return pass_with(settings, light_cookie_textured_state(settings.profile));
}

namespace {

struct SineCosine {
  double sine;
  double cosine;
};

// Polynomials, because the last bits of a mathematics library's functions differ between machines. Their argument is at
// most an eighth of a turn, where powers beyond the 17th are below a double's last bit.
SineCosine sine_cosine(double degrees) {
  const double turned = std::fmod(degrees, 360.0);
  const double quarters = std::floor(turned / 90.0 + 0.5);
  const double x = (turned - 90.0 * quarters) * (3.14159265358979323846 / 180.0);
  double sine = 1.0, cosine = 1.0;
  for (int k = 16; k >= 2; k -= 2) {
    sine = 1.0 - x * x / (k * (k + 1)) * sine;
    cosine = 1.0 - x * x / (k * (k - 1)) * cosine;
  }
  sine *= x;
  switch ((static_cast<int>(quarters) + 4) % 4) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

// The rotation about axis 0, 1 or 2.
glm::dmat3 rotation(int axis, double degrees) {
  const auto [sine, cosine] = sine_cosine(degrees);
  const int next = (axis + 1) % 3, last = (axis + 2) % 3;
  glm::dmat3 m(1.0);
  m[next][next] = cosine;
  m[next][last] = sine;
  m[last][next] = -sine;
  m[last][last] = cosine;
  return m;
}

}  // namespace

glm::mat3 light_rotation(const glm::vec3& degrees) {
  return glm::mat3(rotation(2, static_cast<double>(degrees.z)) * rotation(1, static_cast<double>(degrees.y)) *
                   rotation(0, static_cast<double>(degrees.x)));
}

}  // namespace ninebit
