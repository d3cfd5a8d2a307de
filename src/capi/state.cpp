// States: create, parse, print, validate.
#include <array>
#include <optional>
#include <span>

#include "ninebit/language/gl_calls.h"
#include "ninebit/language/json.h"
#include "ninebit/language/rc10.h"
#include "ninebit/language/register_words.h"
#include "src/capi/handles.h"

namespace ninebit::capi {
namespace {

// The shipped profile with that name, or nullptr with `error` set.
const HardwareProfile* profile_of(const char* name, char** error) {
  const std::string_view wanted = name == nullptr ? profiles::geforce2.name : std::string_view(name);
  const HardwareProfile* const found = find_profile(wanted);
  if (found == nullptr) {
    std::string message = "unknown profile '" + std::string(wanted) + "'; expected one of";
    for (const HardwareProfile& profile : hardware_profiles()) message += ' ' + std::string(profile.name);
    (void)wrong_argument(message, error);
  }
  return found;
}

ChipClass chip_of(int form) {
  return form == NINEBIT_FORM_NV10_WORDS || form == NINEBIT_FORM_NV10_WORDS_JSON ? ChipClass::nv10 : ChipClass::nv20;
}

bool is_form(int form) {
  return form >= NINEBIT_FORM_GL_CALLS && form <= NINEBIT_FORM_JSON;
}

Parsed<CombinerState> parse(int form, const SourceText& source, const HardwareProfile& profile) {
  switch (form) {
    case NINEBIT_FORM_GL_CALLS:
      return parse_gl_calls(source, profile);
    case NINEBIT_FORM_RC10:
      return parse_rc10(source, profile);
    case NINEBIT_FORM_NV10_WORDS:
    case NINEBIT_FORM_NV20_WORDS:
      return parse_register_words(source, chip_of(form), profile);
    case NINEBIT_FORM_JSON:
      return parse_json_program(source, profile);
    default:
      return parse_json_register_words(source, chip_of(form), profile);
  }
}

Result<std::string> print(int form, const CombinerState& state, const HardwareProfile& profile) {
  switch (form) {
    case NINEBIT_FORM_GL_CALLS:
      return print_gl_calls(state, profile);
    case NINEBIT_FORM_RC10:
      return print_rc10(state, profile);
    case NINEBIT_FORM_NV10_WORDS:
    case NINEBIT_FORM_NV20_WORDS:
      return print_register_words(state, chip_of(form), profile);
    case NINEBIT_FORM_JSON:
      return print_json_program(state);
    default:
      return print_json_register_words(state, chip_of(form), profile);
  }
}

ninebit_result take(const HardwareProfile& profile, const Parsed<CombinerState>& parsed, ninebit_state** state,
                    char** error) {
  if (parsed) {
    *state = new ninebit_state{gl::Context(profile)};
    (*state)->context.state() = *parsed;
    return NINEBIT_OK;
  }
  return invalid_input(parsed.error().text(), error);
}

}  // namespace
}  // namespace ninebit::capi

using namespace ninebit::capi;

const char* ninebit_version(void) {
  return NINEBIT_VERSION;
}

const char* ninebit_profile_name(size_t index) {
  const auto all = ninebit::hardware_profiles();
  return index < all.size() ? all[index].name.data() : nullptr;  // names are literals, which end with a zero
}

void ninebit_free_text(char* text) {
  delete[] text;
}

ninebit_result ninebit_state_create(const char* profile, ninebit_state** state, char** error) {
  return guarded(error, [&] {
    if (state == nullptr) return wrong_argument("state is NULL", error);
    *state = nullptr;
    const auto* const found = profile_of(profile, error);
    if (found == nullptr) return NINEBIT_WRONG_ARGUMENT;
    *state = new ninebit_state{ninebit::gl::Context(*found)};
    return NINEBIT_OK;
  });
}

