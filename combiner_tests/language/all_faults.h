// All faults of a text that was refused, one a line.
#pragma once

#include <string>

#include "ninebit/language/source_text.h"

namespace ninebit::test {

template <class Value>
std::string all_faults(const Parsed<Value>& parsed) {
  std::string text;
  for (const TextFault& fault : parsed.faults()) text += fault.text() + '\n';
  return text;
}

}  // namespace ninebit::test
