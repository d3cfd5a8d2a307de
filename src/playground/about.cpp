// Lists the choices: profiles, textures, effects.
#include <array>
#include <utility>

#include "src/effect/effect_words.h"
#include "src/playground/texts.h"
#include "src/playground/vocabulary.h"

namespace ninebit::playground {
namespace {

constexpr std::array<std::string_view, 4> kGeneratedTextures{"normalize-cube:64", "checker:256", "gradient", "falloff"};
constexpr std::array<std::string_view, 4> kGeneratedMeshes{"sphere:48", "torus:48", "plane:16", "cube"};

// The forms that are read, or written.
Json titles_of(bool read) {
  Json rows = Json::array();
  for (const Form& form : forms()) {
    if (read ? form.parse != nullptr : form.print != nullptr)
      rows.push_back({{"name", form.name}, {"title", form.title}});
  }
  return rows;
}

// The words before the file of a texture that is made from it.
Json file_origins() {
  Json words = Json::array();
  for (const auto& [word, origin] : effect_detail::kFileOrigins) words.push_back(word);
  return words;
}

}  // namespace

Reply about(Request& request) {
  request.allow({});
  if (request.failed()) return request.refused();
  Json shipped = Json::array();
  for (const HardwareProfile& profile : hardware_profiles()) shipped.push_back(profile_object(profile));
  Json out{{"version", NINEBIT_VERSION}, {"forms", titles_of(true)}, {"converts_to", titles_of(false)}};
  out["profiles"] = std::move(shipped);
  out["textures"] = kGeneratedTextures;
  out["meshes"] = kGeneratedMeshes;
  out["file_origins"] = file_origins();
  return out;
}

}  // namespace ninebit::playground
