// The fragment of a rendering that is traced, and what is to be told of the pixel.
#pragma once

#include <optional>
#include <string>

#include "src/tools/common/scene_flags.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

// A pixel that was watched while a scene was rendered.
struct TracedPixel {
  int x = 0;                             // from the left of the picture
  int y = 0;                             // from its top
  std::string state;                     // "background", "lit" or "shadowed"
  std::vector<ProbedPass> passes;        // that drew with the camera
  std::optional<std::size_t> pass;       // whose fragment is traced; empty: there is none
  std::optional<std::size_t> fragment;   // of that pass
  std::vector<std::string> objects;      // names
  std::vector<std::uint32_t> object_of;  // for each triangle
};

// Renders and watches the pixel (within the picture). Traced is the fragment that decided what the last pass with a
// program left there. `other_program`: the trace brings a program, so that without such a pass any other will do.
[[nodiscard]] Result<TracedPixel> render_pixel(const SceneFlags& flags, const CommonFlags& common, int x, int y,
                                               bool other_program);

[[nodiscard]] std::string pixel_text(const TracedPixel& pixel, const SceneFlags& flags);
[[nodiscard]] Json pixel_json(const TracedPixel& pixel, const SceneFlags& flags);

}  // namespace ninebit::tools
