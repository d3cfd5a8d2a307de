// Programs emitted as C, compiled by the machine's C compiler, against the reference.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "combiner_tests/language/emit_cases.h"
#include "ninebit/language/c_source.h"

namespace ninebit::test {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kCSeed = 0x632D736F75726365U;
constexpr int kCCases = 600;
constexpr std::size_t kCFragments = 64;

using Argument = const std::int32_t*;
using Function = void (*)(Argument, Argument, Argument, Argument, Argument, Argument, Argument, std::int32_t,
                          std::int32_t*);

// A folder that goes when the test ends.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "ninebit_emit_XXXXXX").string();
    if (mkdtemp(name.data()) != nullptr) path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// A shared library made of one C source. Undefined behaviour in it ends the process.
class CompiledC {
 public:
  explicit CompiledC(const std::string& source) {
    const fs::path file = folder_.path() / "emitted.c", library = folder_.path() / "emitted.so";
    std::ofstream(file) << source;
    const std::string command = std::string("'") + NINEBIT_C_COMPILER +
                                "' -std=c99 -O1 -shared -fPIC -pedantic -Wall -Wextra -Wconversion " +
                                "-Werror -fsanitize=undefined -fsanitize-undefined-trap-on-error -o '" +
                                library.string() + "' '" + file.string() + "' 2>&1";
    FILE* const out = popen(command.c_str(), "r");
    if (out == nullptr) return;
    std::array<char, 4096> text{};
    while (fgets(text.data(), text.size(), out) != nullptr) messages_ += text.data();
    if (pclose(out) == 0) handle_ = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle_ == nullptr) ADD_FAILURE() << command << '\n' << messages_.substr(0, 4000);
  }
  ~CompiledC() {
    if (handle_ != nullptr) dlclose(handle_);
  }
  CompiledC(const CompiledC&) = delete;
  CompiledC& operator=(const CompiledC&) = delete;

  [[nodiscard]] Function find(const std::string& name) const {
    return handle_ == nullptr ? nullptr : reinterpret_cast<Function>(dlsym(handle_, name.c_str()));
  }

 private:
  TemporaryFolder folder_;
  std::string messages_;
  void* handle_ = nullptr;
};

Rgba9 call(Function function, const RegisterFile& registers) {
  std::array<std::array<std::int32_t, 4>, kRegisterCount> wide{};
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    for (std::size_t c = 0; c < 4; ++c) wide[r][c] = registers.value[r][c];
  }
  const auto argument = [&](Register r) -> Argument { return wide[static_cast<std::size_t>(r)].data(); };
  std::array<std::int32_t, 4> result{-9999, -9999, -9999, -9999};
  function(argument(Register::primary), argument(Register::secondary), argument(Register::fog),
           argument(Register::texture0), argument(Register::texture1), argument(Register::texture2),
           argument(Register::texture3), registers[Register::spare0][kAlpha], result.data());
  return {static_cast<s9>(result[0]), static_cast<s9>(result[1]), static_cast<s9>(result[2]),
          static_cast<s9>(result[3])};
}

void compare(const std::vector<EmitCase>& cases, std::size_t fragments, Outputs& outputs) {
  std::string source;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Result<std::string> text = emit_c(cases[i].program, "program" + std::to_string(i));
    ASSERT_TRUE(text.ok()) << cases[i].name << ": " << text.error().text();
    source += *text;
  }
  const CompiledC compiled(source);
  ASSERT_FALSE(::testing::Test::HasFailure());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Function function = compiled.find("program" + std::to_string(i));
    ASSERT_NE(function, nullptr);
    for (const RegisterFile& input : emit_inputs(cases[i].profile, kCSeed + i, fragments)) {
      const Rgba9 expected = evaluate(cases[i].program, input), actual = call(function, input);
      ASSERT_EQ(expected, actual) << mismatch(cases[i], input, expected, actual) << emit_c(cases[i].program).value();
      outputs.add(expected);
    }
  }
}

TEST(EmitC, RandomProgramsGiveTheBitsOfTheReference) {
  Outputs outputs;
  compare(random_cases(kCSeed, kCCases), kCFragments, outputs);
  if (!HasFailure()) outputs.expect_meaning(kCCases * kCFragments);
}

TEST(EmitC, KnownProgramsAndEveryMappingScaleAndBiasGiveTheBitsOfTheReference) {
  Outputs outputs;
  compare(known_cases(), 512, outputs);
  compare(row_cases(), 256, outputs);
  outputs.expect_distinct(10000);
}

}  // namespace
}  // namespace ninebit::test
