#include <array>
#include <cmath>
#include <cstdlib>
#include <string>

#include "src/combiner/vector_code.h"

namespace ninebit {
namespace {

using detail::Formula;
using detail::Kernel;
using detail::Line;
using detail::PlanePlace;
using detail::Space;
using detail::VectorOperation;

// Returns the nearest multiple of one quarter as text.
std::string number(float v) {
  const long quarters = std::lround(4.0F * v);
  const std::array<const char*, 4> fraction{"", ".25", ".5", ".75"};
  return (quarters < 0 ? "-" : "") + std::to_string(std::abs(quarters) / 4) +
         fraction[static_cast<std::size_t>(std::abs(quarters) % 4)];
}

class Text {
 public:
  explicit Text(const detail::VectorCode& code) : code_(code) {}

  std::string line(const VectorOperation& operation) const {
    return name(operation.target) + " = " + clamped(operation.formula, value(operation)) + '\n';
  }

 private:
  std::string name(const PlanePlace& plane) const {
    const auto component = [&] { return std::string(".") + "rgba"[plane.index % 4]; };
    switch (plane.space) {
      case Space::registers:
        return std::string(name_of(static_cast<Register>(plane.index / 4))) + component();
      case Space::colors:
        return "out" + component();
      case Space::constants:
        return std::to_string(code_.constants[plane.index].lane[0]);
      case Space::temporaries:
        break;
    }
    return "t" + std::to_string(plane.index);
  }

  std::string operand(const VectorOperation& operation, std::size_t k) const {
    const std::string plane = name(operation.source[k]);
    const std::string value = operation.formula.is_floored(k) ? "max(" + plane + ", 0)" : plane;
    if ((operation.lines >> k & 1U) == 0) return value;
    const Line& line = operation.line[k];
    return "(" + std::to_string(line.factor) + "*" + value +
           (line.offset == 0 ? "" : " + " + std::to_string(line.offset)) + ")";
  }

  static std::string clamped(const Formula& f, const std::string& value) {
    if (f.kernel == Kernel::select || !f.clamps()) return value;
    return "clamp(" + value + ", " + std::to_string(f.low) + ", " + std::to_string(f.high) + ")";
  }

  std::string sum_of_products(const VectorOperation& operation) const {
    std::string text;
    for (std::size_t k = 0; k < static_cast<std::size_t>(operation.formula.terms); ++k) {
      text += (k == 0 ? "" : " + ") + operand(operation, 2 * k) + "*" + operand(operation, 2 * k + 1);
    }
    return text;
  }

  std::string affine(const VectorOperation& operation) const {
    const Formula& f = operation.formula;
    std::string text;
    for (std::size_t k = 0; k < static_cast<std::size_t>(f.terms); ++k) {
      text += (k == 0 ? "" : " + ") + std::to_string(f.factor[k]) + "*" + operand(operation, k);
    }
    if (f.offset != 0) text += " + " + std::to_string(f.offset);
    return f.halves ? rounded(f, "(" + text + ") / 2") : text;
  }

  static std::string rounded(const Formula& f, const std::string& value) {
    return (f.nearest ? "nearest(" : "truncate(") + value + ")";
  }

  std::string value(const VectorOperation& operation) const {
    const Formula& f = operation.formula;
    switch (f.kernel) {
      case Kernel::affine:
        return affine(operation);
      case Kernel::unsigned_products: {
        if (f.adds)
          return "u16:" + divided(operation, 0) + " + " + operand(operation, static_cast<std::size_t>(2 * f.terms));
        return "u16:" + divided(operation, 0) + (f.offset == 0 ? "" : " + " + std::to_string(f.offset));
      }
      case Kernel::signed_product:
      case Kernel::signed_sum:
        return "s16:" + divided(operation, f.offset);
      case Kernel::products: {
        const std::string bias = f.bias == 0 ? "" : " + " + number(f.bias);
        return "s32:" + rounded(f, "(" + sum_of_products(operation) + bias + ") / " + number(1 / f.reciprocal));
      }
      case Kernel::select:
        return "(" + name(operation.source[0]) + " >= " + std::to_string(f.low) + " ? " + operand(operation, 2) +
               " : " + operand(operation, 1) + ")";
      case Kernel::select_odd:
        return "(odd(" + operand(operation, 0) + ") ? " + operand(operation, 2) + " : " + operand(operation, 1) + ")";
      case Kernel::copy:
        break;
    }
    return name(operation.source[0]);
  }

  std::string divided(const VectorOperation& operation, int inside) const {
    const Formula& f = operation.formula;
    const std::string scale = f.doublings == 0 ? "" : "*" + std::to_string(1 << f.doublings);
    const std::string offset = inside == 0 ? "" : " + " + std::to_string(inside);
    return rounded(f, "(" + sum_of_products(operation) + offset + ")" + scale + " / 255");
  }

  const detail::VectorCode& code_;
};

}  // namespace

std::string BatchProgram::describe() const {
  std::string text;
  if (!code_) return text;
  const Text lines(*code_);
  for (const VectorOperation& operation : code_->operations) text += lines.line(operation);
  return text;
}

}  // namespace ninebit
