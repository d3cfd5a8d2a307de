#include "src/gl_layer/context/context.h"

#include <cstdlib>
#include <map>
#include <string>
#include <system_error>

#include "ninebit/language/profile_json.h"
#include "src/gl_layer/driver/driver.h"
#include "src/gl_layer/driver/log.h"
#include "src/gl_layer/shader/program_cache.h"
#include "src/system/stream.h"

namespace ninebit::gl_layer {

constinit thread_local Context* current_context [[gnu::tls_model("initial-exec")]] = nullptr;

namespace {

std::string environment_value(const char* name) {
  const char* const value = std::getenv(name);
  return value != nullptr ? value : "";
}

}  // namespace

Context::Context(std::shared_ptr<ShareGroup> of, const HardwareProfile& profile)
    : group(std::move(of)),
      combiners(profile),
      writes_inputs(!environment_value("NINEBIT_GL_WRITE_INPUTS").empty()),
      programs(std::make_unique<ProgramCache>(group->own_programs)) {}
Context::~Context() = default;

void Context::raise(unsigned error) {
  if (pending_error != 0) return;
  if (in_begin) {
    if (begin_error == 0) begin_error = error;
    return;
  }
  // The driver may hold an error that came first.
  const GLenum first = found_driver.GetError();
  pending_error = first != GL_NO_ERROR ? first : error;
}

void Context::begin_has_ended() {
  in_begin = false;
  const unsigned error = begin_error;
  begin_error = 0;
  if (error != 0) raise(error);
}

bool Context::outside_begin() {
  if (in_begin) raise(GL_INVALID_OPERATION);
  return !in_begin;
}

namespace {

// The profile in a file; nullptr: the log says why.
const HardwareProfile* profile_in(const std::string& file) {
  // Never destroyed: contexts use them as long as the process lives.
  static auto& read = *new std::map<std::string, OwnedProfile>;
  static auto& mutex = *new std::mutex;
  const std::lock_guard lock(mutex);
  if (const auto found = read.find(file); found != read.end()) return &found->second.profile;
  std::error_code error;
  const std::string content = posix::read_file(file, kMaxSourceBytes + 1, error);
  auto profile = parse_json_profile({.text = content, .file = file});
  if (!profile) {
    log_once(error ? file + ": cannot be read: " + error.message() : profile.faults().front().text());
    return nullptr;
  }
  return &read.emplace(file, std::move(*profile)).first->second.profile;
}

}  // namespace

const HardwareProfile& layer_profile() {
  const std::string name = environment_value("NINEBIT_GL_PROFILE");
  if (name.empty()) return profiles::nv2a;
  const HardwareProfile* const found = name.ends_with(".json") ? profile_in(name) : find_profile(name);
  if (found != nullptr && found->arithmetic.value == Arithmetic::integer) return *found;
  log_once("NINEBIT_GL_PROFILE: '" + name + "' is not a profile with integer arithmetic; using nv2a");
  return profiles::nv2a;
}

}  // namespace ninebit::gl_layer
