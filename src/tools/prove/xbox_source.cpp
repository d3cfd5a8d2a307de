#include "src/tools/prove/xbox_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <vector>

#include "ninebit/combiner/initial_registers.h"
#include "ninebit/language/register_words.h"
#include "src/language/register_log/log_methods.h"
#include "src/tools/common/kit_table.h"

namespace ninebit::tools {
namespace {

// The first groups, each of which tests one thing, end before this one.
constexpr std::string_view kFirstCombination = "two-things";

// The pack's programs that the kit has, by index.
std::vector<std::size_t> programs_of(const VectorPack& pack) {
  std::vector<std::size_t> chosen;
  std::vector<int> counts(pack.groups.size());
  for (std::size_t i = 0; i < pack.programs.size(); ++i) {
    const std::size_t group = pack.programs[i].group;
    if (pack.groups[group].name == kFirstCombination) break;
    if (++counts[group] <= kXboxProgramsOfGroup) chosen.push_back(i);
  }
  return chosen;
}

// The tables of the C file.
class Tables {
 public:
  // Adds a program; what follows its row and its number.
  void add(const std::string& row, std::size_t number, const std::vector<std::uint32_t>& words, std::size_t first_input,
           std::size_t fragments, int unit_off) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (words[i] == 0) continue;
      settings_ += fmt::format("    {{{}, 0x{:08X}}},\n", i, words[i]);
      ++count;
    }
    programs_ += fmt::format("    {{{}, {}, {}, {}, {}, {}, {}}},\n", row.empty() ? "NULL" : '"' + row + '"', number,
                             settings_used_, count, first_input, fragments, unit_off);
    settings_used_ += count;
    ++program_count_;
  }

  // Adds the registers of a fragment; its number.
  std::size_t add_input(const RegisterFile& registers) {
    std::vector<int> codes;
    for (const Register r : kVectorRegisters) {
      for (const s9 code : registers[r]) codes.push_back(code);
    }
    inputs_ += fmt::format("    {{{}}},\n", fmt::join(codes, ", "));
    return inputs_used_++;
  }

  [[nodiscard]] std::string text(const std::vector<std::uint32_t>& methods, const std::string& id) const {
    return fmt::format(
        "/* The methods that set the registers of a program, in the order of a pack's lines `word`. */\n"
        "static const uint16_t methods[] = {{0x{:04X}}};\n"
        "#define WORDS ((int)(sizeof methods / sizeof methods[0]))\n\n"
        "static const Setting settings[] = {{\n{}}};\n\n"
        "/* Codes before the first general combiner: red, green, blue, alpha of each register. */\n"
        "static const int16_t inputs[][CODES] = {{\n{}}};\n\n"
        "static const Program programs[] = {{\n{}}};\n"
        "#define PROGRAMS {}\n#define HEADER \"{}\"\n#define PACK \"{}\"\n",
        fmt::join(methods, ", 0x"), settings_, inputs_, programs_, program_count_, kit_header(), id);
  }

 private:
  std::string settings_, inputs_, programs_;
  std::size_t settings_used_ = 0, inputs_used_ = 0;
  int program_count_ = 0;
};

Diagnostic no_method(const std::string& name) {
  return {.message = "no method sets " + name};
}

Result<std::vector<std::uint32_t>> methods_of(const VectorPack& pack) {
  std::vector<std::uint32_t> methods;
  for (const std::string& name : pack.word_names) {
    const auto method = reglog::number_of(name, pack.chip);
    if (!method) return no_method(name);
    methods.push_back(*method);
  }
  return methods;
}

// The registers of a kit's row: textures and primary colour have one byte each; the secondary colour is 0.
RegisterFile registers_of(const Discriminator& program, const HardwareProfile& profile) {
  FragmentInputs in;
  in.primary.fill(static_cast<std::uint8_t>(program.bytes[2]));
  for (std::size_t unit = 0; unit < 2; ++unit) {
    if (program.texture_off[unit]) continue;
    in.texture[unit].emplace().value.fill(static_cast<std::uint8_t>(program.bytes[unit]));
  }
  RegisterFile registers = initial_registers(profile, in);
  // The texel of a unit that is off has no alpha, where the chip gives 1: so the colour shows whether it is off.
  for (std::size_t unit = 0; unit < 2; ++unit) {
    if (program.texture_off[unit]) registers[texture_register(static_cast<int>(unit))] = {};
  }
  return registers;
}

