// scenes/index_room.gltf, embedded at build time.
#pragma once

#include <string_view>

namespace ninebit::playground {

extern const std::string_view kRoomText;

}  // namespace ninebit::playground
