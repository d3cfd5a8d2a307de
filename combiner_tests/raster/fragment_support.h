// Fragment operations without a rasterizer: random states, planes, and fragments through the library's operations or
// the oracle's.
#pragma once

#include <cstdint>
#include <vector>

#include "combiner_tests/oracle/raster_oracle_fragment.h"
#include "combiner_tests/raster/support.h"
#include "src/raster/fragment/fragment_operations.h"

namespace ninebit::test {

inline constexpr DepthStencilFormat kFormats[] = {DepthStencilFormat::d24s8, DepthStencilFormat::d16,
                                                  DepthStencilFormat::d15s1};

// Alpha test, stencil test of one or two sides, depth test, blending and masks, biased to edges and to the states for
// which the rasterizer takes short cuts. The scissor stays as it is.
void randomize_fragment_operations(Random& random, PipelineState& state);

// A format of colour planes; most often one of bytes, if asked for, one that can be blended.
ColorFormat random_color_format(Random& random, bool blended);

// Gives a picture's planes a format, and only colours that it has.
void set_color_format(ColorFormat format, oracle::Picture& picture);

// A stipple pattern: a few bits, or some, or nearly all.
StipplePattern random_stipple(Random& random);

// A byte, most often one of an edge.
std::uint8_t edge_byte(Random& random);

// A depth code of the format, often one of few, so that equal ones meet.
std::uint32_t some_depth(Random& random, DepthStencilFormat format);

// A picture full of zeros.
oracle::Picture empty_picture(int width, int height, DepthStencilFormat format = DepthStencilFormat::d24s8);

// A picture full of random samples; values beyond a format's stencil bits too.
oracle::Picture random_picture(Random& random, int width, int height, DepthStencilFormat format);

// A picture's samples as the planes of a target, with an output plane of primitive numbers and, if wanted, one at depth
// pass of the color's red.
struct PicturePlanes {
  explicit PicturePlanes(const oracle::Picture& picture, bool at_depth_pass = false);
  PicturePlanes(const PicturePlanes&) = delete;
  PicturePlanes& operator=(const PicturePlanes&) = delete;

  RenderTarget target;
  [[nodiscard]] oracle::Picture picture() const;

 private:
  oracle::Picture start_;
  std::array<std::vector<std::uint8_t>, 4> color_;
  std::vector<std::uint32_t> depth_, primitive_;
  std::vector<std::uint8_t> stencil_, captured_;
};

// Whether two pictures have the same samples.
bool same_samples(const oracle::Picture& a, const oracle::Picture& b);

// The fields of a state that the fragment operations read, in words.
std::string describe_operations(const PipelineState& state);

}  // namespace ninebit::test