Status add_kit(const ChipKit& kit, const VectorPack& pack, Tables& tables) {
  for (std::size_t i = 0; i < kit.programs.size(); ++i) {
    const Discriminator& program = kit.programs[i];
    const auto encoded = encode_register_words(program.state, pack.chip, kit.family);
    if (!encoded) return encoded.error();
    std::vector<std::uint32_t> words(pack.word_names.size());
    for (const RegisterWord& word : *encoded) {
      const auto at = std::find(pack.word_names.begin(), pack.word_names.end(), word.name);
      if (at == pack.word_names.end()) return no_method(word.name);
      words[static_cast<std::size_t>(at - pack.word_names.begin())] = word.value;
    }
    const auto off = std::find(program.texture_off.begin(), program.texture_off.end(), true);
    tables.add(kit_row(kit, i), 0, words, tables.add_input(registers_of(program, kit.family)), 1,
               off == program.texture_off.end() ? -1 : static_cast<int>(off - program.texture_off.begin()));
  }
  return {};
}

void add_pack(const VectorPack& pack, Tables& tables) {
  std::map<std::size_t, std::size_t> first;  // by the pack's number of a row of inputs
  for (const std::size_t i : programs_of(pack)) {
    const VectorProgram& program = pack.programs[i];
    if (!first.contains(program.first_input)) {
      const std::size_t number = tables.add_input(pack.inputs[program.first_input]);
      for (std::size_t k = 1; k < pack.fragments; ++k) (void)tables.add_input(pack.inputs[program.first_input + k]);
      first[program.first_input] = number;
    }
    tables.add({}, i + 1, program.words, first[program.first_input], pack.fragments, -1);
  }
}

constexpr std::string_view kPage = R"md(# A kit for an Xbox

Nobody has measured some details of the Xbox's register combiners. `kit.c` runs {0} small programs on a real Xbox, {1} that
decide these details and {2} of a pack of test vectors, and writes what they show to the hard disk. The whole run takes
seconds.

**Nobody has run this program on an Xbox yet.** It was compiled, and the commands that it sends were played by ninebit's own
combiners, which give the colours that are expected. Whether the machine needs another setting is not known. What a run shows,
also that it fails, is worth a report.

## What you need

- An Xbox that runs programs of one's own.
- [nxdk](https://github.com/XboxDev/nxdk), the free SDK. The kit uses its library of push-buffer commands, pbkit.

## What you do

Copy this folder to a computer with nxdk, and say where that is:

```
make NXDK_DIR=/path/to/nxdk
```

`bin/default.xbe` is the program, `ninebit_kit.iso` a disc with it. Start it on the Xbox. The screen flickers, and then says
what was written, or what failed. Two tables lie in partition E: `ninebit_kit.csv` and `ninebit_pack.txt`. Copy them to a
computer with ninebit.

## What it tells

```
ninebit verify --decide ninebit_kit.csv --family nv2a -o xbox.json
ninebit vectors --profile nv2a -o pack
ninebit verify ninebit_pack.txt --vectors pack
```

The first command decides these fields:

| field | evidence | values |
|---|---|---|
{3}
The last compares {2} programs, of each group that tests one thing the first {4}, with the profile `nv2a`. If some differ, it
says which rule explains that. The inputs of a program are colours and texels, also signed ones, and fog: what the combiners
get depends on the stages before them, as far as the profile describes those.
)md";

}  // namespace

Result<std::string> xbox_source(const ChipKit& kit, const VectorPack& pack) {
  Tables tables;
  if (Status added = add_kit(kit, pack, tables); !added) return added.error();
  add_pack(pack, tables);
  std::string text(kXboxKitText);
  const std::size_t begin = text.find("/* ROWS"), end = text.find('\n', begin);
  const auto methods = methods_of(pack);
  if (!methods) return methods.error();
  text.replace(begin, end - begin, tables.text(*methods, pack.id));
  return "/* Made by `ninebit prove kit --family nv2a --target xbox`; README.md beside it says how to use it. */\n" +
         text;
}

std::string xbox_makefile() {
  return "# make NXDK_DIR=/path/to/nxdk\nXBE_TITLE = ninebit_kit\nGEN_XISO = $(XBE_TITLE).iso\nSRCS = $(CURDIR)/kit.c\n"
         "include $(NXDK_DIR)/Makefile\n";
}

std::string xbox_page(const ChipKit& kit, const VectorPack& pack) {
  std::string fields;
  for (const CombinerField& field : kit.fields) {
    std::vector<std::string> values;
    for (const FieldValue& value : field.values) values.push_back(value.word);
    fields += fmt::format("| `{}` | {} | {} |\n", field.name, name_of(field.evidence), fmt::join(values, ", "));
  }
  const std::size_t of_pack = programs_of(pack).size();
  return fmt::format(kPage, kit.programs.size() + of_pack, kit.programs.size(), of_pack, fields, kXboxProgramsOfGroup);
}

}  // namespace ninebit::tools
