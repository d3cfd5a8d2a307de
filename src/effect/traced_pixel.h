// A traced pixel as `ninebit trace --json` prints it and the playground shows it.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/combiner/program.h"
#include "ninebit/combiner/trace.h"
#include "ninebit/effect/effect_renderer.h"
#include "ninebit/frame/rendering.h"

namespace ninebit {

// A pixel that was probed while a scene was rendered.
struct TracedPixel {
  int x = 0;                             // from the left of the picture
  int y = 0;                             // from its top
  std::string file;                      // the scene's or the effect's
  std::string technique;                 // empty: an effect
  std::string size;                      // of the picture, WxH
  std::string state;                     // "background", "lit", "shadowed"; of an effect "drawn" or "not drawn"
  std::vector<ProbedPass> passes;        // of the camera
  std::optional<std::size_t> pass;       // of an effect that of the traced fragment; of a scene deciding_pass()
  std::optional<std::size_t> fragment;   // of that pass, which is traced; empty: none
  std::vector<std::string> objects;      // names
  std::vector<std::uint32_t> object_of;  // for each triangle
  IndexOrderReport index_order;          // of the rendering
};

// The pixel of an effect that a renderer with this pixel as EffectOptions::pixel has drawn; x and y as in TracedPixel.
// The traced fragment is the one that decided the result of the last pass with a program.
[[nodiscard]] TracedPixel pixel_of_effect(const Effect& effect, const EffectRenderer& renderer, int x, int y,
                                          std::string file);

// Selects the fragment that decided pass number `pass`; empty, and false, if no fragment did.
bool choose_pass(TracedPixel& pixel, std::size_t pass);

// "written", "depth test failed", …
[[nodiscard]] std::string_view text_of_fate(FragmentFate fate);

// The pixel to trace.
struct TraceHeading {
  std::string profile{};                        // its name
  std::string program{};                        // the file's name; empty: none
  const TracedPixel* pixel = nullptr;           // of a picture
  const TextureShaderResult* stages = nullptr;  // of a fragment that somebody gives; nullptr: they did not run
};

// The object that is printed; without a trace only the pixel.
[[nodiscard]] nlohmann::ordered_json trace_answer(const TraceHeading& heading, const Program* program,
                                                  const Trace* traced);

}  // namespace ninebit
