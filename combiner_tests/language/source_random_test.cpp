// Random programs are read as the machine's C compiler runs them, or refused.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "combiner_tests/language/source_programs.h"
#include "combiner_tests/support/slow_build.h"
#include "combiner_tests/support/temp_folder.h"
#include "ninebit/language/source_code.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit {
namespace {

constexpr std::uint64_t kSeed = 31;
constexpr int kPrograms = test::cases_here(200), kColours = 18;

// The colours of a state in the order of the stub's slots.
std::array<ColorF, kColours> colours_of(const CombinerState& state) {
  std::array<ColorF, kColours> out{state.constant0, state.constant1};
  for (std::size_t i = 0; i < 8; ++i) {
    out[2 + 2 * i] = state.general[i].constant0;
    out[3 + 2 * i] = state.general[i].constant1;
  }
  return out;
}

// As OpenGL takes it.
float clamped(float value) {
  return std::isnan(value) || value < 0 ? 0.0F : std::min(value, 1.0F);
}

TEST(SourceRandom, ProgramsAreReadAsACompilerRunsThem) {
  const test::TempFolder folder;
  const char* const more = std::getenv("NINEBIT_SOURCE_PROGRAMS");
  const int first = more != nullptr ? std::atoi(more) : 0;
  std::vector<std::string> programs;
  std::string all = test::programs_prologue();
  for (int i = first; i < first + kPrograms; ++i) {
    test::Random random(kSeed, static_cast<std::uint64_t>(i));
    programs.push_back(test::random_program(random, i));
    all += programs.back();
  }
  const std::string file = folder / "programs.c", library = folder / "programs.so";
  std::ofstream(file) << all;
  const std::string command = std::string("'") + NINEBIT_C_COMPILER + "' -std=gnu99 -O0 -fwrapv -w -shared -fPIC -o '" +
                              library + "' '" + file + "'";
  ASSERT_EQ(std::system(command.c_str()), 0) << all;
  void* const handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  ASSERT_NE(handle, nullptr) << dlerror();
  auto* const slots = static_cast<float(*)[4]>(dlsym(handle, "slots"));
  auto* const seed = static_cast<unsigned*>(dlsym(handle, "program_seed"));
  int read = 0;
  for (int i = 0; i < kPrograms; ++i) {
    const std::string& text = programs[static_cast<std::size_t>(i)];
    const std::string entry = "run_" + std::to_string(first + i);
    const auto found = parse_source_code({text, "program.c"}, {.functions = {entry}}, profiles::nv2a);
    if (!found) {
      EXPECT_FALSE(found.faults()[0].message.empty());
      continue;
    }
    ++read;
    const auto colours = colours_of(*found);
    auto* const run = reinterpret_cast<void (*)()>(dlsym(handle, entry.c_str()));
    // The values that were read hold for the first run; a static variable has others in a second one.
    const bool again = text.find("static", text.find(" h" + std::to_string(first + i))) == std::string::npos;
    for (unsigned s = 1; s <= (again ? 4U : 1U); ++s) {
      *seed = s * 7919U;
      for (int slot = 0; slot < kColours; ++slot) std::fill(slots[slot], slots[slot] + 4, 0.0F);
      run();
      for (std::size_t slot = 0; slot < kColours; ++slot) {
        for (std::size_t c = 0; c < 4; ++c) {
          ASSERT_EQ(colours[slot][c], clamped(slots[slot][c]))
              << "NINEBIT_SOURCE_PROGRAMS=" << first + i << ", colour " << slot << ", channel " << c << "\n"
              << text;
        }
      }
    }
  }
  dlclose(handle);
  RecordProperty("read", read);
  EXPECT_GT(read, kPrograms / 4) << "of " << kPrograms;
}

}  // namespace
}  // namespace ninebit
