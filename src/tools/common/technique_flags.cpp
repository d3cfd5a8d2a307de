#include "src/tools/common/technique_flags.h"

#include <fmt/format.h>

#include <array>
#include <span>
#include <string_view>

namespace ninebit::tools {
namespace {

// A bit for each technique.
enum Readers : unsigned {
  kIndexCube = 1,
  kDepthCube = 2,
  kShadowMap = 4,
  kShadowVolume = 8,
  kReflective = 16,
  kLightCookie = 32,
  kCookieIndices = 64  // light-cookie with --cookie-shadows index
};
constexpr unsigned kIndices = kIndexCube | kCookieIndices;
// The direct light of `reflective` is a shadow map's.
constexpr unsigned kShadowMaps = kShadowMap | kReflective;

struct TechniqueFlag {
  std::string_view flag;
  unsigned readers;
};
constexpr std::array kFlags{TechniqueFlag{"--map-size", kIndices | kDepthCube | kShadowMaps},

                            TechniqueFlag{"--index-format", kIndices},
                            TechniqueFlag{"--index-scope", kIndices},
                            TechniqueFlag{"--index-step", kIndices},
                            TechniqueFlag{"--section-size", kIndices},
                            TechniqueFlag{"--index-order", kIndices},
                            TechniqueFlag{"--patch-angle", kIndices},
                            TechniqueFlag{"--index-scales", kIndices},
                            TechniqueFlag{"--depth-bits", kDepthCube},
                            TechniqueFlag{"--bias", kDepthCube},
                            TechniqueFlag{"--polygon-offset", kShadowMaps},
                            TechniqueFlag{"--depth-encoding", kShadowMaps},
                            TechniqueFlag{"--depth-storage", kShadowMaps},
                            TechniqueFlag{"--volume-method", kShadowVolume},
                            TechniqueFlag{"--stencil-sides", kShadowVolume},
                            TechniqueFlag{"--samples", kReflective},
                            TechniqueFlag{"--kernel", kReflective},
                            TechniqueFlag{"--pattern", kReflective},
                            TechniqueFlag{"--gather-scale", kReflective},
                            TechniqueFlag{"--cookie", kLightCookie},
                            TechniqueFlag{"--light-rotate", kLightCookie},
                            TechniqueFlag{"--cookie-shadows", kLightCookie}};

unsigned readers_of(const SceneFlags& flags) {
  constexpr std::array<std::string_view, 6> kNames{"index-cube",    "depth-cube", "shadow-map",
                                                   "shadow-volume", "reflective", "light-cookie"};
  unsigned readers = 0;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (kNames[i] == flags.technique) readers = 1U << i;
  }
  if (readers == kLightCookie && flags.settings.light_cookie.shadows) readers |= kCookieIndices;
  return readers;
}

}  // namespace

std::string unread_flag(const CLI::App& verb, const SceneFlags& flags) {
  const unsigned technique = readers_of(flags);
  const auto option = [&](std::string_view flag) { return verb.get_option_no_throw(std::string(flag)); };
  std::string own;
  for (const TechniqueFlag& f : kFlags) {
    if ((f.readers & technique) != 0 && option(f.flag) != nullptr)
      own += (own.empty() ? "" : ", ") + std::string(f.flag);
  }
  for (const TechniqueFlag& f : kFlags) {
    const CLI::Option* const given = option(f.flag);
    if (given == nullptr || given->count() == 0 || (f.readers & technique) != 0) continue;
    const bool without_indices = flags.technique == "light-cookie" && (f.readers & kCookieIndices) != 0;
    return fmt::format("{}: technique {}{} does not read it; expected {}", f.flag, flags.technique,
                       without_indices ? " with --cookie-shadows none" : "", own);
  }
  return {};
}

std::vector<std::string> technique_flags() {
  std::vector<std::string> names;
  for (const TechniqueFlag& f : kFlags) names.emplace_back(f.flag);
  return names;
}

bool reads_flag(const SceneFlags& flags, std::string_view flag) {
  for (const TechniqueFlag& f : kFlags) {
    if (f.flag == flag) return (f.readers & readers_of(flags)) != 0;
  }
  return true;
}

}  // namespace ninebit::tools
