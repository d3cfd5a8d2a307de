#include "src/gl_layer/shader/own_programs.h"

#include "src/gl_layer/driver/driver.h"

namespace ninebit::gl_layer {

void OwnPrograms::add(unsigned name) {
  const std::lock_guard lock(mutex_);
  names_.insert(name);
  any_ = true;
}

bool OwnPrograms::has(unsigned name) const {
  if (!any_) return false;
  const std::lock_guard lock(mutex_);
  return names_.contains(name);
}

void OwnPrograms::abandon(unsigned name) {
  const std::lock_guard lock(mutex_);
  abandoned_.push_back(name);
}

void OwnPrograms::delete_abandoned() {
  if (!any_) return;
  const std::lock_guard lock(mutex_);
  for (const unsigned name : abandoned_) {
    names_.erase(name);  // first: from its deletion on the driver may give the name to the program
    found_driver.DeleteProgram(name);
  }
  abandoned_.clear();
}

}  // namespace ninebit::gl_layer
