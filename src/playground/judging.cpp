#include "src/playground/judging.h"

#include <algorithm>
#include <utility>

#include "ninebit/shadow/index_cube.h"
#include "src/shadow/ground_truth/judge.h"

namespace ninebit::playground {
namespace {

// As `ninebit render --ground-truth --json` has it.
Json errors_of_truth(const GroundTruth& truth, const ShadowEvidence& evidence) {
  Json by_cause = Json::object();
  for (const ErrorCause cause : causes_of(evidence)) {
    by_cause[std::string(name_of(cause))] = truth.by_cause[static_cast<std::size_t>(cause)];
  }
  return {{"false_lit", truth.false_lit}, {"false_shadowed", truth.false_shadowed}, {"by_cause", std::move(by_cause)}};
}

// Names by number.
Json all_causes() {
  Json names = Json::array();
  for (std::size_t cause = 0; cause < kErrorCauses; ++cause) names.push_back(name_of(static_cast<ErrorCause>(cause)));
  return names;
}

}  // namespace

std::unique_ptr<Judging> Judging::begin(Request& request, const Shelf& shelf, std::optional<Reply>& refused) {
  std::unique_ptr<Judging> judging(new Judging);
  if (auto reply = ask_for_shadow(request, shelf, judging->asked_)) {
    refused = std::move(*reply);
    return nullptr;
  }
  RenderSettings& settings = judging->asked_.settings;
  settings.evidence = true;
  auto rendering = render_index_cube(judging->asked_.scene, settings, {});
  if (!rendering) {
    refused = refusal(rendering.error());
    return nullptr;
  }
  judging->rendering_ = std::move(*rendering);
  auto rays = GroundTruthScene::make_portable(judging->asked_.scene);
  if (!rays) {
    refused = refusal(rays.error());
    return nullptr;
  }
  judging->rays_ = std::move(*rays);
  judging->judge_.emplace(judging->rays_->rays(), settings, *judging->rendering_);
  return judging;
}

Reply Judging::judge(int rows, std::vector<std::uint8_t>& bytes) {
  const int last = std::min(asked_.settings.height, judged_ + rows);
  judge_->judge_rows(judged_, last);
  judged_ = last;
  Json out = progress();
  if (!done()) return out;
  const GroundTruth truth = judge_->finish();
  bytes = cause_plane(truth, asked_.settings.width, asked_.settings.height).pixels;
  out["pixels"] = {
      {"background", rendering_->background}, {"lit", rendering_->lit}, {"shadowed", rendering_->shadowed}};
  out["errors"] = errors_of_truth(truth, *rendering_->evidence);
  out["causes"] = all_causes();
  out["bytes"] = bytes.size();
  return out;
}

Json Judging::progress() const {
  return {{"width", asked_.settings.width}, {"height", asked_.settings.height}, {"judged", judged_}};
}

}  // namespace ninebit::playground
