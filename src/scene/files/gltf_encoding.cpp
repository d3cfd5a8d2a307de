#include <fmt/format.h>

#include <array>

#include "src/scene/files/gltf_storage.h"
#include "src/scene/scene_check.h"

namespace ninebit {
namespace {

std::uint64_t little32(std::string_view data, std::size_t at) {
  std::uint64_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = (value << 8U) | static_cast<unsigned char>(data[at + i]);
  return value;
}

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  return c == '/' ? 63 : -1;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

Result<GlbParts> split_glb1(std::string_view content) {
  const std::uint64_t size = little32(content, 12);
  if (little32(content, 16) != 0) return fault_of("is malformed: the first part of a .glb file of version 1 is JSON");
  if (size > content.size() - 20) return fault_of("is malformed: its JSON is longer than the file");
  return GlbParts{content.substr(20, size), content.substr(20 + size)};
}

}  // namespace

Result<GlbParts> split_glb(std::string_view content) {
  constexpr std::uint64_t kJson = 0x4E4F534A;
  constexpr std::uint64_t kBinary = 0x004E4942;
  if (content.substr(0, 4) != "glTF") return fault_of("is not a binary glTF file: it does not start with 'glTF'");
  if (content.size() < 20) return fault_of("ends early, within its header");
  const std::uint64_t version = little32(content, 4);
  if (version != 1 && version != 2)
    return fault_of(fmt::format("is of binary glTF version {}; versions 1 and 2 are read", version));
  const std::uint64_t length = little32(content, 8);
  if (length > content.size())
    return fault_of(fmt::format("ends early: it declares {} bytes and has {}", length, content.size()));
  if (version == 1) return split_glb1(content);
  GlbParts parts;
  std::string_view rest = content.substr(12, length < 12 ? 0 : length - 12);
  for (bool first = true; rest.size() >= 8; first = false) {
    const std::uint64_t size = little32(rest, 0);
    const std::uint64_t type = little32(rest, 4);
    if (size > rest.size() - 8) return fault_of("is malformed: a chunk is longer than the file");
    if (first && type != kJson) return fault_of("is malformed: its first chunk is not JSON");
    if (first) parts.json = rest.substr(8, size);
    if (!first && type == kBinary && !parts.binary) parts.binary = rest.substr(8, size);
    rest.remove_prefix(8 + size);
  }
  return parts;
}

std::optional<std::string> decode_base64(std::string_view text) {
  if (text.size() % 4 != 0) return std::nullopt;
  // One or two '=' pad the last group of four.
  std::size_t digits = text.size();
  while (digits > 0 && text.size() - digits < 2 && text[digits - 1] == '=') --digits;
  std::string out;
  out.reserve(text.size() / 4 * 3);
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < digits; ++i) {
    const int digit = base64_digit(text[i]);
    if (digit < 0) return std::nullopt;
    bits = (bits << 6U) | static_cast<std::uint32_t>(digit);
    // After 1, 2, 3 and 4 digits of a group there are 0, 1, 2 and 3 whole bytes.
    if (i % 4 != 0) out.push_back(static_cast<char>((bits >> (2 * (3 - i % 4))) & 255U));
  }
  return out;
}

std::string decode_percent(std::string_view uri) {
  std::string out;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0 && hex_digit(uri[i + 2]) >= 0) {
      out.push_back(static_cast<char>(16 * hex_digit(uri[i + 1]) + hex_digit(uri[i + 2])));
      i += 2;
    } else {
      out.push_back(uri[i]);
    }
  }
  return out;
}

}  // namespace ninebit
