// A captured draw call as files for `ninebit draw` and the playground.
#pragma once

#include <filesystem>
#include <string>

#include "ninebit/combiner/state.h"
#include "src/gl_layer/capture/capture.h"

namespace ninebit::gl_layer {

// Parts of a draw call that an effect cannot express: then its picture may differ.
struct CapturedFiles {
  std::vector<std::string> files;
  std::size_t pixels = 0;  // that were drawn
  std::vector<std::string> left_out;
};

// Writes FOLDER/NAME.json, an effect that gives the same inputs to the same program at each pixel that was drawn (a
// mesh with the primary colours, textures with the texels), its files, and NAME.png, the colour buffer after the draw
// call. `program` is a file in the folder's parent.
[[nodiscard]] CapturedFiles write_effect(const std::filesystem::path& folder, const std::string& name,
                                         const CapturedDraw& draw, const CombinerState& state,
                                         const HardwareProfile& profile, const std::string& program);

// Writes a file whole; what fails goes to the log.
bool write_file(const std::filesystem::path& file, const std::string& content);

}  // namespace ninebit::gl_layer