ninebit_result ninebit_state_parse(const char* profile, int form, const char* text, size_t length,
                                   ninebit_state** state, char** error) {
  return guarded(error, [&] {
    if (state == nullptr) return wrong_argument("state is NULL", error);
    *state = nullptr;
    if (text == nullptr && length > 0) return wrong_argument("text is NULL", error);
    if (!is_form(form)) return wrong_argument("form is not a value of ninebit_form", error);
    const auto* const found = profile_of(profile, error);
    if (found == nullptr) return NINEBIT_WRONG_ARGUMENT;
    const std::string_view source = text == nullptr ? std::string_view() : std::string_view(text, length);
    return take(*found, parse(form, {source, {}}, *found), state, error);
  });
}

ninebit_result ninebit_state_from_words(const char* profile, int chip, const ninebit_word* words, size_t count,
                                        ninebit_state** state, char** error) {
  return guarded(error, [&] {
    if (state == nullptr) return wrong_argument("state is NULL", error);
    *state = nullptr;
    if (words == nullptr && count > 0) return wrong_argument("words is NULL", error);
    if (chip != NINEBIT_CHIP_NV10 && chip != NINEBIT_CHIP_NV20)
      return wrong_argument("chip is not a value of ninebit_chip", error);
    const auto* const found = profile_of(profile, error);
    if (found == nullptr) return NINEBIT_WRONG_ARGUMENT;
    std::vector<ninebit::RegisterWord> named;
    for (size_t i = 0; i < count; ++i) {
      if (words[i].name == nullptr) return wrong_argument("the name of a word is NULL", error);
      // The place of a word is its number: the first word is in line 1.
      named.push_back({words[i].name, words[i].value, {static_cast<int>(i) + 1, 1}});
    }
    const auto kind = chip == NINEBIT_CHIP_NV10 ? ninebit::ChipClass::nv10 : ninebit::ChipClass::nv20;
    return take(*found, ninebit::decode_register_words(named, "words", kind, *found), state, error);
  });
}

ninebit_result ninebit_state_copy(const ninebit_state* from, ninebit_state** state, char** error) {
  return guarded(error, [&] {
    if (state == nullptr) return wrong_argument("state is NULL", error);
    *state = nullptr;
    if (from == nullptr) return wrong_argument("from is NULL", error);
    *state = new ninebit_state(*from);
    return NINEBIT_OK;
  });
}

void ninebit_state_free(ninebit_state* state) {
  delete state;
}

ninebit_result ninebit_state_print(const ninebit_state* state, int form, char** text, char** error) {
  return guarded(error, [&] {
    if (text == nullptr) return wrong_argument("text is NULL", error);
    *text = nullptr;
    if (state == nullptr) return wrong_argument("state is NULL", error);
    if (!is_form(form)) return wrong_argument("form is not a value of ninebit_form", error);
    const auto printed = print(form, state->context.state(), state->context.profile());
    if (!printed) return invalid_input(printed.error().text(), error);
    return give(*printed, text, error);
  });
}

ninebit_result ninebit_validate(const ninebit_state* state, ninebit_report** report, char** error) {
  return guarded(error, [&] {
    if (report == nullptr) return wrong_argument("report is NULL", error);
    *report = nullptr;
    if (state == nullptr) return wrong_argument("state is NULL", error);
    *report = new ninebit_report{ninebit::validate(state->context.state(), state->context.profile())};
    return NINEBIT_OK;
  });
}

size_t ninebit_report_count(const ninebit_report* report) {
  return report == nullptr ? 0 : report->found.size();
}

ninebit_result ninebit_report_get(const ninebit_report* report, size_t index, ninebit_diagnostic* diagnostic) {
  if (report == nullptr || index >= report->found.size()) return NINEBIT_WRONG_ARGUMENT;
  if (diagnostic == nullptr || diagnostic->struct_size < kDiagnosticSize) return NINEBIT_WRONG_ARGUMENT;
  const ninebit::StateDiagnostic& found = report->found[index];
  diagnostic->stage = found.stage.value_or(-1);
  diagnostic->portion = found.portion ? static_cast<int>(*found.portion) : -1;
  diagnostic->variable = found.variable ? static_cast<int>(*found.variable) : -1;
  diagnostic->gl_error = static_cast<uint32_t>(found.gl_error);
  diagnostic->message = found.message.c_str();
  return NINEBIT_OK;
}

void ninebit_report_free(ninebit_report* report) {
  delete report;
}
