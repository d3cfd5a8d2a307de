#include "src/tools/prove/kit_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "ninebit/language/gl_calls.h"
#include "src/tools/common/kit_table.h"

namespace ninebit::tools {
namespace {

// The rows of the kit, each with a function that sets its program.
Result<std::string> kit_rows(const ChipKit& kit) {
  std::string functions, rows;
  for (std::size_t i = 0; i < kit.programs.size(); ++i) {
    const Discriminator& program = kit.programs[i];
    const auto calls = print_gl_calls(program.state, kit.family);
    if (!calls) return calls.error();
    functions += fmt::format("\nstatic void {}(void) {{\n{}}}\n", kit_name(i), *calls);
    const auto off = std::find(program.texture_off.begin(), program.texture_off.end(), true);
    rows += fmt::format("    {{\"{}\",\n     {}, {}, {}, {}}},\n", kit_row(kit, i), fmt::join(program.bytes, ", "),
                        off == program.texture_off.end() ? -1 : static_cast<int>(off - program.texture_off.begin()),
                        program.rc10.find("col1") != std::string::npos ? 1 : 0, kit_name(i));
  }
  return fmt::format(
      "{}\ntypedef struct {{\n  const char *begin; /* of its row in the table */\n  int tex0, tex1, primary, unit_off, "
      "reads_secondary;\n  void (*program)(void);\n}} Row;\nstatic const Row rows[] = {{\n{}}};\n"
      "#define ROWS ((int)(sizeof rows / sizeof rows[0]))\n#define FAMILY \"{}\"\n#define HEADER \"{}\"\n",
      functions, rows, kit.family.name, kit_header());
}

}  // namespace

Result<std::string> kit_source(const ChipKit& kit) {
  const auto rows = kit_rows(kit);
  if (!rows) return rows.error();
  std::string text(kKitText);
  const std::size_t begin = text.find("/* ROWS"), end = text.find('\n', begin);
  text.replace(begin, end - begin, *rows);
  return fmt::format(
      "/* Made by `ninebit prove kit --family {}`; README.md beside it says how to use it.\n"
      "   Linux:   cc -std=c99 kit.c -o kit -lGL -lX11\n"
      "   Windows: x86_64-w64-mingw32-gcc -std=c99 kit.c -o kit.exe -lopengl32 -lgdi32 */\n{}",
      kit.family.name, text);
}

}  // namespace ninebit::tools
