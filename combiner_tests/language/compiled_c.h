// Emitted C, compiled by the machine's C compiler and called.
#pragma once

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "combiner_tests/language/emit_cases.h"
#include "combiner_tests/support/temp_folder.h"
#include "ninebit/combiner/evaluate.h"

namespace ninebit::test {

using EmittedArgument = const std::int32_t*;
using EmittedFunction = void (*)(EmittedArgument, EmittedArgument, EmittedArgument, EmittedArgument, EmittedArgument,
                                 EmittedArgument, EmittedArgument, std::int32_t, std::int32_t*);

// A shared library made of one C source. Undefined behaviour in it ends the process.
class CompiledC {
 public:
  enum class Runs { often, seldom };  // compiled to run fast, or soon
  // `language`: what the compiler is told of it.
  explicit CompiledC(const std::string& source, Runs runs = Runs::often, const std::string& language = "-std=c99") {
    const std::string file = folder_ / "emitted.c", library = folder_ / "emitted.so";
    std::ofstream(file) << source;
    const std::string command =
        std::string("'") + NINEBIT_C_COMPILER + "' " + language + (runs == Runs::often ? " -O1" : " -O0") +
        " -shared -fPIC -pedantic -Wall -Wextra -Wconversion " +
        "-Werror -fsanitize=undefined -fsanitize-undefined-trap-on-error -o '" + library + "' '" + file + "' 2>&1";
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

  [[nodiscard]] EmittedFunction find(const std::string& name) const { return find_as<EmittedFunction>(name); }
  template <class Function>
  [[nodiscard]] Function find_as(const std::string& name) const {
    return handle_ == nullptr ? nullptr : reinterpret_cast<Function>(dlsym(handle_, name.c_str()));
  }

 private:
  TempFolder folder_;
  std::string messages_;
  void* handle_ = nullptr;
};

inline Rgba9 call(EmittedFunction function, const RegisterFile& registers) {
  std::array<std::array<std::int32_t, 4>, kRegisterCount> wide{};
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    for (std::size_t c = 0; c < 4; ++c) wide[r][c] = registers.value[r][c];
  }
  const auto argument = [&](Register r) -> EmittedArgument { return wide[static_cast<std::size_t>(r)].data(); };
  std::array<std::int32_t, 4> result{-9999, -9999, -9999, -9999};
  function(argument(Register::primary), argument(Register::secondary), argument(Register::fog),
           argument(Register::texture0), argument(Register::texture1), argument(Register::texture2),
           argument(Register::texture3), registers[Register::spare0][kAlpha], result.data());
  return {static_cast<s9>(result[0]), static_cast<s9>(result[1]), static_cast<s9>(result[2]),
          static_cast<s9>(result[3])};
}

// The functions "program0" and so on against the reference. `text_of`: what a failure shows.
template <class TextOf>
void compare(const CompiledC& compiled, const std::vector<EmitCase>& cases, std::uint64_t seed, std::size_t fragments,
             const TextOf& text_of, Outputs& outputs) {
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const EmittedFunction function = compiled.find("program" + std::to_string(i));
    ASSERT_NE(function, nullptr);
    for (const RegisterFile& input : emit_inputs(cases[i].profile, seed + i, fragments)) {
      const Rgba9 expected = evaluate(cases[i].program, input), actual = call(function, input);
      ASSERT_EQ(expected, actual) << mismatch(cases[i], input, expected, actual) << text_of(cases[i].program);
      outputs.add(expected);
    }
  }
}

}  // namespace ninebit::test
