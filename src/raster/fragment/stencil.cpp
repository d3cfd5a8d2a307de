#include "src/raster/fragment/stencil.h"

#include <algorithm>

namespace ninebit {
namespace {

// An operation for every stored byte, with the write mask applied: masked bits keep their old value.
std::array<std::uint8_t, 256> table_of(StencilOperation operation, const StencilFace& face, std::uint8_t reference,
                                       int bits) {
  const unsigned value_bits = (1U << bits) - 1, writable = face.write_mask & value_bits;
  std::array<std::uint8_t, 256> table{};
  for (unsigned stored = 0; stored < 256; ++stored) {
    const unsigned result = stencil_result(operation, static_cast<std::uint8_t>(stored & value_bits), reference, bits);
    table[stored] = static_cast<std::uint8_t>((stored & ~writable) | (result & writable));
  }
  return table;
}

bool is_identity(const std::array<std::uint8_t, 256>& table) {
  for (std::size_t stored = 0; stored < 256; ++stored) {
    if (table[stored] != stored) return false;
  }
  return true;
}

}  // namespace

std::uint8_t stencil_result(StencilOperation operation, std::uint8_t stored, std::uint8_t reference, int bits) {
  const unsigned largest = (1U << bits) - 1, value = stored;
  unsigned result = value;
  switch (operation) {
    case StencilOperation::keep:
      break;
    case StencilOperation::zero:
      result = 0;
      break;
    case StencilOperation::replace:
      result = reference;
      break;
    case StencilOperation::incr:
      result = value == largest ? value : value + 1;
      break;
    case StencilOperation::decr:
      result = value == 0 ? value : value - 1;
      break;
    case StencilOperation::invert:
      result = ~value & largest;
      break;
    case StencilOperation::incr_wrap:
      result = (value + 1) & largest;
      break;
    case StencilOperation::decr_wrap:
      result = (value - 1) & largest;
      break;
  }
  return static_cast<std::uint8_t>(result);
}

StencilSide::StencilSide(const StencilFace& face, int bits) : function_(face.function) {
  const int largest = (1 << bits) - 1;
  const auto reference = static_cast<std::uint8_t>(std::clamp(face.reference, 0, largest));
  mask_ = static_cast<std::uint8_t>(face.mask & largest);
  reference_ = reference & mask_;
  fail_ = table_of(face.fail, face, reference, bits);
  depth_fail_ = table_of(face.depth_fail, face, reference, bits);
  depth_pass_ = table_of(face.depth_pass, face, reference, bits);
  failing_changes_nothing_ = is_identity(fail_) && is_identity(depth_fail_);
  passing_changes_nothing_ = is_identity(depth_pass_);
}

}  // namespace ninebit
