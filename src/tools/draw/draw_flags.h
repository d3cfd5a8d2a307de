// The flags of `ninebit draw`, and the effect that they describe.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ninebit/effect/effect.h"
#include "ninebit/effect/effect_json.h"
#include "ninebit/numerics/result.h"
#include "ninebit/raster/pipeline_state.h"
#include "src/effect/effect_words.h"
#include "src/tools/common/scene_flags.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

// The value of --difference for the same chip with exact combiners.
inline constexpr const char* kArithmetic = "arithmetic";

struct DrawFlags {
  CommonFlags common;
  CLI::Option* profile = nullptr;  // --profile; whether it was given
  std::string file;                // a program or an effect
  std::string output;              // a PNG file
  std::string size, color_format, depth_stencil;
  std::string mesh, up;
  bool allow_outside = false;
  std::vector<std::string> defines;  // as ProgramFlags::defines
  std::array<std::string, kEffectUnits> textures, border_colors, coordinates;
  std::array<std::array<std::string, effect_detail::kSamplerWords.size()>, kEffectUnits> samplers;
  std::array<bool, kEffectUnits> border_texels{};
  std::string primary, secondary, fog, fog_color;
  std::array<std::vector<std::string>, 2> constants;  // "[COMBINER:]R,G,B,A"
  std::string blend, alpha_test, depth, cull, color_mask;
  std::string polygon_mode, polygon_stipple;
  std::optional<double> point_size, line_width;
  bool polygon_smooth = false, line_smooth = false;
  std::string camera, look_at, light, light_type, light_target, floor;
  std::optional<double> fov, spot_angle;
  ProfileChoice difference;  // or kArithmetic
  std::string only;          // the files to write; empty: all
  bool layers = false;
  EffectMoment moment{};
  std::vector<CLI::Option*> moment_options{};
  std::vector<CLI::Option*> pass_options{};                            // those that an effect file replaces
  std::array<std::vector<CLI::Option*>, kEffectUnits> unit_options{};  // those that need a unit's texture
};

void add_draw_flags(CLI::App& verb, DrawFlags& flags);
// Those of --time and --frame that were given for an effect file that does not move, as warnings.
[[nodiscard]] std::vector<std::string> unused_moment(const std::vector<CLI::Option*>& options, bool moves,
                                                     const std::string& file);
// Adds --time and --frame.
std::vector<CLI::Option*> add_moment_flags(CLI::App& verb, EffectMoment& moment);

// The effect of one pass that the flags describe. The Diagnostic is wrong usage.
[[nodiscard]] Result<Effect> effect_of(const DrawFlags& flags);

// Sets what the flags of a unit say about its sampler.
void set_sampler(const DrawFlags& flags, std::size_t unit, Sampler& sampler);

// Whether to write the picture, the difference or the layers: --only.
[[nodiscard]] bool writes(const DrawFlags& flags, std::string_view name);
// The Diagnostic is wrong usage: a file of --only that no flag asks for.
[[nodiscard]] Status check_files(const DrawFlags& flags);

// Replaces the size, colour format, mesh, camera and light of an effect file by those of the flags. The Diagnostic is
// wrong usage: a flag that an effect file does not combine with.
[[nodiscard]] Status override_effect(const DrawFlags& flags, Effect& effect);

// The colours of `draw`: --fog-color, --const0 and --const1.

// The part of "[COMBINER:]R,G,B,A" before the colon, and the colour.
[[nodiscard]] std::pair<std::string_view, std::string> split_constant(std::string_view text);

// The fault of "[COMBINER:]R,G,B,A", or of "R,G,B"; empty: none.
[[nodiscard]] std::string check_constant(const std::string& text);
[[nodiscard]] std::string check_rgb(const std::string& text);

// The words of the fragment state's flags.

// Reads "SOURCE,DESTINATION[,EQUATION]".
[[nodiscard]] Result<Blend> parse_blend(std::string_view text);
// Reads "FUNCTION,REFERENCE".
[[nodiscard]] Result<AlphaTest> parse_alpha_test(std::string_view text);
// Reads "FUNCTION" or "none".
[[nodiscard]] Result<DepthTest> parse_depth(std::string_view text);
// Reads the letters of the components that are written, such as "rgb", or "none".
[[nodiscard]] Result<std::array<bool, 4>> parse_color_mask(std::string_view text);

}  // namespace ninebit::tools
