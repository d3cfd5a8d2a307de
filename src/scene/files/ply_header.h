// The header of a PLY file: its elements and their properties.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/numerics/result.h"
#include "src/scene/files/text_scan.h"

namespace ninebit {

struct PlyType {
  std::size_t size = 0;  // bytes in a binary file; 0: not a PLY type
  bool real = false;
  bool is_signed = false;
};

// The meaning of a property. The roles before `corners` are the indices of PlyRow::values.
enum class PlyRole : std::uint8_t {
  x,
  y,
  z,
  nx,
  ny,
  nz,
  red,
  green,
  blue,
  alpha,
  s,
  t,
  secondary_red,
  secondary_green,
  secondary_blue,
  secondary_alpha,
  fog_factor,
  corners,
  none
};
inline constexpr std::size_t kPlyValues = 17;

struct PlyProperty {
  std::string name;
  PlyType type;
  PlyType count;  // size 0: not a list
  PlyRole role = PlyRole::none;
};

enum class PlyKind : std::uint8_t { vertex, face, strip, material, other };

struct PlyElement {
  std::string name;
  PlyKind kind = PlyKind::other;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  [[nodiscard]] bool has(PlyRole role) const;
};

struct PlyHeader {
  bool binary = false;
  bool big_endian = false;
  std::vector<PlyElement> elements;
};

// Reads the header from the lines. Vertices must come before the elements that use them, and each element that is read
// may come only once.
[[nodiscard]] Result<PlyHeader> read_ply_header(LineScanner& lines);

}  // namespace ninebit
