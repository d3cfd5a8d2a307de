// A row's value as JSON; std::monostate becomes null.
#pragma once

#include <nlohmann/json.hpp>
#include <type_traits>
#include <variant>

#include "ninebit/study/study.h"

namespace ninebit {

inline nlohmann::ordered_json json_value(const StudyValue& value) {
  return std::visit(
      [](const auto& v) -> nlohmann::ordered_json {
        if constexpr (std::is_same_v<std::decay_t<decltype(v)>, std::monostate>) {
          return nullptr;
        } else {
          return v;
        }
      },
      value);
}

}  // namespace ninebit
