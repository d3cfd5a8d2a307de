// States: create, parse, print, validate.
#include <array>
#include <optional>
#include <span>

#include "ninebit/language/program_text.h"
#include "ninebit/language/register_words.h"
#include "src/capi/handles.h"
#include "src/language/xbox/stage_words.h"

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

bool is_form(int form) {
  return form >= NINEBIT_FORM_GL_CALLS && form <= NINEBIT_FORM_JSON;
}

ChipClass chip_of(int form) {
  return form == NINEBIT_FORM_NV10_WORDS || form == NINEBIT_FORM_NV10_WORDS_JSON ? ChipClass::nv10 : ChipClass::nv20;
}

ProgramForm form_of(int form) {
  switch (form) {
    case NINEBIT_FORM_GL_CALLS:
      return ProgramForm::gl;
    case NINEBIT_FORM_RC10:
      return ProgramForm::rc10;
    case NINEBIT_FORM_NV10_WORDS:
    case NINEBIT_FORM_NV20_WORDS:
      return ProgramForm::words;
    case NINEBIT_FORM_JSON:
      return ProgramForm::json;
    default:
      return ProgramForm::words_json;
  }
}

// Both halves of a state.
TextProgram program_of(const ninebit_state& state) {
  return {state.context.state(), {}, state.context.texture_shader()};
}

ninebit_result take(const HardwareProfile& profile, const Parsed<TextProgram>& parsed, ninebit_state** state,
                    char** error) {
  if (!parsed) return invalid_input(parsed.error().text(), error);
  *state = new ninebit_state{gl::Context(profile)};
  (*state)->context.state() = parsed->state;
  (*state)->context.texture_shader() = parsed->texture_shader;
  return NINEBIT_OK;
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
    const auto parsed = ninebit::parse_program({source, {}}, form_of(form), *found, {.chip = chip_of(form)});
    return take(*found, parsed, state, error);
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
    const auto decoded = ninebit::decode_register_words(named, "words", kind, *found);
    if (!decoded) return invalid_input(decoded.error().text(), error);
    return take(*found, ninebit::TextProgram{*decoded}, state, error);
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
    const ninebit::Form& row = ninebit::form_row(form_of(form));
    const bool has_words = row.has_words || row.name == "xbox";
    if (const std::string lost = has_words ? ninebit::xbox::not_in_stage_words(state->context.texture_shader()) : "";
        !lost.empty()) {
      return invalid_input("the form has no place for " + lost, error);
    }
    const auto printed = row.print(program_of(*state), chip_of(form), state->context.profile());
    if (!printed) return invalid_input(printed.error().text(), error);
    return give(*printed, text, error);
  });
}

ninebit_result ninebit_validate(const ninebit_state* state, ninebit_report** report, char** error) {
  return guarded(error, [&] {
    if (report == nullptr) return wrong_argument("report is NULL", error);
    *report = nullptr;
    if (state == nullptr) return wrong_argument("state is NULL", error);
    *report = new ninebit_report{ninebit::validate(program_of(*state), state->context.profile())};
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
