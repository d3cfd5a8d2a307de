// Random texture-shader stages with textures.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "combiner_tests/oracle/stage_oracle.h"
#include "combiner_tests/raster/texture_support.h"
#include "ninebit/raster/texture_stages.h"

namespace ninebit::test {

// Stages with what they read; units point to the textures.
struct StageCase {
  HardwareProfile profile = profiles::nv2a;
  TextureShaderState state;
  std::array<Texture, kTextureStages> textures;
  StageUnits units;
  bool has_mipmaps = false;
  // [place][unit][k]: of the fragments, and the changes to their neighbours.
  std::array<std::array<std::array<std::vector<float>, 4>, kTextureStages>, 3> given;

  [[nodiscard]] StageBatch batch() const {
    StageBatch view;
    for (std::size_t u = 0; u < kTextureStages; ++u) {
      for (std::size_t k = 0; k < 4; ++k) {
        view.value[u][k] = given[0][u][k].data();
        view.dx[u][k] = given[1][u][k].data();
        view.dy[u][k] = given[2][u][k].data();
      }
    }
    return view;
  }
  [[nodiscard]] StageInputs inputs(std::size_t i) const {
    StageInputs in;
    for (std::size_t u = 0; u < kTextureStages; ++u) {
      for (std::size_t k = 0; k < 4; ++k) {
        in.at[u][k] = given[0][u][k][i];
        in.right[u][k] = given[0][u][k][i] + given[1][u][k][i];
        in.above[u][k] = given[0][u][k][i] + given[2][u][k][i];
      }
    }
    return in;
  }
};

// Valid stages, one of them with this operation, most often consistent; without coordinates.
std::unique_ptr<StageCase> random_stages(Random& random, TextureOperation operation, bool has_mipmaps);

// The question for the oracle, without coordinates. It reads the case's own textures without a filter.
oracle::StageQuestion stage_question(const StageCase& c);

// A coordinate: most often from -2 to 2.
float random_stage_number(Random& random);

}  // namespace ninebit::test
