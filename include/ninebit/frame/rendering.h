// The results of a drawing: progress, layers, passes, times; and the rendering of a shadow technique.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "ninebit/frame/index_codes.h"
#include "ninebit/frame/settings.h"
#include "ninebit/image/image_io.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/raster/fragment_probe.h"
#include "ninebit/raster/surface.h"

namespace NINEBIT_PUBLIC ninebit {

// Called before each pass with its name and the share of the work that is done (0 to 1). Returning false ends the work
// with Fault::cancelled. May be empty.
using Progress = std::function<bool(std::string_view pass, double done)>;

// A plane of samples, rows from the lowest up (of a cube-map face: from t = 0).
struct Layer {
  std::string part;     // the group that it belongs to: "spare0", "depth_cube"
  std::string channel;  // "R"; for a cube map the face: "+X"
  int width = 0;        // samples per row
  int height = 0;       // rows
  // width × height samples of one type.
  std::variant<std::vector<s9>, std::vector<std::uint8_t>, std::vector<std::uint32_t>,
               std::vector<Half>,  // width * height
               std::vector<float>>
      samples{};
};

// An upright picture with its file name.
struct NamedPicture {
  std::string file;  // "error.png"
  Image8 image;      // the top row first
};

// A count or measurement of a technique besides the pixels, such as "open_edges".
struct Fact {
  std::string name;                                        // a key of the JSON report
  std::variant<std::uint64_t, double, std::string> value;  // a count, a measurement or a list as text
};

// The evidence for each pixel's shadow, which measure() of ground_truth.h judges; lowest row first.
struct ShadowEvidence {
  // For each pixel, the number of the scene's triangle in the texel of the light's map that the fragment looked up,
  // plus 1; 0: none, or no map.
  std::vector<std::uint32_t> fetched;
  // Whether each triangle owns at least one texel of the map; empty if the technique has no map.
  std::vector<bool> in_map;
  // The index of each triangle in the map, from 1 (0 is the cleared map); empty if the technique compares no indices.
  std::vector<std::uint32_t> index_of_triangle;
};

// Milliseconds of wall-clock time.
struct PassTimes {
  double transform = 0.0;  // made once per scene: indices, vertex colours, projections, surfaces
  double maps = 0.0;       // drawing from the light
  double camera = 0.0;     // the camera's depth pass
  double compare = 0.0;    // shadows into the stencil buffer
  double lit = 0.0;        // colour where there is light
  double shadow = 0.0;     // colour where there is none
};

// One face of the index cube map: size × size texels, row 0 at t = 0. Red, green and blue are stored in words of four
// bytes, because they are drawn and looked up together; luminance (as red) and alpha are planes one after the other.
struct IndexMapFace {
  int size = 0;                                         // texels a side
  int step = 1;                                         // bytes from one texel of a component to the next
  std::array<std::ptrdiff_t, 4> first{-1, -1, -1, -1};  // offsets in `samples` of red, green, blue, alpha; -1: none
  PlaneSamples<std::uint8_t> samples;                   // of all components

