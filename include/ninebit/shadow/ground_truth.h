// Ground truth: which pixels are in shadow, computed with rays instead of maps, and why a technique's wrong pixels are
// wrong.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "ninebit/frame/settings.h"
#include "ninebit/image/image_io.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/scene/scene.h"
#include "ninebit/shadow/technique.h"

namespace NINEBIT_PUBLIC ninebit {

// The correct state of a pixel; background: no triangle is visible.
enum class PixelTruth : std::uint8_t { background, lit, shadowed };

// The causes of a wrong pixel. Rules: docs/techniques/ground-truth.md.
enum class ErrorCause : std::uint8_t {
  none,        // the pixel is right
  truncation,  // index: two different indices compare equal in the combiners
  joint,       // index: the texel holds a neighbour of the polygon on the same surface
  vanished,    // index: the polygon owns no texel at all
  shared,      // index: the polygon that casts the shadow has the same index
  acne,        // depth: the texel holds the polygon itself or its neighbour, which then shadows it
  detached,    // depth: the texel holds the polygon that casts the shadow, but the comparison lets light through
  sampling     // anything else: the texel's centre does not see what the pixel's ray sees
};

// The number of causes, `none` included.
inline constexpr std::size_t kErrorCauses = 8;

// "truncation", "joint", …
[[nodiscard]] std::string_view name_of(ErrorCause cause);

// The causes that are possible with this evidence, without `none`: those of index techniques, those of depth
// techniques, or, without a map, only `sampling`.
[[nodiscard]] std::span<const ErrorCause> causes_of(const ShadowEvidence& evidence);

// A rendering judged pixel by pixel; planes lowest row first.
struct GroundTruth {
  std::uint64_t false_lit = 0;                         // pixels that are lit and should be in shadow
  std::uint64_t false_shadowed = 0;                    // the reverse
  std::array<std::uint64_t, kErrorCauses> by_cause{};  // wrong pixels by ErrorCause; one cause per pixel
  std::vector<PixelTruth> truth{};                     // the correct state of each pixel
  std::vector<ErrorCause> cause{};                     // why a pixel is wrong
};

// A scene's triangles, prepared for rays: made once, for any number of renderings.
class GroundTruthScene {
 public:
  // The scene, which must outlive it, has exactly one camera and one light, as for Technique::render. Reports what
  // validate() reports, and an Embree that cannot start.
  [[nodiscard]] static Result<GroundTruthScene> make(const Scene& scene);
  // The same without Embree, with a small tree of boxes: for builds that have none, such as those for browsers.
  // measure() gives the same results, more slowly.
  [[nodiscard]] static Result<GroundTruthScene> make_portable(const Scene& scene);
  ~GroundTruthScene();
  // A moved-from scene can only be destroyed or assigned to.
  GroundTruthScene(GroundTruthScene&& other) noexcept;
  GroundTruthScene& operator=(GroundTruthScene&& other) noexcept;

  struct Rays;
  // For measure() only.
  [[nodiscard]] const Rays& rays() const { return *rays_; }

 private:
  explicit GroundTruthScene(std::unique_ptr<Rays> rays);
  std::unique_ptr<Rays> rays_;
};

// Judges a rendering of the scene, made with these settings, `evidence` among them.
//
// The correct state of a pixel is that of a point: the intersection of the ray through the pixel's centre with the
// triangle that the frame shows there. If the ray just misses the triangle, because window positions are snapped to
// 1/16 pixel, it is the triangle's point nearest to the ray. The point is in shadow if any other triangle, whatever its
// facing, lies between it and the light; if it is outside a spot light's square pyramid; or, with
// settings.light_facing, if its triangle faces away from the light. All of this is decided in doubles. Triangles touch,
// and are left out, if their plane is nearer to the point or to the light than four units in the last place of a float
// at the size of the scene's largest coordinate (2^-22 times it). The results are the same bits for any number of
// threads and on any machine: Embree, or the tree of boxes, only finds the candidates, with boxes that are larger than
// its rounding.
//
// Reports a rendering without evidence (the technique draws no shadows, or settings.evidence was not set) or of another
// size than the settings', and Fault::cancelled if `progress` returns false.
[[nodiscard]] Result<GroundTruth> measure(const GroundTruthScene& scene, const RenderSettings& settings,
                                          const Rendering& rendering, const Progress& progress = {});

// One pixel, judged, with the triangles that its cause is about.
struct JudgedPixel {
  PixelTruth truth = PixelTruth::background;  // its correct state
  ErrorCause cause = ErrorCause::none;        // none: it is right
  std::optional<std::uint32_t> shown{};       // the triangle that it shows; empty: background
  std::optional<std::uint32_t> fetched{};     // that of the texel which its fragment looked up; empty: none, or no map
  std::optional<std::uint32_t> occluder{};    // of those between it and the light the one nearest to the light
  bool turned_away = false;                   // settings.light_facing, and its triangle faces away from the light
  bool outside_spot = false;                  // a spot light does not reach it
};

// The same for pixel (x, y), y up, alone. Reports what measure() reports, and a pixel outside of the rendering.
[[nodiscard]] Result<JudgedPixel> judge_pixel(const GroundTruthScene& scene, const RenderSettings& settings,
                                              const Rendering& rendering, int x, int y);

// A wrong pixel amid many that are wrong for the same cause.
struct WorstPixel {
  ErrorCause cause = ErrorCause::none;  // of it and of those around it
  int x = 0, y = 0;                     // y up
  int radius = 0;  // pixels that are nearer than this, across, up and diagonally, have its cause; 1: it alone
};

// At most `most` pixels of each cause that occurs, in the order of ErrorCause: those with the largest radius first, of
// equal ones the highest, then the leftmost. Those of a cause are an eighth of the picture's width or height apart.
[[nodiscard]] std::vector<WorstPixel> worst_pixels(const GroundTruth& truth, int width, int height, int most);

// The rendering, dimmed and grey, with wrong pixels in colours that colour-blind viewers can distinguish: orange for
// lit pixels that should be in shadow, blue for the reverse.
[[nodiscard]] Image8 error_picture(const Rendering& rendering, const GroundTruth& truth);

// Adds error.png to the rendering's pictures and, with settings.layers, the layers truth (PixelTruth) and cause
// (ErrorCause).
void add_ground_truth(Rendering& rendering, const RenderSettings& settings, const GroundTruth& truth);

}  // namespace ninebit
