// Drawing effects from what a request and the shelf hold.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ninebit/effect/effect_renderer.h"
#include "src/effect/traced_pixel.h"
#include "src/playground/engine.h"

namespace ninebit::playground {

// Limits of a drawing, so that a browser's memory suffices.
inline constexpr std::size_t kMaxDrawnPixels = std::size_t{1} << 24;  // of the picture and all targets together
inline constexpr std::size_t kMaxTexels = std::size_t{1} << 25;       // of all textures together, without mip-maps
inline constexpr std::size_t kMaxKeptTexels = std::size_t{1} << 20;   // of one texture that the next drawing takes over
inline constexpr int kMaxDrawnSegments = 512;                         // N of a generated mesh

inline constexpr std::uint64_t kMaxFileTriangles = std::uint64_t{1} << 19;  // of a scene file that was put

// The scene that is always there, scenes/index_room.gltf, and the name that effects of the gallery give it.
inline constexpr std::string_view kRoomName = "room";
inline constexpr std::string_view kRoomFile = "index_room.gltf";

// A scene file that was put, or the room.
[[nodiscard]] Result<Scene> shelf_scene(const std::string& name, const Shelf& shelf, std::optional<UpAxis> up);

// The reason why this effect cannot be drawn here: too many pixels, texels or polygons. Nothing: empty.
[[nodiscard]] std::string complaint_about_mesh(const std::string& mesh);
[[nodiscard]] std::string complaint_about_amount(const Effect& effect, const Shelf& shelf);

// Readers of programs from the texts, and of textures and meshes from the shelf.
class ShelfReaders {
 public:
  // The views must outlive the readers.
  ShelfReaders(const LastDrawing& what, const Shelf& shelf)
      : texts_(what.files), choices_(what.choices), shelf_(shelf) {}

  // Takes textures from those that were made before of the same shelf. The profile does not change a texture here.
  void reuse(std::vector<CachedTexture> textures) { reused_ = std::move(textures); }
  // The textures that were read or taken, for the next drawing.
  [[nodiscard]] std::vector<CachedTexture> textures() && { return std::move(kept_); }

  [[nodiscard]] EffectReaders readers();
  // Faults of the program that was read last, with places in its text; none: the reading did not fail there.
  [[nodiscard]] const std::vector<TextFault>& program_faults() const { return program_faults_; }
  // Changes made to files that the user may not expect.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  Result<TextProgram> read_program(const std::string& name, const HardwareProfile& profile);
  Result<Texture> read_texture(const std::vector<std::string>& names, bool is_rectangle);
  Result<Texture> kept_texture(const TextureRecipe& recipe, const std::function<Result<Texture>()>& make);
  Result<TextureSamples> samples_of(const std::string& name, bool opaque, bool any_sides);

  const FileTexts& texts_;
  const ProgramChoices& choices_;
  const Shelf& shelf_;
  std::vector<TextFault> program_faults_{};
  std::vector<std::string> warnings_{};
  std::vector<CachedTexture> reused_{}, kept_{};
};

// An effect's request, without its profiles. Faults of the effect's own text are in `refused`.
struct RequestedEffect {
  LastDrawing what{};
  std::optional<Reply> refused{};
};
[[nodiscard]] RequestedEffect requested_effect(Request& request);

// Takes the request's profile, else the effect's, else geforce2. Returns why it cannot.
[[nodiscard]] std::optional<Reply> choose_drawn_profile(Request& request, LastDrawing& what);

// How an effect was drawn.
struct Drawn {
  std::vector<std::string> warnings{};
  std::optional<Reply> refused{};  // if it was not
};
// Draws into `kept`, which has what an earlier drawing of the same shelf left, or nothing: with the same bits. If it
// refuses, there is no renderer.
[[nodiscard]] Drawn draw_effect(const LastDrawing& what, const Shelf& shelf, const EffectOptions& options,
                                KeptDrawing& kept);

// A pixel of a drawing with the fragment that a trace is about: the one that decided pass `pass`; empty: the last pass
// with a program.
struct Probed {
  std::optional<TracedPixel> pixel{};
  std::optional<Reply> refused{};  // why it cannot be probed
  // Program and registers of that fragment; nullptr: there is none.
  [[nodiscard]] const Program* program() const;
  [[nodiscard]] const RegisterFile* registers() const;
};
[[nodiscard]] Probed probe_pixel(const LastDrawing& what, const Shelf& shelf, glm::ivec2 from_top,
                                 std::string_view pass, KeptDrawing& kept);

// The picture's RGBA, rows from the top, appended to `bytes`.
void append_picture(const Surface& surface, std::vector<std::uint8_t>& bytes);

// The hashes of a picture's planes, as `ninebit draw --json` names them.
[[nodiscard]] Json hashes_of(const Surface& surface);

}  // namespace ninebit::playground
