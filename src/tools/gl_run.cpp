// `ninebit gl-run`: runs a program with register combiners added to its OpenGL driver.
#include <filesystem>
#include <memory>

#include "ninebit/numerics/hardware_profile.h"
#include "src/language/gl_nv/extra_extensions.h"
#include "src/system/process.h"
#include "src/tools/input/printable.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {
namespace {

namespace fs = std::filesystem;

struct GlRunFlags {
  CommonFlags common;
  std::string dump, log, extensions = "none";
  int frame = 0;
  std::vector<std::string> program;
};

// The layer: beside the program in a build folder, in lib/ninebit where it is installed.
fs::path layer_file() {
  std::error_code ignored;
  const fs::path folder = fs::canonical(posix::program_file(), ignored).parent_path();
  for (const fs::path& file : {folder / "libninebit_gl.so", folder.parent_path() / "lib/ninebit/libninebit_gl.so"}) {
    if (fs::exists(file, ignored)) return file;
  }
  return {};
}

// The path for LD_PRELOAD. $LIB is the linker's word for the folder of a process's word length: so programs of 32 bits,
// also those that this one starts, get the library beside it. A linker that knows no such folder of ours gets the file.
std::string preloaded_path(const fs::path& layer) {
  const fs::path of_each = layer.parent_path() / "$LIB" / layer.filename();
  return (posix::load_library(of_each) != nullptr ? of_each : layer).string();
}

// Whether the program is a file of 32 bits for this processor's family. What a script starts is not known.
bool has_32_bits(const std::string& program) {
  const std::string path = program.find('/') == std::string::npos ? posix::environment("PATH") + ':' : ":";
  for (std::size_t begin = 0, end = 0; (end = path.find(':', begin)) != std::string::npos; begin = end + 1) {
    const fs::path file = fs::path(path.substr(begin, end - begin)) / program;
    std::error_code fault;
    if (!fs::is_regular_file(file, fault)) continue;
    const std::string head = posix::read_file(file.string(), 20, fault);
    constexpr char kElf32[]{'\x7F', 'E', 'L', 'F', 1};
    return head.size() == 20 && head.starts_with(std::string_view(kElf32, sizeof(kElf32))) && head[18] == 3;
  }
  return false;
}

// The names of further extensions, each with a comma behind it.
std::string extension_names() {
  std::string names;
  for (const ExtraExtension& one : kExtraExtensions) names += std::string(one.name.substr(3)) + ", ";
  return names;
}

// The first error in a list of further extensions; empty: none.
std::string fault_of_extensions(const std::string& list) {
  std::string unknown;
  if (parse_extras(list, unknown)) return "";
  return printable(unknown) + ": expected " + extension_names() + "all or none";
}

// The program may change its folder before it draws.
std::string absolute(const std::string& name) {
  return name.empty() ? name : fs::absolute(name).lexically_normal().string();
}

int run(const GlRunFlags& flags) {
  const fs::path layer = layer_file();
  if (layer.empty()) {
    say_error(
        "libninebit_gl.so is missing; install the package ninebit-gl, or build ninebit where OpenGL's headers are "
        "(libgl-dev)");
    return kInvalidInput;
  }
  if (layer.string().find_first_of(" :") != std::string::npos) {
    say_error(printable(layer.string()) + ": the dynamic linker cannot preload a path with a space or a colon");
    return kInvalidInput;
  }
  if (sizeof(void*) == 8 && has_32_bits(flags.program.front()) &&
      !fs::exists(layer.parent_path() / "libninebit_gl32.so")) {
    say_error(
        printable(flags.program.front()) +
        ": a program of 32 bits, for which libninebit_gl32.so is missing; install the package ninebit-gl:i386, or "
        "build ninebit where the compiler makes such programs (g++-multilib)");
    return kInvalidInput;
  }
  if (profile_of(flags.common).arithmetic.value != Arithmetic::integer) {
    say_error("--profile " + printable(flags.common.profile) + ": expected a profile with integer arithmetic");
    return kWrongUsage;
  }
  if (!flags.dump.empty()) {
    std::error_code fault;
    fs::create_directories(flags.dump, fault);
    if (fault) {
      say_error(printable(flags.dump) + ": cannot create the folder: " + fault.message());
      return kCannotWrite;
    }
  }
  const std::string preloaded = posix::environment("LD_PRELOAD"), path = preloaded_path(layer);
  posix::set_environment("LD_PRELOAD", preloaded.empty() ? path : path + ':' + preloaded);
  posix::set_environment("NINEBIT_GL_PROFILE", flags.common.profile_file.empty() ? flags.common.profile
                                                                                 : absolute(flags.common.profile_file));
  posix::set_environment("NINEBIT_GL_DUMP", absolute(flags.dump));
  posix::set_environment("NINEBIT_GL_DUMP_FRAME", flags.frame > 0 ? std::to_string(flags.frame) : "");
  posix::set_environment("NINEBIT_GL_LOG", absolute(flags.log));
  posix::set_environment("NINEBIT_GL_EXTENSIONS", flags.extensions);
  const std::error_code fault = posix::become_program(flags.program);
  say_error("cannot run '" + printable(flags.program.front()) + "': " + fault.message());
  return kInvalidInput;
}

}  // namespace

void add_gl_run(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("gl-run", "Run a program with register combiners added to its OpenGL driver");
  verb->footer(
      "Examples:\n"
      "  ninebit gl-run -- ./old_game -windowed\n"
      "  ninebit gl-run --profile geforce2 --dump programs -- ./old_demo\n"
      "The exit code is the program's.");
  auto flags = std::make_shared<GlRunFlags>();
  flags->common.profile = "nv2a";  // of the chips' class that has all the extensions
  add_profile_flag(*verb, flags->common);
  auto* const dump =
      verb->add_option("--dump", flags->dump, "Write each combiner program that is drawn with into this folder")
          ->type_name("DIR");
  verb->add_option("--dump-frame", flags->frame,
                   "Write the draw calls of this frame, too: their states, inputs and pictures; 1 is the first")
      ->needs(dump)
      ->check(whole_in_range(1, 1000000000));
  verb->add_option("--log", flags->log, "Append the layer's messages to this file instead of standard error")
      ->type_name("FILE");
  verb->add_option("--extensions", flags->extensions,
                   "Further extensions to add where the driver lacks them: " + extension_names() +
                       "separated by commas; all or none")
      ->type_name("LIST|all|none")
      ->check(fault_of_extensions)
      ->capture_default_str();
  verb->add_option("program", flags->program, "The program and its arguments, after --")
      ->type_name("PROGRAM [ARGUMENT] ...")
      ->required();
  verb->callback([flags, &exit_code] { exit_code = run(*flags); });
}

}  // namespace ninebit::tools
