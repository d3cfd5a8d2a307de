// Traces of register writes, written in the style of each tool and in columns.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "combiner_tests/support/random.h"
#include "ninebit/language/register_words.h"

namespace ninebit::test {

struct TraceWrite {
  std::uint32_t method = 0, data = 0;
  std::uint32_t object_class = 0x97;
};
using Trace = std::vector<TraceWrite>;

// A style with its name for messages. `guesses`: the columns are guessed. `classes`: it has those of the objects.
struct TraceStyle {
  const char* name;
  bool guesses, classes;
  std::function<std::string(const Trace&)> text;
};
std::vector<TraceStyle> all_styles();

// The writes of a program's words, in a random order.
Trace writes_of(const std::vector<RegisterWord>& words, Random& random);

// Programs of the NV2A, draws and flips.
Trace random_trace(Random& random);

// The number of the method of a word of NV20: RC_IN_RGB[2] is 0x0ac8.
std::uint32_t method_of_word(const std::string& name);

// A draw: a begin, what makes vertices, an end.
void add_draw(Trace& trace, std::uint32_t primitive, const Trace& inside = {{0x1810, 0x02000000}});

}  // namespace ninebit::test
