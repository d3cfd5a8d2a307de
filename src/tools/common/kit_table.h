// The table that a kit's program writes on an old card: comments, a header, a row for each program of the kit.
#pragma once

#include <string>
#include <vector>

#include "ninebit/numerics/result.h"
#include "ninebit/study/chip_kit.h"
#include "src/tools/input/input_file.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

// Adds --family: whose kit it is.
void add_family_flag(CLI::App& verb, std::string& family);
// The profile of a family that the flag allows.
[[nodiscard]] const HardwareProfile& profile_of_family(const std::string& family);

// "k3", by which rows and messages name program number 2 of a kit.
[[nodiscard]] std::string kit_name(std::size_t program);

// "name,program,tex0,…,out.r,out.g,out.b".
[[nodiscard]] std::string kit_header();

// A row as far as the kit decides it: all but the colour, with a comma at the end.
[[nodiscard]] std::string kit_row(const ChipKit& kit, std::size_t program);

// The colours that a card showed.
struct KitResults {
  std::vector<std::string> comments;  // without '#': the driver's strings
  std::vector<int> shown;             // a byte for each program of the kit
};

// Reads a table with all rows of the kit, in any order. Reports any other header, rows of other programs, a row that
// stands twice or lacks, colours that are no bytes or not grey.
[[nodiscard]] Result<KitResults> read_kit_results(InputFile file, const ChipKit& kit);

}  // namespace ninebit::tools
