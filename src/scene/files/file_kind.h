// Detects a file's type from its first bytes.
#pragma once

#include <optional>
#include <string_view>

#include "ninebit/scene/scene.h"

namespace ninebit {

// "a PNG picture", "a glTF file"; nothing if the bytes are those of the extension `expected` (".obj", in lower case) or
// of an unknown type.
[[nodiscard]] std::optional<std::string_view> other_kind(std::string_view content, std::string_view expected);

// The axis of a file's coordinates that points up.

// Turns a scene about the x axis, with its cameras and lights: if `up` is z, its z axis becomes y; if it is y, its y
// axis becomes z, which undoes that.
void turn_up(UpAxis up, Scene& scene);

}  // namespace ninebit
