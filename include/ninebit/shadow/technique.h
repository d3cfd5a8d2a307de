// What all shadow techniques have in common: what they are asked, what they answer, and the table of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "ninebit/image/image_io.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/raster/fragment_probe.h"
#include "ninebit/raster/surface.h"
#include "ninebit/scene/scene.h"
#include "ninebit/scene/scene_io.h"
#include "ninebit/shadow/index_codes.h"
#include "ninebit/shadow/settings.h"

namespace NINEBIT_PUBLIC ninebit {

// Asked between passes: what has been done (0 to 1) and what comes next. Returning false ends the work with
// Fault::cancelled. May be empty.
using Progress = std::function<bool(std::string_view pass, double done)>;

// A plane of samples, rows from the lowest up (of a cube-map face: from t = 0).
struct Layer {
  std::string part;     // what it belongs to: "spare0", "depth_cube"
  std::string channel;  // "R"; of a cube map the face: "+X"
  int width = 0;        // samples a row
  int height = 0;       // rows
  // width × height of one type.
  std::variant<std::vector<s9>, std::vector<std::uint8_t>, std::vector<std::uint32_t>,
               std::vector<Half>,  // width * height
               std::vector<float>>
      samples{};
};

// A picture for people, upright.
struct NamedPicture {
  std::string file;  // "error.png"
  Image8 image;      // the top row first
};

// Something that a technique counted or measured besides the pixels, such as "open_edges".
struct Fact {
  std::string name;                                        // a key of the JSON report
  std::variant<std::uint64_t, double, std::string> value;  // a count, a measure or a list in words
};

// What each pixel's shadow was decided by, for the judge of ground_truth.h; lowest row first.
struct ShadowEvidence {
  // The scene's triangle that the light's map holds at the texel that the fragment looked up, plus 1; 0: none, or no
  // map.
  std::vector<std::uint32_t> fetched;
  // The triangles that own at least one texel of the map; empty where the technique has no map.
  std::vector<bool> in_map;
  // Of each triangle its index, from 1 (0 is the cleared map), by which the map tells triangles apart; empty where the
  // technique compares no indices.
  std::vector<std::uint32_t> index_of_triangle;
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

// One face of the index cube map: size × size texels, row 0 at t = 0. Red, green and blue lie in words of four bytes,
// as they are drawn and looked up together; luminance (in red) and alpha in planes one after the other.
struct IndexMapFace {
  int size = 0;                                         // texels a side
  int step = 1;                                         // bytes from one texel of a component to the next
  std::array<std::ptrdiff_t, 4> first{-1, -1, -1, -1};  // where in `samples` red, green, blue and alpha begin; -1: none
  PlaneSamples<std::uint8_t> samples;                   // of all components

  // The rows of one component, kRed to kAlpha; an empty plane where the map's format does not store it.
  [[nodiscard]] Plane<const std::uint8_t> plane(int component) const {
    const std::ptrdiff_t begin = first[static_cast<std::size_t>(component)];
    if (begin < 0) return {};
    return {samples.data() + begin, std::ptrdiff_t{step} * size, step};
  }
  // A texel as IndexCodes::number reads it; components that are not stored are 0.
  [[nodiscard]] ColorBytes texel(std::size_t i) const {
    ColorBytes bytes{};
    for (std::size_t c = 0; c < 4; ++c) {
      if (first[c] >= 0) bytes[c] = samples[static_cast<std::size_t>(first[c]) + i * static_cast<std::size_t>(step)];
    }
    return bytes;
  }
  // How many there are: size × size.
  [[nodiscard]] std::size_t texels() const { return static_cast<std::size_t>(size) * static_cast<std::size_t>(size); }
};

// What the index of a pixel says of the polygon that is seen there. Numbers in the scene count from 0.
struct PickedIndex {
  std::uint32_t number = 0;                // the index's code number; 0: the background
  std::optional<std::uint32_t> polygon{};  // with IndexScope::polygon
  std::optional<std::uint32_t> section{};  // with IndexScope::section
  std::optional<std::uint32_t> object{};   // empty: the background
};

// What one of the camera's passes drew at the pixel that the settings watch.
struct ProbedPass {
  std::string name;                       // of the pass, such as "comparison"
  std::optional<Program> program;         // none: the register combiners are disabled
  std::vector<ProbedFragment> fragments;  // in drawing order; `primitive` is the number of the scene's triangle
};

// The fragment that decided what a pass left there: the last one that was written or, if none was, the last one that
// passes the depth test; nullptr if there is none either.
[[nodiscard]] const ProbedFragment* deciding_fragment(const ProbedPass& pass);

// What a technique made of a scene.
struct Rendering {
  Surface frame;                                        // colour, depth and stencil: a stencil of 0 is light
  std::uint64_t background = 0, lit = 0, shadowed = 0;  // pixels of the frame
  IndexCodes codes{2};                                  // in which index_map is to be read
  std::uint64_t codes_used = 0;           // polygons, objects or sections with an index; the cleared map is not counted
  std::vector<IndexMapFace> index_map{};  // six faces in the order of CubeFace; empty without indices
  std::deque<Layer> layers{};             // of the frame, with settings.layers: a layer never moves once it is there
  std::deque<Layer> maps{};               // what the light drew, besides index_map
  std::vector<NamedPicture> pictures{};   // besides those of every rendering
  std::vector<Fact> facts{};              // in the order of reports
  std::optional<ShadowEvidence> evidence{};  // with settings.evidence, of techniques that draw shadows
  std::vector<ProbedPass> probed{};          // in the order of drawing; empty unless a pixel was watched
  std::optional<PickedIndex> picked{};       // with settings.pick, by techniques that draw indices
  PassTimes times{};                         // of the whole rendering
};

// A way to draw shadows: an entry of the table techniques().
struct Technique {
  std::string_view name;     // as `ninebit render --technique` takes it
  std::string_view summary;  // one line
  LightKinds lights;         // that it can draw with
  // The scene has exactly one camera and one light of these kinds (complete_scene). Reports settings out of range and
  // scenes that the technique cannot draw.
  Result<Rendering> (*render)(const Scene& scene, const RenderSettings& settings, const Progress& progress);
};

// All techniques, the default first.
[[nodiscard]] std::span<const Technique> techniques();

// The technique of that name, or nullptr.
[[nodiscard]] const Technique* find_technique(std::string_view name);

}  // namespace ninebit
