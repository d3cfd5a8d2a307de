// Numbers of an effect file that depend on the time of the picture: "0.5 + 0.5 * sin(2 * pi * time)".
#pragma once

#include <string_view>

#include "ninebit/effect/effect_json.h"
#include "ninebit/numerics/result.h"

namespace ninebit::effect_detail {

// The value of an expression at a moment, and whether it depends on the moment.
struct MovingNumber {
  double value = 0.0;
  bool moves = false;  // whether `time` or `frame` is in it
};

// The value of an expression of numbers, + - * / and parentheses, `time`, `frame`, `pi`, and the functions sin, cos
// (of radians), abs, floor, fract, sqrt, min, max. It is the same bits on every machine: sine and cosine are computed
// here, as the C library's may differ. Reports what is not one, and a value that is not finite.
[[nodiscard]] Result<MovingNumber> moving_number(std::string_view text, const EffectMoment& moment);

}  // namespace ninebit::effect_detail
