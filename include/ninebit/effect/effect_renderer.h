// Draws effects.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/combiner/program.h"
#include "ninebit/combiner/registers.h"
#include "ninebit/combiner/state.h"
#include "ninebit/effect/effect.h"
#include "ninebit/frame/rendering.h"
#include "ninebit/language/program_text.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/raster/surface.h"
#include "ninebit/raster/texture.h"
#include "ninebit/scene/scene.h"

namespace NINEBIT_PUBLIC ninebit {

// All that decides the texels of a texture that is not a target's, besides the content of its files.
struct TextureRecipe {
  TextureOrigin origin = TextureOrigin::file;      // as in EffectTexture
  std::vector<std::filesystem::path> files{};      // with the effect's folder in front of relative ones
  int size = 0;                                    // as in EffectTexture
  float steepness = 0.0F;                          // as in EffectTexture
  std::optional<std::array<bool, 4>> mip_signs{};  // with mip-maps, whose components are signed; empty: without them
  friend bool operator==(const TextureRecipe&, const TextureRecipe&) = default;
};

// How an effect's files are read. The paths are those of the effect, with its folder in front of relative ones.
struct EffectReaders {
  // A program in any form, valid under the profile; its texture-shader stages are those of the pass, if enabled.
  std::function<Result<TextProgram>(const std::filesystem::path& file, const HardwareProfile& profile)> program{};
  // One 2D texture, or six faces of a cube map in the order of CubeFace, with mip-maps.
  std::function<Result<Texture>(std::span<const std::filesystem::path> files, const HardwareProfile& profile)>
      texture{};
  // One picture of any sides as a rectangle texture. Empty: `texture` reads it, with the sides that that gives.
  std::function<Result<Texture>(const std::filesystem::path& file, const HardwareProfile& profile)> rectangle{};
  // A scene as read_scene() returns it with this axis as SceneReadOptions::up.
  std::function<Result<Scene>(const std::filesystem::path& file, std::optional<UpAxis> up)> scene{};
  // The texture of a recipe: `make` makes it, by the readers above. For callers that keep textures from one renderer to
  // the next, and knows whether files or the profile have changed. Empty: each texture is made.
  std::function<Result<Texture>(const TextureRecipe& recipe, const std::function<Result<Texture>()>& make)> kept{};
};

// Options: values to keep besides the pictures.
struct EffectOptions {
  bool layers = false;                // every register and output of the picture's passes, and depth and stencil
  std::optional<glm::ivec2> pixel{};  // of the picture, to be probed: window coordinates, y up
  // The number of a pass with a program, to be recorded. Each draw() then draws it twice more.
  std::optional<std::size_t> recorded_pass{};
};

// The registers of a CombinerRecord, in its order.
inline constexpr std::array kRecordedRegisters{Register::primary,  Register::secondary, Register::fog,
                                               Register::texture0, Register::texture1,  Register::texture2,
                                               Register::texture3, Register::spare0};

// The inputs and results of one pass's combiners at each pixel of its target (of a cube map, of its last face), for the
// last fragment that passed the depth test. The alpha test is left out. Planes lowest row first, 0 where nothing was
// drawn.
struct CombinerRecord {
  std::optional<Program> program{};  // of the pass, with its constants; empty: nothing was recorded
  int width = 0;                     // pixels, or samples of a target with several for each pixel
  int height = 0;                    // likewise
  // Codes before the first general combiner, by register and component.
  std::array<std::array<std::vector<s9>, 4>, kRecordedRegisters.size()> inputs{};
  std::array<std::vector<std::uint8_t>, 4> output{};  // the final combiner's colour, before blending
  std::vector<bool> drawn{};                          // whether there is a fragment
};

// An effect with all that it draws: its files are read, programs compiled, vertices computed. Any number of frames can
// be drawn, and the effect changed between them. Results are the same bits for any number of threads.
class EffectRenderer {
 public:
  // Reads and prepares everything; the files are read in the order of the effect. `profile` is used for the rasterizer
  // and the programs, whatever the effect's own `profile` says. Reports what check_effect finds, what the readers
  // report, a mesh without the texture coordinates that a pass reads, a view from a light that is a point, a program
  // that the profile refuses, and more polygons than index codes; each with the pass's or texture's name.
  [[nodiscard]] static Result<EffectRenderer> make(const Effect& effect, const HardwareProfile& profile,
                                                   const EffectReaders& readers, const EffectOptions& options = {});
  ~EffectRenderer();
  // A moved-from renderer can only be destroyed.
  EffectRenderer(EffectRenderer&& other) noexcept;
  EffectRenderer& operator=(EffectRenderer&& other) noexcept;

  // Takes another effect, such as the same one at another moment, and keeps what both have in common: the mesh of the
  // same file, surfaces, vertices. Programs are read again, textures too unless the readers keep them, the file of the
  // same mesh is not. The profile stays. Reports what make() reports; the renderer can then only be destroyed.
  Status change(const Effect& effect, const EffectReaders& readers);
  // The values to keep from the next draw() on.
  void set_options(const EffectOptions& options);

  // Clears all targets and draws all passes. Reports Fault::cancelled, and what rasterize() reports.
  Status draw(const Progress& progress = {});

  // The picture after draw(): colour, depth, and stencil if its format has one.
  [[nodiscard]] const Surface& picture() const;
  // A target after draw(): one surface, or six in the order of CubeFace; empty if there is no target of that name.
  [[nodiscard]] std::span<const Surface> target(std::string_view name) const;
  // The completed scene; without a mesh the rectangle's.
  [[nodiscard]] const Scene& scene() const;
  // Notes for the user about unexpected things found while preparing, one sentence each: what check_draw() finds,
  // constants that are not set, textures that were resized.
  [[nodiscard]] const std::vector<std::string>& warnings() const;
  // Milliseconds of wall-clock time of each pass in the last draw().
  [[nodiscard]] const std::vector<double>& pass_times() const;
  // With options.layers, the layers of the last draw(): parts "PASS.primary", "PASS.spare0", … "depth", "stencil".
  [[nodiscard]] const std::deque<Layer>& layers() const;
  // With options.pixel, each pass that drew into the picture.
  [[nodiscard]] const std::vector<ProbedPass>& probed() const;
  // With options.recorded_pass, the combiners of that pass in the last draw().
  [[nodiscard]] const CombinerRecord& recorded() const;

 private:
  struct Prepared;
  explicit EffectRenderer(std::unique_ptr<Prepared> prepared);
  std::unique_ptr<Prepared> prepared_;
};

}  // namespace ninebit
