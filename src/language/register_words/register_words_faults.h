// Collects the faults of a text up to the limit that all parsers share.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ninebit/language/source_text.h"

// Exported because the JSON forms are in a shared library of their own and use these.
namespace NINEBIT_PUBLIC ninebit {

class TextFaults {
 public:
  explicit TextFaults(std::string_view file) : file_(file) {}

  // Has no effect once there are kMaxTextFaults.
  void add(TextPlace place, std::string message, GlError gl_error = GlError::no_error) {
    if (full()) return;
    faults_.push_back({std::string(file_), place.line, place.column, std::move(message), gl_error});
  }
  // Adds the faults of another reader of the same text.
  void add(const std::vector<TextFault>& faults) {
    for (const TextFault& fault : faults) add({fault.line, fault.column}, fault.message, fault.gl_error);
  }

  [[nodiscard]] bool empty() const { return faults_.empty(); }
  [[nodiscard]] bool full() const { return faults_.size() >= kMaxTextFaults; }

  // Returns the faults in the order of the text; the collector is empty afterwards.
  [[nodiscard]] std::vector<TextFault> take();

 private:
  std::string_view file_;
  std::vector<TextFault> faults_;
};

// Adds a fault and returns true if the text is longer than kMaxSourceBytes.
[[nodiscard]] bool too_long(std::string_view text, TextFaults& faults);

}  // namespace ninebit
