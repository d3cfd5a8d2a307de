// What all shadow techniques have in common: what they are asked, what they answer, and the table of them.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/raster/fragment_probe.h"
#include "ninebit/raster/pipeline_state.h"
#include "ninebit/raster/surface.h"
#include "ninebit/scene/scene.h"
#include "ninebit/shadow/index_codes.h"

namespace ninebit {

struct RenderSettings {
  int width = 1024;  // pixels, 1 to kMaxSurfaceSize
  int height = 768;
  int map_size = 512;  // texels a side of a cube-map face: a power of two, 1 to kMaxSurfaceSize
  IndexScope index_scope = IndexScope::polygon;
  int index_step = 2;         // 1 to kMaxIndexStep
  bool light_facing = false;  // polygons that face away from the light are shadowed (the article leaves them lit)
  CullFace cull_face = CullFace::none;  // in every pass, from the light as from the camera
  bool layers = false;                  // keep every intermediate value of the camera's view
  std::optional<glm::ivec2> pixel;      // to be watched: window coordinates of the frame, y up
  HardwareProfile profile = profiles::geforce2;
};

// Asked between passes: what has been done (0 to 1) and what comes next. Returning false ends the work with
// Fault::cancelled. May be empty.
using Progress = std::function<bool(std::string_view pass, double done)>;

// Every intermediate value of the comparison at each pixel, rows from the lowest up; zero where nothing was drawn.
// Register codes as the combiners hold them, -255 to 255 with nine bits.
struct ComparisonLayers {
  std::array<std::vector<s9>, 3> primary;   // the polygon's own index colour
  std::array<std::vector<s9>, 3> texture0;  // the index colour fetched from the cube map
  std::array<std::vector<s9>, 4> spare0;    // after the last general combiner
  std::array<std::vector<s9>, 4> spare1;
  std::vector<s9> output_alpha;
  std::vector<std::uint32_t> polygon;  // 1 + number of the triangle; 0: background
  std::vector<std::uint32_t> object;   // 1 + number of the object; 0: background
};

// Milliseconds of wall-clock time.
struct PassTimes {
  double transform = 0.0;  // what is made once a scene: indices, vertex colours, projections, surfaces
  double maps = 0.0;       // drawing from the light
  double camera = 0.0;     // the camera's depth pass
  double compare = 0.0;    // shadows into the stencil buffer
  double lit = 0.0;        // colour where there is light
  double shadow = 0.0;     // colour where there is none
};

// One face of the index cube map: planes red, green, blue of size × size texels, row 0 at t = 0.
struct IndexMapFace {
  int size = 0;
  std::array<std::vector<std::uint8_t>, 3> color;
};

// What one of the camera's passes drew at the pixel that the settings watch.
struct ProbedPass {
  std::string name;
  std::optional<Program> program;         // none: the register combiners are disabled
  std::vector<ProbedFragment> fragments;  // in drawing order; `primitive` is the number of the scene's triangle
};

// The fragment that decided what a pass left there: the last one that was written or, if none was, the last one that
// passes the depth test; nullptr if there is none either.
[[nodiscard]] const ProbedFragment* deciding_fragment(const ProbedPass& pass);

struct Rendering {
  Surface frame;                                        // colour, depth and stencil: stencil 1 is shadow
  std::uint64_t background = 0, lit = 0, shadowed = 0;  // pixels of the frame
  IndexCodes codes{2};
  std::uint64_t codes_used = 0;           // polygons or objects that have an index; the cleared map is not counted
  std::vector<IndexMapFace> index_map{};  // six faces in the order of CubeFace
  std::optional<ComparisonLayers> layers{};
  std::vector<ProbedPass> probed{};  // in the order of drawing; empty unless a pixel was watched
  PassTimes times{};
};

struct Technique {
  std::string_view name;     // as `ninebit render --technique` takes it
  std::string_view summary;  // one line
  // The scene has exactly one camera and one light (complete_scene). Reports settings out of range and scenes that the
  // technique cannot draw.
  Result<Rendering> (*render)(const Scene& scene, const RenderSettings& settings, const Progress& progress);
};

// All techniques, the default first.
[[nodiscard]] std::span<const Technique> techniques();

// The technique of that name, or nullptr.
[[nodiscard]] const Technique* find_technique(std::string_view name);

}  // namespace ninebit
