#include "src/tools/common/flag_groups.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace ninebit::tools {
namespace {

struct FlagGroup {
  const char* title;
  std::vector<std::string_view> flags;
};

const std::array<FlagGroup, 10>& flag_groups() {
  static const std::array<FlagGroup, 10> groups{
      FlagGroup{"Picture",
                {"--technique", "--size", "--style", "--depth-stencil", "--cull", "--light-facing", "--supersample",
                 "--turntable", "--only", "--layers"}},
      FlagGroup{"Scene, camera and light",
                {"--up", "--allow-outside", "--floor", "--camera", "--look-at", "--fov", "--light", "--light-type",
                 "--light-target", "--spot-angle"}},
      FlagGroup{"Map of the light (index-cube, depth-cube, shadow-map, reflective, light-cookie)", {"--map-size"}},
      FlagGroup{"Indices (index-cube, light-cookie)",
                {"--index-format", "--index-scope", "--index-step", "--section-size", "--index-order", "--patch-angle",
                 "--index-scales", "--check-order", "--pick"}},
      FlagGroup{"Depth cube map (depth-cube)", {"--depth-bits", "--bias"}},
      FlagGroup{"Shadow map (shadow-map, reflective)", {"--polygon-offset", "--depth-encoding", "--depth-storage"}},
      FlagGroup{"Shadow volumes (shadow-volume)", {"--volume-method", "--stencil-sides"}},
      FlagGroup{"Reflected light (reflective)", {"--samples", "--kernel", "--pattern", "--gather-scale"}},
      FlagGroup{"Light cookie (light-cookie)", {"--cookie", "--light-rotate", "--cookie-shadows"}},
      FlagGroup{"Checks", {"--ground-truth"}}};
  return groups;
}

}  // namespace

void group_scene_flags(CLI::App& verb) {
  for (const FlagGroup& group : flag_groups()) {
    for (const std::string_view flag : group.flags) {
      if (CLI::Option* const option = verb.get_option_no_throw(std::string(flag)); option != nullptr) {
        option->group(group.title);
      }
    }
  }
}

}  // namespace ninebit::tools
