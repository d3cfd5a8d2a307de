#include "src/tools/verbs.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>

#include "src/tools/common/build_facts.h"
#include "src/tools/common/usage.h"
#include "src/tools/input/host.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

namespace {

struct Verb {
  std::string_view name;
  void (*add)(CLI::App& app, int& exit_code);
};

constexpr Verb kVerbs[] = {{"render", &add_render},     {"draw", &add_draw},       {"compare", &add_compare},
                           {"profiles", &add_profiles}, {"info", &add_info},       {"eval", &add_eval},
                           {"trace", &add_trace},       {"explain", &add_explain}, {"convert", &add_convert},
                           {"validate", &add_validate}, {"bench", &add_bench},     {"study", &add_study},
                           {"verify", &add_verify},     {"prove", &add_prove},     {"vectors", &add_vectors},
                           {"gl-run", &add_gl_run},     {"help", &add_help},       {"generate", &add_generate}};

void set_up_program(CLI::App& app) {
  app.require_subcommand(1);
  app.set_version_flag("-V,--version", version_text, "Print the version and build information");
  app.footer(
      "Example: ninebit render scenes/index_room.gltf -o out\nRun `ninebit help COMMAND` for the flags of a "
      "command.");
}

// Adds the verb that this first argument names, or all: for a wrong name, and for what describes the program.
void add_named_verb(CLI::App& app, int& exit_code, std::string_view name) {
  if (name == "-V" || name == "--version") return set_up_program(app);
  const auto* const verb =
      std::find_if(std::begin(kVerbs), std::end(kVerbs), [&](const Verb& v) { return v.name == name; });
  if (verb == std::end(kVerbs) || name == "help" || name == "generate") return add_verbs(app, exit_code);
  set_up_program(app);
  verb->add(app, exit_code);
}

}  // namespace

void add_verbs(CLI::App& app, int& exit_code) {
  set_up_program(app);
  for (const Verb& verb : kVerbs) verb.add(app, exit_code);
}

namespace {

int run(int argc, char** argv) {
  CLI::App app{"Bit-exact emulation of NVIDIA register combiners, and the shadow techniques built on them", "ninebit"};
  int exit_code = kDone;
  set_given_command(argc, argv);
  add_named_verb(app, exit_code, argc > 1 ? argv[1] : "");  // all verbs take longer than most of them run
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {  // --help or --version
      std::ostringstream text;
      app.exit(error, text, text);
      return answer(wrapped_for_terminal(text.str(), kHelpColumn));
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
