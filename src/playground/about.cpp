// Lists the choices: profiles, textures, effects.
#include <array>
#include <utility>

#include "src/language/json/printed_form.h"
#include "src/playground/texts.h"
#include "src/playground/vocabulary.h"

namespace ninebit::playground {
namespace {

// Forms in and out: --from or --to takes the name.
struct FormTitle {
  std::string_view name, title;
};
constexpr std::array kReadTitles{FormTitle{"gl", "GL calls"},
                                 FormTitle{"source", "A source file with GL calls"},
                                 FormTitle{"rc10", "!!RC1.0 (nvparse)"},
                                 FormTitle{"ps", "Pixel shader ps.1.x"},
                                 FormTitle{"words", "Register words"},
                                 FormTitle{"words-json", "Register words as JSON"},
                                 FormTitle{"json", "Program as JSON"},
                                 FormTitle{"xbox", "Xbox pixel shader definition"},
                                 FormTitle{"log", "Log of register writes"}};
constexpr std::array kPrintedTitles{FormTitle{"gl", "GL calls"},
                                    FormTitle{"rc10", "!!RC1.0 (nvparse)"},
                                    FormTitle{"ps11", "Pixel shader ps.1.1"},
                                    FormTitle{"words", "Register words"},
                                    FormTitle{"words-json", "Register words as JSON"},
                                    FormTitle{"json", "Program as JSON"},
                                    FormTitle{"xbox", "Xbox pixel shader definition"},
                                    FormTitle{"glsl", "GLSL 3.30"},
                                    FormTitle{"glsl-es", "GLSL ES 3.00"},
                                    FormTitle{"c", "C"}};
static_assert(kPrintedTitles.size() == kPrintedForms.size());

constexpr std::array<std::string_view, 4> kGeneratedTextures{"normalize-cube:64", "checker:256", "gradient", "falloff"};
constexpr std::array<std::string_view, 4> kGeneratedMeshes{"sphere:48", "torus:48", "plane:16", "cube"};

template <std::size_t N>
Json titles_of(const std::array<FormTitle, N>& titles) {
  Json rows = Json::array();
  for (const FormTitle& form : titles) rows.push_back({{"name", form.name}, {"title", form.title}});
  return rows;
}

}  // namespace

Reply about(Request& request) {
  request.allow({});
  if (request.failed()) return request.refused();
  Json shipped = Json::array();
  for (const HardwareProfile& profile : hardware_profiles()) shipped.push_back(profile_object(profile));
  Json out{{"version", NINEBIT_VERSION}, {"forms", titles_of(kReadTitles)}, {"converts_to", titles_of(kPrintedTitles)}};
  out["profiles"] = std::move(shipped);
  out["textures"] = kGeneratedTextures;
  out["meshes"] = kGeneratedMeshes;
  return out;
}

}  // namespace ninebit::playground
