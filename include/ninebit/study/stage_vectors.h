// Packs of test vectors for texture-shader stages, the half of a pixel before the combiners: stages as the NV2A's
// words, small textures whose texels are written out, coordinates, and what a profile computes. vectors.h has the packs
// of combiners; groups, results and verdicts are as there.
//
// Textures are read at the nearest texel, and no fragment stands so near to the edge of a texel or of a byte that the
// order of operations in floats decides it. Fields that no picture decides (docs/numerics.md) have no effect in the
// groups before the last one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/combiner/initial_registers.h"
#include "ninebit/numerics/codes.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/study/vectors.h"
#include "ninebit/texture_shader/evaluate_stages.h"
#include "ninebit/texture_shader/stage_program.h"
#include "ninebit/texture_shader/stage_state.h"

namespace NINEBIT_PUBLIC ninebit {

// A texture of a pack, clamped to its edges.
struct StagePicture {
  StageTarget target = StageTarget::two_dimensional;  // any but none
  int width = 1, height = 1;                          // texels
  int depth = 1;                                      // layers; of a cube map its six faces, +x, -x, +y, -y, +z, -z
  std::vector<Bytes4> texels;                         // red, green, blue, alpha, row by row from t = 0, then by layer

  // The nearest texel at s, t, r; s and t of a rectangle count texels. A coordinate that is NaN counts as 0.
  [[nodiscard]] const Bytes4& at(const std::array<float, 3>& place) const;
};

// The result of the stages for a fragment. If it is culled, the rest is zero.
struct StageOutput {
  std::array<Rgba9, kTextureStages> texture{};  // what the combiners read, by unit
  bool is_culled = false;                       // by CULL_FRAGMENT
  std::optional<std::uint32_t> depth{};         // the code that replaces the fragment's, in a buffer of 16 bits
  friend bool operator==(const StageOutput&, const StageOutput&) = default;
};

// Stages, and what they give.
struct StageVectorProgram {
  std::size_t group = 0;                                           // index of its group
  TextureShaderState state;                                        // by the NV2A's rules
  std::array<std::optional<std::size_t>, kTextureStages> picture;  // by unit: index of its texture
  std::array<std::array<bool, 4>, kTextureStages> is_signed{};     // by unit: components that are two's complement
  std::vector<std::uint32_t> words;                                // by StageVectorPack::word_names
  std::vector<StageCoordinates> at;                                // by fragment
  std::vector<StageOutput> expected;                               // by fragment
};

// Stages with textures, coordinates and expected results.
struct StageVectorPack {
  HardwareProfile profile;                   // whose results are expected
  std::uint64_t seed = 0;                    // VectorSettings::seed
  std::size_t fragments = 0;                 // of each program
  std::vector<std::string> word_names;       // "PSTextureModes", "BUMP_ENV_MAT[1][0]", "TEXTURE_FILTER[0]"
  std::vector<StagePicture> pictures;        // that programs share
  std::vector<VectorGroup> groups;           // in the order of the pack
  std::vector<StageVectorProgram> programs;  // by group
  std::string id;                            // 16 hexadecimal digits of the hash of its text
};

// The usual number of programs.
inline constexpr int kStageVectorPrograms = 1000;

// Returns the number of groups: a pack has a program of each.
[[nodiscard]] int least_stage_vector_programs();

// Makes a pack, the same one for the same profile and settings. Without an `id`: print_stage_vector_pack() returns it.
// Refuses a profile without texture shaders. Fails with Fault::cancelled if `go_on` ends the work.
[[nodiscard]] Result<StageVectorPack> make_stage_vector_pack(const HardwareProfile& profile,
                                                             const VectorSettings& settings,
                                                             const VectorProgress& go_on = {});

// Returns the pack as text in the format of docs/emulators.md. Sets pack.id.
[[nodiscard]] std::string print_stage_vector_pack(StageVectorPack& pack);

// Whether a text begins as such a pack does; its profile is that of vector_pack_profile().
[[nodiscard]] bool is_stage_vector_pack(std::string_view text);

// Makes the pack that a text's first lines describe, and reports the first line that differs from it: the text was
// changed, or another version of ninebit or of the profile made it. `profile` must have the name that the text says.
[[nodiscard]] Result<StageVectorPack> read_stage_vector_pack(std::string_view text, const std::string& file,
                                                             const HardwareProfile& profile);

// An output as results have it: "culled", or 32 digits, and behind a slash a depth that is replaced.
[[nodiscard]] std::string stage_output_text(const StageOutput& output);

// An emulator's results for a pack.
struct StageVectorResults {
  // The fragments of one program.
  struct Fragments {
    int line = 0;                      // in its file
    std::vector<StageOutput> outputs;  // by fragment
  };
  std::map<std::size_t, Fragments> programs;  // by index of the program; not all need be there
};

// Reads results of a pack. Reports the first line that is wrong and results of another pack.
[[nodiscard]] Result<StageVectorResults> read_stage_vector_results(std::string_view text, const std::string& file,
                                                                   const StageVectorPack& pack);

// Compares results with the pack and, if any differ, with every mistake. Fails with Fault::cancelled if `go_on` ends
// the work.
[[nodiscard]] Result<VectorVerdict> judge_stage_vectors(const StageVectorPack& pack, const StageVectorResults& results,
                                                        std::size_t most, const VectorProgress& go_on = {});

// A mistake that results of a profile's packs are compared with.
struct StageVectorMistake {
  std::string name;   // "the offset matrix is transposed"
  std::string rules;  // of docs/numerics.md that it breaks
  std::string group;  // the first group that shows it; empty: none does, as no picture decides it
};

// Returns all mistakes, in their order.
[[nodiscard]] std::vector<StageVectorMistake> stage_vector_mistakes(const HardwareProfile& profile);

// Returns what one of them computes for a program's fragments: `mistake` is an index of stage_vector_mistakes().
[[nodiscard]] std::vector<StageOutput> mistaken_outputs(const StageVectorPack& pack, std::size_t mistake,
                                                        const StageVectorProgram& program);

}  // namespace ninebit
