// The structures behind the handles of the C interface, and the conversion of C++ results to C results.
#pragma once

#include <cstring>
#include <exception>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/capi/combiner.h"
#include "ninebit/combiner/batch_program.h"
#include "ninebit/combiner/program.h"
#include "ninebit/combiner/validate.h"
#include "ninebit/language/gl_nv.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/texture_shader/stage_program.h"

struct ninebit_state {
  ninebit::gl::Context context;
};

struct ninebit_program {
  const ninebit::HardwareProfile* profile;  // a shipped profile, which lives as long as the process
  ninebit::Program program;
  ninebit::BatchProgram batch;
  std::optional<ninebit::TextureShaderProgram> stages{};  // before the combiners; empty: not enabled
};

struct ninebit_report {
  std::vector<ninebit::StateDiagnostic> found;
};

namespace ninebit::capi {

// A text that the caller frees, or nullptr when memory runs out.
[[nodiscard]] inline char* copy_text(std::string_view text) noexcept {
  char* const copy = new (std::nothrow) char[text.size() + 1];
  if (copy == nullptr) return nullptr;
  std::memcpy(copy, text.data(), text.size());
  copy[text.size()] = '\0';
  return copy;
}

// Sets the error text of a failing function and returns `result`.
inline ninebit_result fail(ninebit_result result, std::string_view message, char** error) noexcept {
  if (error != nullptr) *error = copy_text(message);
  return result;
}
inline ninebit_result wrong_argument(std::string_view message, char** error) noexcept {
  return fail(NINEBIT_WRONG_ARGUMENT, message, error);
}
inline ninebit_result invalid_input(std::string_view message, char** error) noexcept {
  return fail(NINEBIT_INVALID_INPUT, message, error);
}

// Returns a copy of the text through `out`.
inline ninebit_result give(std::string_view text, char** out, char** error) noexcept {
  *out = copy_text(text);
  return *out != nullptr ? NINEBIT_OK : fail(NINEBIT_OUT_OF_MEMORY, "out of memory", error);
}

// Runs a function's body and converts exceptions to results. `error` is NULL if the body succeeds.
template <class Body>
ninebit_result guarded(char** error, const Body& body) noexcept {
  if (error != nullptr) *error = nullptr;
  try {
    return body();
  } catch (const std::bad_alloc&) {
    return fail(NINEBIT_OUT_OF_MEMORY, "out of memory", error);
  } catch (const std::exception& fault) {
    return fail(NINEBIT_INTERNAL_ERROR, fault.what(), error);
  } catch (...) {
    return fail(NINEBIT_INTERNAL_ERROR, "unknown fault", error);
  }
}

// The sizes of the structures in their first version.
inline constexpr std::size_t kRegistersSize = sizeof(ninebit_registers);
inline constexpr std::size_t kInputsSize = sizeof(ninebit_inputs);
inline constexpr std::size_t kPlanesSize = sizeof(ninebit_planes);
inline constexpr std::size_t kDiagnosticSize = sizeof(ninebit_diagnostic);
inline constexpr std::size_t kFateSize = sizeof(ninebit_fate);

// Reads a fragment's registers; NINEBIT_WRONG_ARGUMENT for NULL, a structure that is too short and a code out of range.
[[nodiscard]] ninebit_result read_registers(const ninebit_program& program, const ninebit_registers* from,
                                            RegisterFile& to, char** error);

}  // namespace ninebit::capi
