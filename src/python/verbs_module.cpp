// The extension module _verbs: runs the verbs of the program in this process, with the same flags, and takes their
// answers, pictures and pages as values. src/python/ninebit/_calls.py turns keyword arguments into flags.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <semaphore>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "ninebit/frame/technique_settings.h"
#include "ninebit/image/image_io.h"
#include "ninebit/language/program_text.h"
#include "src/image/texture/picture_loader.h"
#include "src/python/waiting.h"
#include "src/tools/input/host.h"
#include "src/tools/input/program.h"
#include "src/tools/verbs.h"

namespace py = pybind11;

namespace ninebit::python {
namespace {

std::filesystem::path module_file;

// Keeps what a verb gives until the interpreter's thread takes it.
class PythonHost : public tools::Host {
 public:
  [[nodiscard]] std::filesystem::path code_file() const override { return module_file; }
  void say(std::string_view text) noexcept override {
    try {
      add(said, text);
    } catch (const std::bad_alloc&) {  // a message is missing; the verb itself reports that memory has run out
    }
  }
  void answer(std::string_view text) override { add(answered, text); }
  void step(std::string_view what, double done) override {
    const std::scoped_lock lock(mutex_);
    step_ = {std::string(what), std::clamp(done, 0.0, 1.0)};
  }
  [[nodiscard]] bool stopped() const override { return stop_; }
  void give(tools::HostArray array) override {
    const std::scoped_lock lock(mutex_);
    arrays.push_back(std::move(array));
  }
  void give(std::string name, std::string text) override {
    const std::scoped_lock lock(mutex_);
    texts[std::move(name)] = std::move(text);
  }

  void stop() { stop_ = true; }
  // The progress since the last call, if there is any.
  std::optional<std::pair<std::string, double>> take_step() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(step_, std::nullopt);
  }

  std::string said, answered;
  std::vector<tools::HostArray> arrays;
  std::map<std::string, std::string> texts;

 private:
  void add(std::string& to, std::string_view text) {
    const std::scoped_lock lock(mutex_);
    to += text;
  }

  std::atomic<bool> stop_ = false;
  std::mutex mutex_;
  std::optional<std::pair<std::string, double>> step_;
};

// The verbs share one host, so one runs at a time. A verb's turn begins on the thread of its caller, and ends on that
// of its work.
std::binary_semaphore turn{1};

// Waits for a turn; Ctrl-C ends the wait.
void take_turn() {
  for (bool taken = false; !taken;) {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    const py::gil_scoped_release others_may_run;
    taken = turn.try_acquire_for(std::chrono::milliseconds(10));
  }
}

// Whether this thread is waiting for a verb, and so may not begin another one in a progress function.
class Waiting {
 public:
  Waiting() {
    if (waits_) throw std::runtime_error("a progress function must not call a verb of ninebit; another one is running");
    waits_ = true;
  }
  ~Waiting() { waits_ = false; }
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;

 private:
  inline static thread_local bool waits_ = false;
};

// One run of a verb. The thread that works on it and the one that waits for it share it: after Ctrl-C, the work may go
// on for a moment without the other.
struct Job {
  explicit Job(std::vector<std::string> given) : words(std::move(given)) { words.insert(words.begin(), "ninebit"); }

  void run() {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    tools::clear_faults();
    tools::set_host(&host);
    try {
      exit_code = tools::run_verb(static_cast<int>(arguments.size()), arguments.data());
      faults = tools::logged_faults();
    } catch (const std::bad_alloc&) {
      exit_code = tools::kOutOfMemory;
    }
    tools::set_host(nullptr);
    turn.release();
    finish.reach();
  }

