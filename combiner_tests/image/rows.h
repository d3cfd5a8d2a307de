// Planes held by a test, in the form that the EXR writers ask for.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <thread>
#include <vector>

#include "ninebit/image/image_io.h"

namespace image_test {

// The rows of a plane of that width, which is borrowed. A row outside the plane, or one wanted in another size, is an
// exception, which makes the writer fail.
template <class Sample>
std::function<void(int, std::span<Sample>)> rows_of(const std::vector<Sample>& plane, int width) {
  return [&plane, columns = static_cast<std::size_t>(width)](int row, std::span<Sample> out) {
    if (out.size() != columns) throw std::logic_error("a row of another width is wanted");
    if (row < 0) throw std::logic_error("a row above the first is wanted");
    const std::size_t first = static_cast<std::size_t>(row) * columns;
    if (first + columns > plane.size()) throw std::logic_error("a row below the last is wanted");
    for (std::size_t i = 0; i < columns; ++i) out[i] = plane[first + i];
  };
}

// Which rows were asked for, in which order. Must not be moved while its functions are in use.
class RowLog {
 public:
  // Rows that hold their own number.
  template <class Sample>
  std::function<void(int, std::span<Sample>)> rows(int width) {
    return [this, columns = static_cast<std::size_t>(width)](int row, std::span<Sample> out) {
      EXPECT_EQ(std::this_thread::get_id(), caller_);
      EXPECT_EQ(out.size(), columns);
      asked_.push_back(row);
      for (Sample& sample : out) sample = static_cast<Sample>(row);
    };
  }
  [[nodiscard]] const std::vector<int>& asked() const { return asked_; }

 private:
  std::thread::id caller_ = std::this_thread::get_id();
  std::vector<int> asked_;
};

// 0, 1, … count - 1
inline std::vector<int> up_to(int count) {
  std::vector<int> numbers;
  for (int i = 0; i < count; ++i) numbers.push_back(i);
  return numbers;
}

}  // namespace image_test
