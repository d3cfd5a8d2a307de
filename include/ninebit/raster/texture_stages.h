// Texture-shader stages with the textures that they read, prepared once a draw: one fragment with all its values, and
// batches in vectors, with the same bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/raster/sampler.h"
#include "ninebit/raster/texture.h"
#include "ninebit/texture_shader/evaluate_stages.h"
#include "ninebit/texture_shader/stage_program.h"
#include "ninebit/texture_shader/stage_state.h"

namespace NINEBIT_PUBLIC ninebit {

// A texture as stages see it: its kind, its base format, its signed components.
[[nodiscard]] StageTexture stage_texture(const Texture& texture, const Sampler& sampler);

// The textures of the units with their samplers.
struct StageUnits {
  std::array<const Texture*, kTextureStages> texture{};  // nullptr: the unit has none
  std::array<Sampler, kTextureStages> sampler{};         // of the texture of the same unit
};

// The interpolated coordinates of up to kBatchSize fragments: [unit][s, t, r, q], one float a fragment. Differences to
// the fragments on the right and above are read if the stages need_derivatives(). Arrays that no stage reads may be
// null; a null q is 1 everywhere.
struct StageBatch {
  std::array<std::array<const float*, 4>, kTextureStages> value{};  // of the fragments
  std::array<std::array<const float*, 4>, kTextureStages> dx{};     // to the fragment on the right
  std::array<std::array<const float*, 4>, kTextureStages> dy{};     // to the fragment above
};

// The results of a batch.
struct StageOutputs {
  std::array<std::array<s9*, 4>, kTextureStages> codes{};  // [unit][red, green, blue, alpha]: what the combiners read
  std::uint8_t* killed = nullptr;  // 1: the fragment is culled, else 0; needed if the stages cull()
  float* depth = nullptr;          // replaced depths, as in TextureShaderResult; needed if the stages replace_depth()
};

// Immutable: one object may run in any number of threads at once.
class TextureStages {
 public:
  // Reports what compile() reports. The textures must pass check_texture and outlive the object. A unit whose texture
  // is incomplete for its filter counts as one without a texture.
  [[nodiscard]] static Result<TextureStages> make(const HardwareProfile& profile, const TextureShaderState& state,
                                                  const StageUnits& units);

  // The compiled stages; their warnings() name the inconsistent ones.
  [[nodiscard]] const TextureShaderProgram& program() const { return program_; }

  // Whether a texture is read whose level of detail is needed.
  [[nodiscard]] bool needs_derivatives() const { return needs_derivatives_; }
  // Whether fragments may be culled, or killed by a colour key.
  [[nodiscard]] bool culls() const { return culls_; }
  // Whether depths are replaced.
  [[nodiscard]] bool replaces_depth() const { return replaces_depth_; }
  // Whether a stage reads the unit's coordinate k (0 to 3: s, t, r, q).
  [[nodiscard]] bool reads(int unit, int k) const {
    return reads_[static_cast<std::size_t>(unit)][static_cast<std::size_t>(k)];
  }

  // One fragment, with every value on the way.
  [[nodiscard]] TextureShaderResult evaluate(const StageInputs& inputs) const;

  // The first `count` fragments of a batch, 1 to kBatchSize, on the machine's best SIMD target.
  void run(const StageBatch& batch, std::size_t count, const StageOutputs& to) const;

 private:
  class Batch;
  TextureStages() = default;
  void find_reads();

  HardwareProfile profile_{};
  TextureShaderProgram program_;
  std::array<std::optional<TextureSampler>, kTextureStages> sampler_;
  std::array<std::array<bool, 4>, kTextureStages> reads_{};
  bool needs_derivatives_ = false, culls_ = false, replaces_depth_ = false;
};

}  // namespace ninebit