  PythonHost host;
  std::vector<std::string> words;
  int exit_code = 0;
  std::vector<tools::LoggedFault> faults;
  Finish finish;
};

py::array array_of(const tools::HostArray& given) {
  const py::capsule keeps(new std::shared_ptr<const void>(given.owner),
                          [](void* kept) { delete static_cast<std::shared_ptr<const void>*>(kept); });
  return py::array(py::dtype(std::string(1, given.kind)), given.shape, given.strides, given.first, keeps);
}

// An interrupt is answered after this time, even if the work has not noticed it yet.
constexpr std::chrono::milliseconds kPatience(50);

void run_beside(const std::shared_ptr<Job>& job, const std::optional<py::function>& progress) {
  const Waiting waiting;
  take_turn();
  try {
    std::thread([job] { job->run(); }).detach();
  } catch (...) {
    turn.release();
    throw;
  }
  const auto tick = [&] {
    const auto step = job->host.take_step();
    if (step && progress) (*progress)(step->second, step->first);
  };
  wait_for(
      job->finish, [&] { job->host.stop(); }, tick, kPatience);
  if (progress && job->exit_code <= tools::kDifference) (*progress)(1.0, "done");
}

py::dict run(std::vector<std::string> words, const std::optional<py::function>& progress) {
  const auto job = std::make_shared<Job>(std::move(words));
  run_beside(job, progress);
  py::dict answer;
  answer["exit_code"] = job->exit_code;
  answer["answer"] = job->host.answered;
  answer["said"] = job->host.said;
  answer["texts"] = job->host.texts;
  py::list faults, arrays;
  for (const tools::LoggedFault& fault : job->faults) {
    faults.append(py::make_tuple(fault.message, fault.file, fault.line, fault.column));
  }
  for (const tools::HostArray& array : job->host.arrays) arrays.append(py::make_tuple(array.name, array_of(array)));
  answer["faults"] = faults;
  answer["arrays"] = arrays;
  return answer;
}

// Waits for work that goes on after an interrupt, before the interpreter ends.
void wait_for_work() {
  const py::gil_scoped_release others_may_run;
  turn.acquire();
  turn.release();
}

// The flags of a verb such as {"study", "shadows"}: (name without dashes, whether it takes a value, whether it may be
// repeated, help). Arguments without a flag are left out.
std::vector<std::tuple<std::string, bool, bool, std::string>> flags(const std::vector<std::string>& verb) {
  CLI::App app("", "ninebit");
  int exit_code = 0;
  tools::add_verbs(app, exit_code);
  const CLI::App* at = &app;
  for (const std::string& word : verb) at = at->get_subcommand(word);
  std::vector<std::tuple<std::string, bool, bool, std::string>> found;
  for (const CLI::Option* option : at->get_options()) {
    for (const std::string& name : option->get_lnames()) {
      found.emplace_back(name, option->get_items_expected_max() != 0, option->get_expected_max() > 1,
                         option->get_description());
    }
  }
  return found;
}

// The settings of techniques, for write_stubs.py: (keyword, kind, how many numbers a value has, words, the keyword of
// their list in a sweep or nothing).
py::list settings() {
  constexpr std::array kKinds{"whole", "real", "word", "files"};
  py::list all;
  for (const TechniqueSetting& setting : technique_settings()) {
    py::list words;
    for (const SettingWord& word : setting.words) words.append(std::string(word.word));
    std::string axis(setting.axis.flag);
    std::replace(axis.begin(), axis.end(), '-', '_');
    all.append(
        py::make_tuple(setting.key(), kKinds[static_cast<std::size_t>(setting.kind)], setting.numbers, words, axis));
  }
  return all;
}

// The names of the forms of programs, for write_stubs.py.
py::dict forms() {
  return py::dict(py::arg("read") = read_form_names(), py::arg("written") = written_form_names());
}

py::bytes png(const py::array_t<std::uint8_t, py::array::c_style>& pixels) {
  const bool grey = pixels.ndim() == 2;
  const py::ssize_t channels = grey ? 1 : pixels.ndim() == 3 ? pixels.shape(2) : 0;
  if (channels != 1 && channels != 3 && channels != 4) {
    throw py::value_error("a picture must have the shape (height, width), (height, width, 3) or (height, width, 4)");
  }
  Image8 image{static_cast<int>(pixels.shape(1)), static_cast<int>(pixels.shape(0)), static_cast<int>(channels), {}};
  image.pixels.assign(pixels.data(), pixels.data() + pixels.size());
  const auto encoded = encode_png(image);
  if (!encoded) throw py::value_error(encoded.error().message);
  return py::bytes(*encoded);
}

}  // namespace
}  // namespace ninebit::python

PYBIND11_MODULE(_verbs, module) {
  using namespace ninebit;
  module.def(
      "set_file",
      [](const std::string& file) {
        python::module_file = file;
        image_detail::set_picture_folder(python::module_file.parent_path());
      },
      py::arg("file"), "Says where this module lies, which it does not know while it is loaded. Call it first.");
  module.def("run", &python::run, py::arg("words"), py::arg("progress") = py::none());
  py::module_::import("atexit").attr("register")(py::cpp_function(&python::wait_for_work));
  module.def("flags", &python::flags, py::arg("verb"));
  module.def("settings", &python::settings);
  module.def("forms", &python::forms);
  module.def("png", &python::png, py::arg("pixels"));
}
