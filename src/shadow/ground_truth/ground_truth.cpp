#include "ninebit/shadow/ground_truth.h"

#include <algorithm>

#include "src/shadow/ground_truth/judge.h"

namespace ninebit {
namespace {

constexpr int kBandRows = 64;  // rows between two calls of the progress function

}  // namespace

Result<GroundTruth> measure(const GroundTruthScene& scene, const RenderSettings& settings, const Rendering& rendering,
                            const Progress& progress) {
  if (Status good = check_rendering(settings, rendering); !good) return good.error();
  Judge judge(scene.rays(), settings, rendering);
  for (int y = 0; y < settings.height; y += kBandRows) {
    if (progress && !progress("ground truth", static_cast<double>(y) / settings.height)) {
      return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
    }
    judge.judge_rows(y, std::min(y + kBandRows, settings.height));
  }
  return judge.finish();
}

}  // namespace ninebit
