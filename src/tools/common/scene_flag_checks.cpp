#include "src/tools/common/scene_flag_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "ninebit/frame/settings.h"
#include "ninebit/raster/surface.h"
#include "src/system/number_list.h"
#include "src/tools/common/number_flag.h"

namespace ninebit::tools {

std::string check_size(const std::string& text) {
  const auto n = numbers<int>(text, 'x');
  if (n && n->size() == 2 && n->at(0) >= 1 && n->at(1) >= 1 && std::max(n->at(0), n->at(1)) <= kMaxSurfaceSize)
    return {};
  return fmt::format("invalid picture size '{}'; expected WIDTHxHEIGHT, each from 1 to {}", text, kMaxSurfaceSize);
}

std::string check_point(const std::string& text) {
  if (are_numbers_in<float>(text, ',', 3, -kMostDistance, kMostDistance)) return {};
  return fmt::format("invalid point '{}'; expected X,Y,Z, each from -1e12 to 1e12", text);
}

std::string check_floor(const std::string& text) {
  if (text == "auto" || text == "none") return {};
  if (are_numbers_in<float>(text, ',', 1, -kMostDistance, kMostDistance)) return {};
  return fmt::format("invalid floor '{}'; expected auto, none or a height from -1e12 to 1e12", text);
}

std::string check_fov(const std::string& text) {
  if (are_numbers_in<float>(text, ',', 1, 0.01F, 170.0)) return {};
  return fmt::format("invalid angle '{}'; expected degrees from 0.01 to 170", text);
}

std::string check_spot_angle(const std::string& text) {
  if (are_numbers_in<float>(text, ',', 1, 1.0, 170.0)) return {};
  return fmt::format("invalid angle '{}'; expected degrees from 1 to 170", text);
}

std::string check_file_name(const std::string& text) {
  return text.empty() ? "the file name is empty" : "";
}

}  // namespace ninebit::tools
