// What the page of a trace says above its diagram.
#pragma once

#include <string>

#include "ninebit/combiner/trace.h"
#include "src/page/diagram_page.h"
#include "src/tools/trace/trace_pixel.h"

namespace ninebit::tools {

struct TraceFacts {
  std::string program;                 // file; empty: the program of the pixel's pass
  std::string profile;                 // name
  const TracedPixel* pixel = nullptr;  // nullptr: registers were given
  const Trace* trace = nullptr;        // nullptr: the pixel has no fragment to trace
};

// The page without its trace, explanation and text.
[[nodiscard]] DiagramPage trace_page(const TraceFacts& facts);

}  // namespace ninebit::tools
