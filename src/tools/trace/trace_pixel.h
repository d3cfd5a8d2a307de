// The fragment of a rendering to trace, and a report on its pixel.
#pragma once

#include <optional>
#include <string>

#include "src/tools/common/scene_flags.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

// A pixel that was probed while a scene was rendered.
struct TracedPixel {
  int x = 0;                             // from the left of the picture
  int y = 0;                             // from its top
  std::string file;                      // the scene's or the effect's
  std::string technique;                 // empty: an effect
  std::string size;                      // of the picture, WxH
  std::string state;                     // "background", "lit", "shadowed"; of an effect "drawn" or "not drawn"
  std::vector<ProbedPass> passes;        // of the camera
  std::optional<std::size_t> pass;       // of the traced fragment; empty: none
  std::optional<std::size_t> fragment;   // of that pass
  std::vector<std::string> objects;      // names
  std::vector<std::uint32_t> object_of;  // for each triangle
  IndexOrderReport index_order;          // of the rendering
};

// Renders the scene and probes the pixel, which must be inside the picture. The traced fragment is the one that decided
// the result of the last pass with a program. `other_program`: the trace uses another program, so that any pass is
// accepted if none has a program.
[[nodiscard]] Result<TracedPixel> render_pixel(const SceneFlags& flags, const CommonFlags& common, int x, int y,
                                               bool other_program);

// Selects the fragment that decided the result of the last pass with a program. `other_program`: see render_pixel.
void choose_fragment(TracedPixel& pixel, bool other_program);

[[nodiscard]] std::string pixel_text(const TracedPixel& pixel);
[[nodiscard]] Json pixel_json(const TracedPixel& pixel);

}  // namespace ninebit::tools
