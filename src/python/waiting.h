// Long work beside an interpreter that goes on.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>

namespace ninebit::python {

// The end of the work, which another thread waits for.
class Finish {
 public:
  void reach();
  // Whether it is reached, or is within the time.
  [[nodiscard]] bool wait(std::chrono::milliseconds time);

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool reached_ = false;
};

// Waits until the work of another thread is finished. The GIL, which must be held, is released, and taken every few
// milliseconds to let Python handle signals and to call `tick`. If either raises an exception, `stop` is called, and
// the exception is thrown once the work has finished, or after `patience` if it has not finished by then.
void wait_for(Finish& finish, const std::function<void()>& stop, const std::function<void()>& tick,
              std::optional<std::chrono::milliseconds> patience);

// Runs `work` on a thread of its own and waits for it. Exceptions of `work` are thrown as well.
void work_beside(const std::function<void()>& work, const std::function<void()>& stop);

}  // namespace ninebit::python
