// The ninebit program: one file a verb, this one chooses among them.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <new>

#include "src/tools/program.h"

int main(int argc, char** argv) {
  using namespace ninebit::tools;
  CLI::App app{"GeForce 2 register combiners to the bit, and the shadow techniques built on them", "ninebit"};
  app.require_subcommand(1);
  app.set_version_flag("--version", "ninebit " NINEBIT_VERSION);
  app.footer("Example: ninebit render scenes/index_room.gltf -o out\n`ninebit VERB --help` tells a verb's flags.");
  int exit_code = kDone;
  add_render(app, exit_code);
  add_profiles(app, exit_code);
  add_info(app, exit_code);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);
    fmt::print(stderr, "ninebit: error: {}\n`ninebit --help` and `ninebit VERB --help` tell what is expected.\n",
               e.what());
    return kWrongUsage;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "ninebit: error: out of memory\n");
    return kInvalidInput;
  } catch (const std::exception& e) {
    fmt::print(stderr, "ninebit: error: {}\n", e.what());
    return kInvalidInput;
  }
  return exit_code;
}
