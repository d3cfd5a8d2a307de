#include "src/playground/vocabulary.h"

#include <string>
#include <utility>

#include "src/playground/profile_fields.h"
#include "src/playground/texts.h"

namespace ninebit::playground {
namespace {

void add_helped(Json& words, std::string_view kind, std::span<const HelpedWord> helped) {
  for (const HelpedWord& one : helped) words.push_back({{"word", one.word}, {"kind", kind}, {"help", one.help}});
}

}  // namespace

Reply vocabulary(Request& request) {
  request.allow({});
  if (request.failed()) return request.refused();
  Json words = Json::array();
  add_helped(words, "gl-constant", gl_constant_help());
  add_helped(words, "gl-function", gl_function_help());
  add_helped(words, "rc10", rc10_help());
  add_helped(words, "ps", pixel_shader_help());
  add_helped(words, "json", json_help());
  for (const HardwareProfile& profile : hardware_profiles()) {
    words.push_back(
        {{"word", profile.name}, {"kind", "profile"}, {"help", "Profile: " + std::string(profile.chip) + "."}});
  }
  for (const ProfileField& field : profile_fields()) {
    words.push_back({{"word", field.name}, {"kind", "profile"}, {"help", field.help}});
  }
  return Json{{"words", std::move(words)}};
}

}  // namespace ninebit::playground
