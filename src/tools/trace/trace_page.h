// A traced fragment for people, as text and as a page.
#pragma once

#include <string>
#include <vector>

#include "ninebit/combiner/trace.h"
#include "ninebit/shadow/ground_truth.h"
#include "src/effect/traced_pixel.h"
#include "src/page/diagram_page.h"
#include "src/tools/common/scene_flags.h"
#include "src/tools/trace/trace_text.h"

namespace ninebit::tools {

// The traced fragment.
struct TraceFacts {
  std::string program{};                        // file; empty: the program of the pixel's pass
  std::string profile{};                        // its name for people
  const TracedPixel* pixel = nullptr;           // nullptr: registers were given
  const JudgedPixel* truth = nullptr;           // of the pixel; nullptr: not asked
  const HardwareProfile* hardware = nullptr;    // that the fragments were drawn with
  const Program* given = nullptr;               // the program of the file; nullptr: those of the passes
  RegisterFile registers{};                     // without a pixel
  const TextureShaderResult* stages = nullptr;  // without a pixel, if stages ran
};

// The texts of the pixel, then the trace of the program, if there is one.
[[nodiscard]] std::string facts_text(const TraceFacts& facts, const Program* program, const Trace* traced,
                                     TraceLayout layout);

// What `ninebit trace --scene … --pixel X,Y --ground-truth` prints to a file of each of settings.pixels, of a scene
// that is loaded. The settings are those of the picture, which is rendered once; `rays` are the scene's.
[[nodiscard]] Result<std::vector<std::string>> judged_pixel_texts(const SceneFlags& flags, const CommonFlags& common,
                                                                  const Scene& scene, const RenderSettings& settings,
                                                                  const GroundTruthScene& rays,
                                                                  const Progress& progress);

// The page with every pass that drew at the pixel, but without its text. A pass is traced at the fragment that decided
// it. Without any fragment the page has no diagram.
[[nodiscard]] DiagramPage trace_page(const TraceFacts& facts);

}  // namespace ninebit::tools
