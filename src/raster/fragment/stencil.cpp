#include "src/raster/fragment/stencil.h"

#include <algorithm>

#include "src/raster/rules/one_fragment.h"

namespace ninebit {
namespace {

// An operation for every stored byte, with the write mask applied: masked bits keep their old value.
std::array<std::uint8_t, 256> table_of(StencilOperation operation, const StencilFace& face, std::uint8_t reference,
                                       int bits) {
  const int value_bits = (1 << bits) - 1, writable = face.write_mask & value_bits;
  std::array<std::uint8_t, 256> table{};
  for (int stored = 0; stored < 256; ++stored) {
    const int result = stencil_result(operation, static_cast<std::uint8_t>(stored & value_bits), reference, bits);
    table[static_cast<std::size_t>(stored)] =
        static_cast<std::uint8_t>(one_fragment::write_masked(one_fragment::Numbers(), stored, result, writable));
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
  return static_cast<std::uint8_t>(
      one_fragment::stencil_result(one_fragment::Numbers(), operation, stored, reference, (1 << bits) - 1));
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
