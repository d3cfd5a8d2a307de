#include "src/gl_layer/capture/dump.h"

#include <atomic>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>

#include "ninebit/language/explain.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/language/json.h"
#include "src/gl_layer/capture/capture.h"
#include "src/gl_layer/capture/captured_effect.h"
#include "src/gl_layer/capture/draw_description.h"
#include "src/gl_layer/capture/zip.h"
#include "src/gl_layer/driver/log.h"

namespace ninebit::gl_layer {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string numbered(const char* name, std::size_t number) {
  char text[64];
  std::snprintf(text, sizeof(text), "%s-%03zu", name, number);
  return text;
}

struct DumpedProgram {
  std::string profile{};
  std::vector<std::string> files{};
  std::shared_ptr<const std::atomic<std::uint64_t>> draws{};
};

// The folder, the list of programs in it, and the frame that is captured. Contexts of several threads may draw.
class Dump {
 public:
  static Dump& get() {
    static Dump& dump = *new Dump;  // never destroyed: programs draw from their own destructors
    return dump;
  }

  [[nodiscard]] bool is_on() const { return !folder_.empty(); }
  [[nodiscard]] bool captures(const Context& context) const {
    return frame_ != 0 && context.frame + 1 == frame_ && is_on();
  }

  void add_program(const CombinerState& state, const HardwareProfile& profile, const CachedProgram& cached) {
    const std::lock_guard lock(mutex_);
    const std::string name = numbered("program", cached.number);
    DumpedProgram entry{.profile = std::string(profile.name), .draws = cached.draws};
    const auto write = [&](const std::string& file, const std::string& content) {
      if (write_file(folder_ / file, content)) entry.files.push_back(file);
    };
    if (const auto calls = print_gl_calls(state, profile)) write(name + ".gl", *calls);
    write(name + ".json", print_json_program(state));
    write(name + ".txt", print_explanation(explain(normalize(state, profile), profile)));
    write(name + ".glsl", cached.shader);
    programs_[cached.number] = std::move(entry);
    write_list();
  }

  void add_draw(const Context& context, Json state, const CapturedDraw* draw) {
    const std::lock_guard lock(mutex_);
    const std::string name = numbered("draw", draws_.size() + 1);
    const fs::path folder = folder_ / numbered("frame", frame_);
    if (draw != nullptr) {
      std::error_code fault;
      fs::create_directories(folder, fault);
      const HardwareProfile& profile = context.combiners.profile();
      const std::string program = numbered("program", draw->program) + ".json";
      const CapturedFiles files = write_effect(folder, name, *draw, context.combiners.state(), profile, program);
      // Beside the effect that names it: an effect may name files of its own folder alone.
      fs::copy_file(folder_ / program, folder / program, fs::copy_options::overwrite_existing, fault);
      if (fault) {
        log_line((folder / program).string() + ": cannot be written");
      } else {
        frame_files_.insert(folder / program);
      }
      for (const std::string& file : files.files) frame_files_.insert(folder_ / file);
      state["pixels"] = files.pixels;
      state["files"] = files.files;
      state["left_out"] = files.left_out;
    }
    draws_.push_back(std::move(state));
  }

  // Another context's frame N may follow: then all is written again, with its draw calls behind these.
  void end_frame(const Context& context) {
    if (!is_on()) return;
    const std::lock_guard lock(mutex_);
    write_list();
    if (frame_ == 0 || context.frame != frame_) return;
    const Json frame{{"ninebit", "captured frame"}, {"version", 1}, {"frame", frame_}, {"draws", draws_}};
    const std::string name = numbered("frame", frame_), description = frame.dump(2) + '\n';
    const fs::path list = folder_ / (name + ".json"), archive = folder_ / (name + ".zip");
    const bool listed = write_file(list, description), archived = listed && write_archive(archive, list);
    std::error_code fault;
    if (!archived) fs::remove(archive, fault);  // an earlier run's
    if (listed) {
      log_line("frame " + std::to_string(frame_) + ": " + std::to_string(draws_.size()) + " draw calls in " +
               list.string() + (archived ? " and " + archive.filename().string() : ""));
    }
  }

 private:
  Dump() {
    const char* const folder = std::getenv("NINEBIT_GL_DUMP");
    if (folder == nullptr || *folder == '\0') return;
    folder_ = folder;
    if (const char* const frame = std::getenv("NINEBIT_GL_DUMP_FRAME")) {
      std::from_chars(frame, frame + std::strlen(frame), frame_);
    }
    std::atexit([] {
      const std::lock_guard lock(get().mutex_);
      get().write_list();
    });
  }

  // The frame's files in one, the list of its draw calls last. A frame without combiners has no archive.
  [[nodiscard]] bool write_archive(const fs::path& archive, const fs::path& list) const {
    if (frame_files_.empty()) return false;
    std::vector<fs::path> files(frame_files_.begin(), frame_files_.end());
    files.push_back(list);
    return write_zip(archive, files);
  }

  void write_list() const {
    Json list = Json::array();
    for (const auto& [number, entry] : programs_) {
      list.push_back(
          {{"program", number}, {"draws", entry.draws->load()}, {"profile", entry.profile}, {"files", entry.files}});
    }
    const Json all{{"ninebit", "dumped programs"}, {"version", 1}, {"programs", list}};
    write_file(folder_ / "programs.json", all.dump(2) + '\n');
  }

  std::mutex mutex_{};
  fs::path folder_{};
  std::uint32_t frame_ = 0;
  std::map<std::size_t, DumpedProgram> programs_{};
  Json draws_ = Json::array();
  std::set<fs::path> frame_files_{};  // of these draws; the folder may have those of earlier runs as well
};

// The draw call of this thread that is being captured.
struct Captured {
  std::unique_ptr<Capture> capture{};  // nullptr: only the state is listed
  Json state{};
};

Captured& captured_draw() {
  thread_local auto& draw = *new Captured;  // without a destructor: programs draw at their exit
  return draw;
}

}  // namespace

bool begin_capture(Context& context, const char* call) {
  if (!Dump::get().is_on()) return false;
  if (context.program != nullptr && !context.program->dumped) {
    context.program->dumped = true;
    Dump::get().add_program(context.combiners.state(), context.combiners.profile(), *context.program);
  }
  if (!Dump::get().captures(context)) return false;
  captured_draw().state = describe_draw(context, call);
  captured_draw().capture = Capture::begin(context, call);
  return true;
}

void end_capture(Context& context) {
  Captured& captured = captured_draw();
  if (captured.capture == nullptr) {
    Dump::get().add_draw(context, std::move(captured.state), nullptr);
    return;
  }
  const CapturedDraw draw = captured.capture->end();
  captured.capture = nullptr;
  if (draw.call == "glCallList" && !draws_anything(draw)) return;  // a list of state alone
  Dump::get().add_draw(context, std::move(captured.state), &draw);
}

void frame_ended(const Context& context) {
  Dump::get().end_frame(context);
}

}  // namespace ninebit::gl_layer
