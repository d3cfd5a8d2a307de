#include "src/gl_layer/context.h"

#include <cstdlib>
#include <string>

#include "src/gl_layer/display_lists.h"
#include "src/gl_layer/driver.h"
#include "src/gl_layer/log.h"
#include "src/gl_layer/program_cache.h"

namespace ninebit::gl_layer {

constinit thread_local Context* current_context [[gnu::tls_model("initial-exec")]] = nullptr;

Context::Context(std::shared_ptr<ShareGroup> of, const HardwareProfile& profile)
    : group(std::move(of)), combiners(profile), programs(std::make_unique<ProgramCache>()) {}
Context::~Context() = default;

void Context::raise(unsigned error) {
  if (pending_error != 0) return;
  // The driver may hold an error that came first.
  const GLenum first = in_begin ? GLenum{GL_NO_ERROR} : found_driver.GetError();
  pending_error = first != GL_NO_ERROR ? first : error;
}

bool Context::outside_begin() {
  if (in_begin) raise(GL_INVALID_OPERATION);
  return !in_begin;
}

void Context::record(const std::function<void()>& command) {
  close_driver_list(*this);
  open_list->list.steps.push_back(command);
  if (open_list->mode == GL_COMPILE_AND_EXECUTE) {
    std::unique_ptr<OpenList> list = std::move(open_list);
    command();
    open_list = std::move(list);
  }
  open_driver_list(*this);
}

const HardwareProfile& layer_profile() {
  const char* const name = std::getenv("NINEBIT_GL_PROFILE");
  if (name == nullptr || *name == '\0') return profiles::nv2a;
  const HardwareProfile* const found = find_profile(name);
  if (found != nullptr && found->arithmetic.value == Arithmetic::integer) return *found;
  log_once("NINEBIT_GL_PROFILE: '" + std::string(name) + "' is not a profile with integer arithmetic; using nv2a");
  return profiles::nv2a;
}

}  // namespace ninebit::gl_layer
