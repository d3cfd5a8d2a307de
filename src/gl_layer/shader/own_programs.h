// The names of the driver's programs that the layer has made in a group of contexts. The program that runs never got
// them: its calls with them are answered as if there were none.
#pragma once

#include <atomic>
#include <mutex>
#include <set>
#include <vector>

namespace ninebit::gl_layer {

class OwnPrograms {
 public:
  void add(unsigned name);
  [[nodiscard]] bool has(unsigned name) const;
  // Programs of a context that is gone. The driver deletes them when a context of the group is current.
  void abandon(unsigned name);
  // Only with a context of the group, and not between glBegin and glEnd.
  void delete_abandoned();

 private:
  mutable std::mutex mutex_{};
  std::set<unsigned> names_{};
  std::vector<unsigned> abandoned_{};
  std::atomic<bool> any_ = false;  // whether there ever was one
};

}  // namespace ninebit::gl_layer
