#include "src/tools/verbs.h"

#include <exception>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>

#include "src/tools/common/build_facts.h"
#include "src/tools/common/fault_answer.h"
#include "src/tools/common/usage.h"
#include "src/tools/input/fault_log.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

void add_verbs(CLI::App& app, int& exit_code) {
  app.require_subcommand(1);
  app.set_version_flag("-V,--version", version_text, "Print the version and build information");
  app.footer(
      "Example: ninebit render scenes/index_room.gltf -o out\nRun `ninebit help COMMAND` for the flags of a "
      "command.");
  add_render(app, exit_code);
  add_draw(app, exit_code);
  add_compare(app, exit_code);
  add_profiles(app, exit_code);
  add_info(app, exit_code);
  add_eval(app, exit_code);
  add_trace(app, exit_code);
  add_explain(app, exit_code);
  add_convert(app, exit_code);
  add_validate(app, exit_code);
  add_bench(app, exit_code);
  add_study(app, exit_code);
  add_verify(app, exit_code);
  add_prove(app, exit_code);
  add_vectors(app, exit_code);
  add_gl_run(app, exit_code);
  add_help(app, exit_code);
  add_generate(app, exit_code);
}

namespace {

int run(int argc, char** argv) {
  CLI::App app{"Bit-exact emulation of NVIDIA register combiners, and the shadow techniques built on them", "ninebit"};
  int exit_code = kDone;
  add_verbs(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {  // --help or --version
      std::ostringstream text;
      app.exit(error, text, text);
      return answer(text.str());
    }
    say_error(usage_message(app, error));
    return kWrongUsage;
  }
  return exit_code;
}

// Whether a thread could not be started. oneTBB has no exception type for that.
bool lacks_threads(const std::exception& error) {
  const auto* const system = dynamic_cast<const std::system_error*>(&error);
  return (system != nullptr && system->code() == std::errc::resource_unavailable_try_again) ||
         std::string_view(error.what()).starts_with("pthread_create has failed");
}

}  // namespace

int run_verb(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    say("ninebit: error: out of memory\n");
    log_fault({.message = "out of memory"});
    return kOutOfMemory;
  } catch (const InvalidInput& error) {
    return error.report();
  } catch (const std::exception& error) {
    if (lacks_threads(error)) {
      say_error(std::string("out of memory or threads: ") + error.what());
      return kOutOfMemory;
    }
    say_error(error.what());
  }
  return kInvalidInput;
}

}  // namespace ninebit::tools
