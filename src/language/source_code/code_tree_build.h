// Makes expressions of the tree.
#pragma once

#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "src/language/source_code/code_tree.h"

namespace ninebit::code {

[[nodiscard]] inline Expression made(Expression::Kind kind, std::string_view text, std::uint32_t offset,
                                     std::uint32_t end, std::vector<Expression> parts = {}) {
  Expression out;
  out.kind = kind;
  out.text = text;
  out.offset = offset;
  out.end = end;
  out.parts = std::move(parts);
  return out;
}

// An expression with one part that begins at `offset`.
[[nodiscard]] inline Expression around(Expression::Kind kind, std::string_view text, std::uint32_t offset,
                                       Expression part) {
  const std::uint32_t end = part.end;
  std::vector<Expression> parts;
  parts.push_back(std::move(part));
  return made(kind, text, offset, end, std::move(parts));
}

// An expression with two parts.
[[nodiscard]] inline Expression joined(Expression::Kind kind, std::string_view text, Expression left,
                                       Expression right) {
  const std::uint32_t offset = left.offset, end = right.end;
  std::vector<Expression> parts;
  parts.push_back(std::move(left));
  parts.push_back(std::move(right));
  return made(kind, text, offset, end, std::move(parts));
}

[[nodiscard]] inline bool failed(const Expression& e) {
  return e.kind == Expression::Kind::unreadable;
}

}  // namespace ninebit::code
