#include "src/tools/trace/trace_page.h"

#include <fmt/format.h>

#include "src/tools/input/printable.h"

namespace ninebit::tools {

DiagramPage trace_page(const TraceFacts& facts) {
  DiagramPage page{.kind = "ninebit trace", .title = printable(facts.program)};
  const auto fact = [&](const char* name, const std::string& value) {
    page.facts.emplace_back(name, printable(value));
  };
  if (const TracedPixel* const pixel = facts.pixel) {
    page.title = fmt::format("Pixel {},{} of {}", pixel->x, pixel->y, printable(pixel->file));
    if (!facts.program.empty()) fact("Program", facts.program);
    if (!pixel->technique.empty()) fact("Technique", pixel->technique);
    fact("Size", pixel->size);
    fact("State", pixel->state);
    if (pixel->pass) fact("Pass", pixel->passes[*pixel->pass].name);
  }
  fact("Profile", facts.profile);
  if (facts.trace != nullptr) {
    fact("Out", fmt::format("bytes {}", fmt::join(facts.trace->bytes, ", ")));
  }
  fact("Version", "ninebit " NINEBIT_VERSION);
  return page;
}

}  // namespace ninebit::tools
