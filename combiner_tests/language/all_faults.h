// Faults of texts that were refused.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "ninebit/language/source_text.h"

namespace ninebit::test {

// All of them, one a line.
template <class Value>
std::string all_faults(const Parsed<Value>& parsed) {
  std::string text;
  for (const TextFault& fault : parsed.faults()) text += fault.text() + '\n';
  return text;
}

// A text with all faults that it is refused with; "": it is read.
struct TextAndFaults {
  std::string text, faults;
};
// Fails the test unless each text has its faults. `parse`: what reads a text.
template <class Parse>
void expect_faults(const std::vector<TextAndFaults>& cases, const Parse& parse) {
  for (const auto& [text, faults] : cases) {
    const auto parsed = parse(text);
    EXPECT_NE(parsed.ok(), !parsed.faults().empty());
    EXPECT_EQ(all_faults(parsed), faults) << text;
    for (const TextFault& fault : parsed.faults()) EXPECT_FALSE(fault.message.starts_with("GL_")) << fault.message;
  }
}

// A fault of the file "f" at its place, with a part of its text.
struct PlacedFault {
  int line = 0, column = 0;
  std::string part{};
};
// Fails the test unless a text was refused with this fault, beside others or not.
template <class Value>
void expect_fault(const Parsed<Value>& parsed, const PlacedFault& expected, std::string_view text) {
  EXPECT_FALSE(parsed) << text.substr(0, 200);
  const auto is_it = [&](const TextFault& fault) {
    return fault.file == "f" && fault.line == expected.line && fault.column == expected.column &&
           fault.text().find(expected.part) != std::string::npos;
  };
  EXPECT_TRUE(std::any_of(parsed.faults().begin(), parsed.faults().end(), is_it))
      << text.substr(0, 200) << "\nexpected: " << expected.line << ':' << expected.column << ": " << expected.part
      << "\nfound: " << all_faults(parsed);
}

}  // namespace ninebit::test
