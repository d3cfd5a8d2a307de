// The operations of the datapath as lists of cases.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/study/datapath_error.h"

namespace ninebit {

// One operation in one form. A case stands for all inputs that give the same intermediate value.
struct DatapathOperation {
  std::string_view name;
  std::string form;
  std::size_t cases = 0;
  std::function<std::uint64_t(std::size_t)> weight;       // number of inputs that a case stands for
  std::function<int(const Datapath&, std::size_t)> code;  // the datapath's result
  std::function<double(std::size_t)> exact;               // the extension's result in real numbers, clamped
  std::function<std::string(std::size_t)> inputs;         // one of the case's inputs, as codes
};

inline constexpr std::array<std::string_view, 9> kOperations{"mapping",   "scale and bias", "product",
                                                             "AB + CD",   "dot product",    "mux takes CD",
                                                             "color sum", "E times F",      "final lerp"};

// The exact output: (value + bias) · scale, clamped to [-1, 1].
[[nodiscard]] double exact_output(const OutputForm& form, double value);

struct WideCounts;

// The names of the forms of kOperations[kind], in the order of Operations::of(), without making the forms.
[[nodiscard]] std::vector<std::string> forms_of(std::size_t kind);

// The operations on registers whose 1.0 is the code `one`. The forms of an operation are made on first use.
class Operations {
 public:
  explicit Operations(int one) : one_(one) {}

  // All forms of kOperations[kind]. Thread-safe; must not be called within a parallel loop, because it may run one.
  [[nodiscard]] const std::vector<DatapathOperation>& of(std::size_t kind);

 private:
  const std::shared_ptr<const WideCounts>& counts(std::size_t terms);

  int one_;
  std::array<std::once_flag, kOperations.size()> made_;
  std::array<std::vector<DatapathOperation>, kOperations.size()> operations_;
  std::array<std::once_flag, 3> counted_;
  std::array<std::shared_ptr<const WideCounts>, 3> counts_;  // for sums of one, two and three products
};

}  // namespace ninebit
