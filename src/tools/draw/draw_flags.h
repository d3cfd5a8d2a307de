// The flags of `ninebit draw`, and the effect that they describe.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/effect/effect.h"
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
  std::string size;
  std::string mesh, up;
  bool allow_outside = false;
  std::vector<std::string> defines;  // as ProgramFlags::defines
  std::array<std::string, kEffectUnits> textures, filters, wraps, coordinates;
  std::string primary, secondary, fog, fog_color;
  std::array<std::vector<std::string>, 2> constants;  // "[COMBINER:]R,G,B,A"
  std::string blend, alpha_test, depth, cull, color_mask;
  std::string camera, look_at, light, light_type, light_target, floor;
  std::optional<double> fov, spot_angle;
  ProfileChoice difference;  // or kArithmetic
  std::string only;          // the files to write; empty: all
  bool layers = false;
  std::vector<CLI::Option*> pass_options{};  // those that an effect file replaces
};

void add_draw_flags(CLI::App& verb, DrawFlags& flags);

// The effect of one pass that the flags describe. The Diagnostic is wrong usage.
[[nodiscard]] Result<Effect> effect_of(const DrawFlags& flags);

// Whether to write the picture, the difference or the layers: --only.
[[nodiscard]] bool writes(const DrawFlags& flags, std::string_view name);
// The Diagnostic is wrong usage: a file of --only that no flag asks for.
[[nodiscard]] Status check_files(const DrawFlags& flags);

// Replaces the size, mesh, camera and light of an effect file by those of the flags. The Diagnostic is wrong usage: a
// flag that an effect file does not combine with.
[[nodiscard]] Status override_effect(const DrawFlags& flags, Effect& effect);

}  // namespace ninebit::tools
