// The axis of a file's coordinates that points up.
#pragma once

#include "ninebit/scene/scene.h"

namespace ninebit {

// Turns a scene about the x axis, with its cameras and lights: if `up` is z, its z axis becomes y; if it is y, its y
// axis becomes z, which undoes that.
void turn_up(UpAxis up, Scene& scene);

}  // namespace ninebit
