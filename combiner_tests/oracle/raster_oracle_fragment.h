// OpenGL's operations on one fragment after its colour is known, slow and naive. Their only job is to judge the
// library's.
//
// It is written from chapter 4.1 of the OpenGL 1.3 specification, from EXT_stencil_wrap and EXT_blend_minmax, and from
// the contracts in pipeline_state.h and surface.h (arithmetic of blending, planes), and from what pictures of an NV2A
// show of its surfaces and its coverage. It shares no code with what it judges: of the library's headers it includes
// those two, for the state and the format as the question.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ninebit/raster/pipeline_state.h"
#include "ninebit/raster/surface.h"

namespace ninebit::oracle {

using Bytes = std::array<std::uint8_t, 4>;  // red, green, blue, alpha

// All planes of a target, row by row, the lowest row first.
struct Picture {
  int width = 0;
  int height = 0;
  DepthStencilFormat format = DepthStencilFormat::d24s8;
  ColorFormat color_format = ColorFormat::a8r8g8b8;
  bool has_alpha = true;  // a plane of alpha
  std::vector<Bytes> color{};
  std::vector<std::uint32_t> depth{};      // codes of the format
  std::vector<std::uint8_t> stencil{};     // looked at only if the format has stencil bits
  std::vector<std::uint32_t> primitive{};  // an output plane: the number of the last fragment that was drawn
  std::vector<int>
      captured{};  // another: the red of the last fragment that would pass the depth test; as it was, if none
};

// The fragments' fates.
struct Tally {
  std::uint64_t fragments = 0;  // within the scissor
  std::uint64_t alpha_fail = 0;
  std::uint64_t stencil_fail = 0;
  std::uint64_t depth_fail = 0;
  std::uint64_t drawn = 0;
};

// A fragment inside the picture.
struct Incoming {
  int x = 0;
  int y = 0;
  std::int64_t depth = 0;  // a code of the picture's format
  std::uint32_t number = 0;
  bool front_facing = true;
  Bytes color{};
  int coverage = 8;  // eighths of the pixel
};

// Takes the fragment through scissor, alpha, stencil and depth test, blending and masks.
void process(const PipelineState& state, const Incoming& fragment, Picture& picture, Tally& tally);

// An operation's result for a byte of memory, of which the stencil buffer has the low `bits` bits.
[[nodiscard]] int after_stencil(const StencilFace& face, StencilOperation operation, int bits, int memory);

// The colour that a surface of the format keeps, as a texture shows it: bits cut off, the others repeated below.
[[nodiscard]] Bytes kept(ColorFormat format, const Bytes& color);

// The result of blending two colours, without other operations.
[[nodiscard]] Bytes blended(const Blend& blend, const Bytes& source, const Bytes& destination);

}  // namespace ninebit::oracle