  // The rows of one component, kRed to kAlpha; an empty plane if the map's format does not store it.
  [[nodiscard]] Plane<const std::uint8_t> plane(int component) const {
    const std::ptrdiff_t begin = first[static_cast<std::size_t>(component)];
    if (begin < 0) return {};
    return {samples.data() + begin, std::ptrdiff_t{step} * size, step};
  }
  // A texel as IndexCodes::number reads it; components that are not stored are 0.
  [[nodiscard]] ColorBytes texel(std::size_t i) const {
    ColorBytes bytes{};
    if (step == 4) {
      constexpr auto kColors = std::bit_cast<std::uint32_t>(ColorBytes{255, 255, 255, 0});
      std::uint32_t word = 0;
      std::memcpy(&word, samples.data() + 4 * i, sizeof word);
      return std::bit_cast<ColorBytes>(word & kColors);
    }
    for (std::size_t c = 0; c < 4; ++c) {
      if (first[c] >= 0) bytes[c] = samples[static_cast<std::size_t>(first[c]) + i * static_cast<std::size_t>(step)];
    }
    return bytes;
  }
  // The code numbers of the texels from the `begin`-th on, as many as `out` has.
  void read_numbers(const IndexCodes& codes, std::size_t begin, std::span<std::uint32_t> out) const;
  // The number of texels: size × size.
  [[nodiscard]] std::size_t texels() const { return static_cast<std::size_t>(size) * static_cast<std::size_t>(size); }
};

// The index of a pixel, and what it identifies. Numbers in the scene count from 0.
struct PickedIndex {
  std::uint32_t number = 0;                // the index's code number; 0: the background
  std::optional<std::uint32_t> polygon{};  // with IndexScope::polygon
  std::optional<std::uint32_t> section{};  // with IndexScope::section
  std::optional<std::uint32_t> object{};   // empty: the background
};

// The order of a rendering's indices. The counts are 0 with IndexOrder::file.
struct IndexOrderReport {
  IndexOrder order = IndexOrder::file;  // the order that was used
  std::string reason;                   // why it is not the order of the settings; empty: it is
  std::uint64_t patches = 0;            // units with a code of their own
  std::uint64_t borders = 0;            // pairs of neighbours: patches that meet and should compare equal
  std::uint64_t broken_borders = 0;     // those that compare as different, which shows as a joint
  double broken_share = 0.0;            // their part of the length of all borders, 0 to 1
  // Pairs that compare equal although they are neither neighbours nor unable to shadow one another; always 0.
  std::uint64_t false_neighbours = 0;
};

// The fragments that one of the camera's passes drew at one of settings.pixels.
struct ProbedPass {
  std::string name;                       // of the pass, such as "comparison"
  std::optional<Program> program;         // none: the register combiners are disabled
  std::vector<ProbedFragment> fragments;  // in drawing order; `primitive` is the number of the scene's triangle
  std::uint8_t stencil = 0;               // the pixel's stencil value before the pass; 0 without a plane
};

// A pass of a rendering: the scene, its shadow volumes, or a rectangle of the picture's size, drawn with one state.
struct DrawnPass {
  std::string name;                    // such as "comparison"
  bool marks_shadows = false;          // in the stencil buffer
  std::optional<int> texture_units{};  // that its program reads; empty: computed in floats, beyond the hardware
};

// The fragment that decided the pixel's result in a pass: the last one that was written or, if none was, the last one
// that passed the depth test; else the first one that a texture shader culled; nullptr if there is none of them.
[[nodiscard]] const ProbedFragment* deciding_fragment(const ProbedPass& pass);

// The result of a technique.
struct Rendering {
  Surface frame;                                        // colour, depth and stencil: a stencil of 0 is light
  std::uint64_t background = 0, lit = 0, shadowed = 0;  // pixels of the frame
  IndexCodes codes{2};                                  // the codes of index_map
  std::uint64_t codes_used = 0;              // polygons, objects or sections with an index, without the cleared map's
  IndexOrderReport index_order{};            // of techniques with indices
  std::vector<IndexMapFace> index_map{};     // six faces in the order of CubeFace; empty without indices
  std::deque<Layer> layers{};                // of the frame, with settings.layers; a layer never moves in memory
  std::deque<Layer> maps{};                  // of the light's maps, besides index_map
  std::vector<NamedPicture> pictures{};      // besides those that every rendering has
  std::vector<Fact> facts{};                 // in the order in which they are reported
  std::optional<ShadowEvidence> evidence{};  // with settings.evidence, by techniques that draw shadows
  std::vector<std::vector<ProbedPass>> probed{};  // for each of settings.pixels its passes in the order of drawing
  std::vector<DrawnPass> drawn{};                 // all passes that make the picture, in the order of drawing
  // Memory of the light's maps as textures: three components take four bytes, 24 bits of depth as well. The depth
  // buffer that drawing a map takes is not counted, nor is the picture of a light cookie.
  std::uint64_t map_bytes = 0;
  std::optional<PickedIndex> picked{};  // with settings.pick, by techniques that draw indices
  PassTimes times{};                    // of the whole rendering
};

}  // namespace ninebit
