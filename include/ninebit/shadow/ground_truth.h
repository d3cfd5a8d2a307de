// Ground truth: which pixels are in shadow, told by rays instead of maps, and why a technique's others are wrong.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "ninebit/image/image_io.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/scene/scene.h"
#include "ninebit/shadow/settings.h"
#include "ninebit/shadow/technique.h"

namespace NINEBIT_PUBLIC ninebit {

// What a pixel should be; background: no triangle is seen there.
enum class PixelTruth : std::uint8_t { background, lit, shadowed };

// Why a pixel is wrong. docs/techniques/ground-truth.md has the rules in full.
enum class ErrorCause : std::uint8_t {
  none,        // it is right
  truncation,  // index: the combiners cannot tell two different indices apart
  joint,       // index: the texel holds a neighbour of the polygon on the same surface
  vanished,    // index: the polygon owns no texel at all
  shared,      // index: what shades the polygon has the polygon's own index
  acne,        // depth: the texel holds the polygon itself or its neighbour, which shades it
  detached,    // depth: the texel holds what shades the polygon, and the comparison lets light through
  sampling     // all else: the texel's centre does not see what the pixel's ray sees
};
inline constexpr std::size_t kErrorCauses = 8;

// "truncation", "joint", …
[[nodiscard]] std::string_view name_of(ErrorCause cause);

// The causes that errors with such evidence can have, `none` left out: those of index techniques, of depth techniques,
// or `sampling` alone without a map.
[[nodiscard]] std::span<const ErrorCause> causes_of(const ShadowEvidence& evidence);

// A rendering judged pixel by pixel; planes lowest row first.
struct GroundTruth {
  std::uint64_t false_lit = 0;                         // pixels that are lit and should be in shadow
  std::uint64_t false_shadowed = 0;                    // the reverse
  std::array<std::uint64_t, kErrorCauses> by_cause{};  // pixels, by ErrorCause; those that are wrong have one each
  std::vector<PixelTruth> truth{};                     // what each pixel should be
  std::vector<ErrorCause> cause{};                     // why it is not
};

// A scene's triangles, ready for rays: made once, for any number of renderings.
class GroundTruthScene {
 public:
  // The scene, which must outlive it, has exactly one camera and one light, as for Technique::render. Reports what
  // validate() reports, and that Embree refuses to start.
  [[nodiscard]] static Result<GroundTruthScene> make(const Scene& scene);
  ~GroundTruthScene();
  GroundTruthScene(GroundTruthScene&& other) noexcept;
  GroundTruthScene& operator=(GroundTruthScene&& other) noexcept;

  struct Rays;
  // What measure() asks; of no use elsewhere.
  [[nodiscard]] const Rays& rays() const { return *rays_; }

 private:
  explicit GroundTruthScene(std::unique_ptr<Rays> rays);
  std::unique_ptr<Rays> rays_;
};

// Judges a rendering of the scene, made with these settings, `evidence` among them.
//
// What a pixel should be: the ray through its centre meets its triangle (the one that the frame shows there) in a
// point; where the ray just misses the triangle, because window positions are snapped to 1/16 pixel, it is the
// triangle's point nearest to the ray. The point is in shadow if any other triangle, whatever its facing, lies between
// it and the light; if it is outside of a spot light's square pyramid; or, with settings.light_facing, if its triangle
// turns away from the light. All of this is decided in doubles, with triangles whose plane comes nearer to the point,
// or to the light, than four units in the last place of a float at the size of the scene's largest coordinate (2^-22
// times it) left out: they touch. The same bits for any number of threads and on any machine: Embree only names the
// candidates, in boxes that are larger than its rounding.
//
// Reports a rendering without evidence (the technique draws no shadows, or was not asked for it) or of another size
// than the settings', and Fault::cancelled if `progress` says so.
[[nodiscard]] Result<GroundTruth> measure(const GroundTruthScene& scene, const RenderSettings& settings,
                                          const Rendering& rendering, const Progress& progress = {});

// The rendering, dimmed and grey, with what is wrong in colours that colour-blind eyes tell apart: orange what is lit
// and should be in shadow, blue the reverse.
[[nodiscard]] Image8 error_picture(const Rendering& rendering, const GroundTruth& truth);

// Adds error.png to the rendering's pictures and, with settings.layers, the layers truth (PixelTruth) and cause
// (ErrorCause).
void add_ground_truth(Rendering& rendering, const RenderSettings& settings, const GroundTruth& truth);

}  // namespace ninebit
