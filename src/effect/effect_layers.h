// The intermediate values of an effect's passes.
#pragma once

#include <deque>
#include <string>

#include "ninebit/frame/rendering.h"
#include "ninebit/raster/surface.h"

namespace ninebit {

// Adds layers "PASS.primary", "PASS.texture0", "PASS.spare0", "PASS.spare1" and "PASS.output", and output planes of the
// target that fill them: the registers after the last general combiner, and the output, of fragments that pass the
// depth test.
void capture_registers(std::deque<Layer>& layers, const std::string& pass, RenderTarget& target);

// Adds the stencil and depth planes.
void add_frame_layers(std::deque<Layer>& layers, const Surface& frame);

}  // namespace ninebit
