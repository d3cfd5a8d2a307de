#include "src/python/waiting.h"

#include <pybind11/pybind11.h>

#include <exception>
#include <thread>

namespace py = pybind11;

namespace ninebit::python {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kBetweenTicks(10);

}  // namespace

void Finish::reach() {
  const std::scoped_lock lock(mutex_);
  reached_ = true;
  changed_.notify_all();
}

bool Finish::wait(std::chrono::milliseconds time) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, time, [&] { return reached_; });
}

void wait_for(Finish& finish, const std::function<void()>& stop, const std::function<void()>& tick,
              std::optional<std::chrono::milliseconds> patience) {
  std::exception_ptr raised;
  Clock::time_point since{};
  for (bool done = false; !done;) {
    {
      const py::gil_scoped_release others_may_run;
      done = finish.wait(kBetweenTicks);
    }
    if (raised) {
      if (patience && Clock::now() - since > *patience) break;
      continue;
    }
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (tick) tick();
    } catch (...) {
      raised = std::current_exception();
      since = Clock::now();
      stop();
    }
  }
  if (raised) std::rethrow_exception(raised);
}

void work_beside(const std::function<void()>& work, const std::function<void()>& stop) {
  Finish finish;
  std::exception_ptr of_work;
  std::thread worker([&] {
    try {
      work();
    } catch (...) {
      of_work = std::current_exception();
    }
    finish.reach();
  });
  std::exception_ptr raised;
  try {
    wait_for(finish, stop, {}, std::nullopt);
  } catch (...) {
    raised = std::current_exception();
  }
  worker.join();
  if (raised) std::rethrow_exception(raised);
  if (of_work) std::rethrow_exception(of_work);
}

}  // namespace ninebit::python
