// The fragment of a rendering to trace, and a report on its pixel.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ninebit/effect/effect_json.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/shadow/ground_truth.h"
#include "src/effect/traced_pixel.h"
#include "src/tools/common/scene_flags.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

// A pixel of a scene.
struct RenderedPixel {
  TracedPixel traced;
  std::optional<JudgedPixel> truth{};  // of --ground-truth
};

// Renders the scene once and passes on what it is at each of settings.pixels, in their order. The traced fragment is
// the one that decided the result of deciding_pass(); where that has no program, it is traced only if `other_program`,
// which replaces the programs of passes. `rays`, of the scene, judge the pixels; nullptr: they are not judged.
[[nodiscard]] Status render_pixels(const SceneFlags& flags, const Scene& scene, RenderSettings settings,
                                   const GroundTruthScene* rays, bool other_program, const Progress& progress,
                                   const std::function<void(RenderedPixel)>& take);
// The same for the scene of the flags and one pixel, y up, with its progress line and warnings.
[[nodiscard]] Result<RenderedPixel> load_pixel(const SceneFlags& flags, const CommonFlags& common, bool ground_truth,
                                               const glm::ivec2& pixel, bool other_program);

// Selects another pass. Reports a name that no pass has, which is wrong usage.
[[nodiscard]] Status choose_pass_named(const std::string& name, bool other_program, TracedPixel& pixel);

[[nodiscard]] std::string pixel_text(const TracedPixel& pixel);

// The verdict on the pixel, with its reason: "wrong (joint): …", a sentence.
[[nodiscard]] std::string truth_text(const TracedPixel& pixel, const JudgedPixel& truth);
// The same as `truth` of the answer; polygons count from 1.
[[nodiscard]] Json truth_json(const JudgedPixel& truth);

// One fragment of it: "polygon 3 of object 1 'torus': depth … against stored …, written".
[[nodiscard]] std::string fragment_text(const TracedPixel& pixel, const ProbedFragment& fragment);

// A line for each texture-shader stage of a fragment, and for what they do to it.
[[nodiscard]] std::string stages_text(const TextureShaderResult& result);

// The fragment of an effect's picture to trace.

struct TracedEffect {
  TracedPixel pixel;
  const HardwareProfile* profile = nullptr;  // that the effect was drawn with
  bool moves = false;                        // Effect::moves
};

// Draws the effect file and probes the pixel X,Y of its picture, counted from the top left. The rectangles that passes
// draw count as one more object, whose polygons come after those of the mesh. `given`: the profile of --profile, or
// nullptr. `defines`: as ProgramFlags::defines. Reports what `ninebit draw` reports, and a pixel outside of the
// picture.
[[nodiscard]] Result<TracedEffect> draw_pixel(const std::string& file, const std::string& pixel,
                                              const EffectReadOptions& options, const CommonFlags& common,
                                              const HardwareProfile* given, const std::vector<std::string>& defines);

}  // namespace ninebit::tools
