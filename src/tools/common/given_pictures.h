// Pictures that a verb has drawn, as arrays for its host. Nothing here does anything without a host.
#pragma once

#include <deque>
#include <string>

#include "ninebit/image/image_io.h"
#include "ninebit/raster/surface.h"
#include "ninebit/shadow/technique.h"

namespace ninebit::tools {

// An upright picture.
void give_picture(std::string name, Image8 image);

// `color` (with alpha, averaged over n × n pixels), `depth` and `stencil`.
void give_surface(const Surface& surface, int n = 1);

// The layers under the names PART.CHANNEL.
void give_layers(const std::deque<Layer>& layers);

// The planes of the frame, the faces of the index map, the maps and layers, and the technique's own pictures.
void give_rendering(const Rendering& rendering, int supersample);

}  // namespace ninebit::tools
