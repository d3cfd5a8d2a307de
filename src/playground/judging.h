// Index cube shadows judged by rays, some rows at a time, so that who waits can change their mind.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "src/playground/engine.h"
#include "src/playground/shadow_answer.h"
#include "src/shadow/ground_truth/judge.h"

namespace ninebit::playground {

// A rendering that is being judged. Its parts refer to each other, so it does not move.
class Judging {
 public:
  // Renders what was asked for and prepares its rays; empty, with the reason in `refused`, if that is not possible.
  [[nodiscard]] static std::unique_ptr<Judging> begin(Request& request, const Shelf& shelf,
                                                      std::optional<Reply>& refused);

  Judging(const Judging&) = delete;
  Judging& operator=(const Judging&) = delete;

  // Judges at most `rows` more rows. The answer to the last ones has the wrong pixels, and in `bytes` their causes as
  // cause_plane gives them.
  [[nodiscard]] Reply judge(int rows, std::vector<std::uint8_t>& bytes);
  // How far it is.
  [[nodiscard]] Json progress() const;
  [[nodiscard]] bool done() const { return judged_ == asked_.settings.height; }

 private:
  Judging() = default;

  ShadowRequest asked_{};
  std::optional<Rendering> rendering_{};
  std::optional<GroundTruthScene> rays_{};
  std::optional<Judge> judge_{};
  int judged_ = 0;  // rows
};

}  // namespace ninebit::playground
