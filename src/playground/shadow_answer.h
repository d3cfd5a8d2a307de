// Index cube shadows in the playground.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ninebit/frame/settings.h"
#include "ninebit/scene/scene.h"
#include "src/playground/engine.h"

namespace ninebit::playground {

// The requests {"do": "shadow", …} and {"do": "judge", …}.
struct ShadowRequest {
  Scene scene{};              // complete: one camera, one light
  RenderSettings settings{};  // their profile's name stays valid as long as `profile`
  ChosenProfile profile{};
  bool hashed = true;  // whether the answer has the frame's hashes
};
// Fills `out`, or returns why that is not possible.
[[nodiscard]] std::optional<Reply> ask_for_shadow(Request& request, const Shelf& shelf, ShadowRequest& out);

// Where the camera and the light of a complete scene are.
[[nodiscard]] Json view_of(const Scene& scene);

// {"do": "shadow", …}: the picture, then the index cube unfolded, as RGBA in `bytes`.
[[nodiscard]] Reply shadow_answer(Request& request, const Shelf& shelf, std::vector<std::uint8_t>& bytes);

}  // namespace ninebit::playground
