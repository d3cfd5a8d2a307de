// Shared by the tests of the C interface: handles that free themselves, and ways between C and C++.
#pragma once

#include <algorithm>
#include <memory>
#include <string>

#include "combiner_tests/combiner/random_state.h"
#include "ninebit/capi/combiner.h"
#include "ninebit/combiner/program.h"
#include "ninebit/language/json.h"

namespace ninebit::test {

struct FreeHandle {
  void operator()(ninebit_state* state) const { ninebit_state_free(state); }
  void operator()(ninebit_program* program) const { ninebit_program_free(program); }
};
using StateHandle = std::unique_ptr<ninebit_state, FreeHandle>;
using ProgramHandle = std::unique_ptr<ninebit_program, FreeHandle>;

// The string of a text, which is freed.
inline std::string take(char* text) {
  std::string copy = text == nullptr ? "" : text;
  ninebit_free_text(text);
  return copy;
}

inline StateHandle parsed(const HardwareProfile& profile, int form, const std::string& text) {
  ninebit_state* state = nullptr;
  (void)ninebit_state_parse(std::string(profile.name).c_str(), form, text.data(), text.size(), &state, nullptr);
  return StateHandle(state);
}

inline ProgramHandle compiled(const HardwareProfile& profile, const CombinerState& state) {
  const StateHandle handle = parsed(profile, NINEBIT_FORM_JSON, print_json_program(state));
  ninebit_program* program = nullptr;
  (void)ninebit_compile(handle.get(), &program, nullptr);
  return ProgramHandle(program);
}

// The state behind a handle, by way of its text.
inline CombinerState json_of(const ninebit_state* state) {
  char* text = nullptr;
  (void)ninebit_state_print(state, NINEBIT_FORM_JSON, &text, nullptr);
  return parse_json_program({take(text), {}}, profiles::nv2a).value();
}

inline ninebit_registers registers_of(const RegisterFile& file) {
  ninebit_registers registers{};
  registers.struct_size = sizeof registers;
  for (std::size_t r = 0; r < kRegisterCount; ++r)
    std::copy(file.value[r].begin(), file.value[r].end(), registers.code[r]);
  return registers;
}

}  // namespace ninebit::test
