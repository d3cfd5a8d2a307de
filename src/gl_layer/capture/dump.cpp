#include "src/gl_layer/capture/dump.h"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>

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

// What an archive can count, and about the bytes of the headings of one file.
constexpr std::size_t kMostArchived = 65535, kArchiveHeadings = 512;

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
    std::error_code fault;
    fs::create_directories(folder, fault);
    if (draw != nullptr) {
      const HardwareProfile& profile = context.combiners.profile();
      const std::string program = numbered("program", draw->program) + ".json";
      const CapturedFiles files = write_effect(folder, name, *draw, context.combiners.state(), profile, program);
      // Beside the effect that names it: an effect may name files of its own folder alone.
      fs::copy_file(folder_ / program, folder / program, fs::copy_options::overwrite_existing, fault);
      if (fault) log_line((folder / program).string() + ": cannot be written");
      state["pixels"] = files.pixels;
      state["files"] = files.files;
      state["left_out"] = files.left_out;
    }
    draws_.push_back(std::move(state));
  }

  void end_frame(const Context& context) {
    if (!is_on()) return;
    const std::lock_guard lock(mutex_);
    write_list();
    if (frame_ == 0 || context.frame != frame_) return;
    const Json frame{{"ninebit", "captured frame"}, {"version", 1}, {"frame", frame_}, {"draws", draws_}};
    const std::string name = numbered("frame", frame_), description = frame.dump(2) + '\n';
    write_file(folder_ / (name + ".json"), description);
    write_archive(folder_ / name, name, description);
    log_line("frame " + std::to_string(frame_) + ": " + std::to_string(draws_.size()) + " draw calls in " +
             (folder_ / name).string() + " and " + name + ".zip");
    draws_ = Json::array();
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

  // The frame's files in one. A frame without combiners has no folder and no archive.
  static void write_archive(const fs::path& folder, const std::string& name, const std::string& description) {
    std::vector<std::pair<std::string, std::string>> files;
    std::uint64_t bytes = 0;
    std::error_code fault;
    for (const auto& entry : fs::directory_iterator(folder, fault)) {
      std::ifstream stream(entry.path(), std::ios::binary);
      files.emplace_back(entry.path().filename().string(), std::string(std::istreambuf_iterator<char>(stream), {}));
      bytes += files.back().second.size() + kArchiveHeadings;
    }
    if (files.empty()) return;
    if (files.size() >= kMostArchived || bytes >> 32U != 0) {
      return log_line(name + ".zip: the frame is too large for an archive: " + std::to_string(bytes) + " bytes");
    }
    std::sort(files.begin(), files.end());
    files.emplace_back(name + ".json", description);
    write_file(folder.parent_path() / (name + ".zip"), zip_file(files));
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
