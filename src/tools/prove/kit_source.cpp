#include "src/tools/prove/kit_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

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

namespace {

constexpr std::string_view kPage = R"md(# A kit for an old graphics card

Nobody has measured some details of NVIDIA's register combiners. `kit.c` runs {0} small programs on a card and writes
what they show to `results.csv`. From that file ninebit tells which details the card has. The whole run takes seconds.

## What you need

- A card with register combiners: a GeForce 256, 2, 3, 4, FX, 6 or 7, or a Quadro of that time. This kit is for the
  family `{1}`.
- NVIDIA's own driver for it. Free drivers (nouveau) do not have the extension.
- A desktop with 24 or 32 bits a pixel.

## What you do

On Linux, with a C compiler and the headers of X11 and OpenGL:

```
cc -std=c99 kit.c -o kit -lGL -lX11
./kit
```

For Windows, with mingw-w64, on this computer or on another one:

```
x86_64-w64-mingw32-gcc -std=c99 kit.c -o kit.exe -lopengl32 -lgdi32
```

Old systems need a 32-bit program: `i686-w64-mingw32-gcc`. Then run `kit.exe` on the old computer.

A small window appears and goes. `results.csv` has the driver's strings in its first lines, then one row a program. If
something is missing, the program says what, and writes nothing.

## What it tells

```
ninebit verify --decide results.csv --family {1} -o card.json
```

| field | evidence | values |
|---|---|---|
{2}
With the family's own values the colours are those in the last column. Another colour is a discovery, not a fault.

| name | program | textures, primary colour | unit off | colour |
|---|---|---|---|---|
{3})md";

}  // namespace

std::string kit_page(const ChipKit& kit) {
  std::string fields, programs;
  for (const CombinerField& field : kit.fields) {
    std::vector<std::string> values;
    for (const FieldValue& value : field.values) values.push_back(value.word);
    fields += fmt::format("| `{}` | {} | {} |\n", field.name, name_of(field.evidence), fmt::join(values, ", "));
  }
  for (std::size_t i = 0; i < kit.programs.size(); ++i) {
    const Discriminator& program = kit.programs[i];
    std::string text = program.rc10.substr(program.rc10.find('\n') + 1), off = "–";
    for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n')) text[at] = ' ';
    for (std::size_t unit = 0; unit < 4; ++unit) {
      if (program.texture_off[unit]) off = std::to_string(unit);
    }
    programs += fmt::format("| {} | `{}` | {} | {} | {} |\n", kit_name(i), text.substr(0, text.size() - 1),
                            fmt::join(program.bytes, ", "), off, kit.shown.front()[i]);
  }
  return fmt::format(kPage, kit.programs.size(), kit.family.name, fields, programs);
}

}  // namespace ninebit::tools
