#include "src/image/png_chunks.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "src/image/faults.h"

namespace ninebit::image_detail {

namespace {

constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";

constexpr std::array<std::uint32_t, 256> make_crc_table() {
  std::array<std::uint32_t, 256> table = {};
  for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
    std::uint32_t value = byte;
    for (int bit = 0; bit < 8; ++bit) value = (value >> 1) ^ ((value & 1U) != 0 ? 0xEDB88320U : 0U);
    table[byte] = value;
  }
  return table;
}

std::uint32_t crc(std::string_view bytes) {
  static constexpr std::array<std::uint32_t, 256> kTable = make_crc_table();
  std::uint32_t value = 0xFFFFFFFFU;
  for (const char byte : bytes) value = (value >> 8) ^ kTable[(value ^ static_cast<std::uint8_t>(byte)) & 0xFFU];
  return ~value;
}

std::uint32_t big_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (const char byte : bytes.substr(at, 4)) value = (value << 8) | static_cast<std::uint8_t>(byte);
  return value;
}

// Appends `count` bytes; false when the file ends before. Goes in steps, so that a wrong length allocates nothing that
// the file does not have.
bool read_bytes(std::istream& in, std::size_t count, std::string& to) {
  constexpr std::size_t kStep = std::size_t{1} << 20;
  while (count > 0) {
    const std::size_t step = std::min(count, kStep);
    const std::size_t before = to.size();
    to.resize(before + step);
    if (!in.read(to.data() + before, static_cast<std::streamsize>(step))) return false;
    count -= step;
  }
  return true;
}

struct Header {
  int colour_type = -1;  // 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA; -1: not seen yet
  std::size_t palette_entries = 0;
  bool has_transparency = false;
  bool has_data = false;
};

std::string take_header(std::string_view content, Header& header) {
  if (header.colour_type >= 0) return "has two headers";
  if (content.size() != 13) return "has a malformed header";
  const std::uint32_t width = big_endian(content, 0);
  const std::uint32_t height = big_endian(content, 4);
  const int depth = static_cast<std::uint8_t>(content[8]);
  header.colour_type = static_cast<std::uint8_t>(content[9]);
  constexpr std::string_view kKnownTypes("\0\2\3\4\6", 5);
  if (kKnownTypes.find(content[9]) == std::string_view::npos) return "has an unknown colour type";
  if (content[10] != 0 || content[11] != 0 || static_cast<std::uint8_t>(content[12]) > 1) {
    return "has an unknown compression, filter or interlacing";
  }
  // A palette's 8-bit colours may have shorter numbers, and so may grey, which is widened to 8 bits.
  const bool may_be_short = header.colour_type == 0 || header.colour_type == 3;
  if (depth != 8 && !(may_be_short && (depth == 1 || depth == 2 || depth == 4))) {
    return "has samples of " + std::to_string(depth) + " bits; 8-bit ones are expected";
  }
  if (header.colour_type == 4) return "has 2 channels; 1, 3 or 4 are expected";
  constexpr std::uint32_t kLargest = 0x7FFFFFFF;
  return complain_about_size(static_cast<int>(std::min(width, kLargest)), static_cast<int>(std::min(height, kLargest)));
}

std::string take_palette(std::string_view content, Header& header) {
  const std::size_t entries = content.size() / 3;
  if (header.palette_entries > 0 || header.has_data || content.size() % 3 != 0 || entries < 1 || entries > 256) {
    return "has a malformed palette";
  }
  header.palette_entries = entries;
  return {};
}

std::string take_transparency(std::string_view content, Header& header) {
  if (header.colour_type == 0) return "has 2 channels; 1, 3 or 4 are expected";
  const bool fits =
      header.colour_type == 2 ? content.size() == 6 : !content.empty() && content.size() <= header.palette_entries;
  if (header.has_transparency || header.has_data || !fits) return "has a malformed transparency";
  header.has_transparency = true;
  return {};
}

enum class Use { keep, drop };

// Whether the chunk decides pixels; the complaint is empty when it is in order.
Use judge(std::string_view name, std::string_view content, Header& header, std::string& complaint) {
  if (name == "IHDR") {
    complaint = take_header(content, header);
  } else if (header.colour_type < 0) {
    complaint = "does not begin with a header";
  } else if (name == "PLTE") {
    if (header.colour_type != 3) return Use::drop;  // a suggestion for small displays
    complaint = take_palette(content, header);
  } else if (name == "tRNS") {
    if (header.colour_type == 6) return Use::drop;  // senseless there
    complaint = take_transparency(content, header);
  } else if (name == "IDAT") {
    if (header.colour_type == 3 && header.palette_entries == 0) complaint = "has no palette";
    header.has_data = true;
  } else if (name == "IEND") {
    if (!header.has_data) complaint = "has no picture data";
  } else {
    const bool is_critical = (static_cast<unsigned>(name[0]) & 0x20U) == 0;
    if (is_critical) complaint = "has a chunk that is not known";
    return Use::drop;
  }
  return Use::keep;
}

}  // namespace

PngChunks read_png_chunks(std::istream& in) {
  PngChunks file;
  const auto refuse = [](std::string complaint) { return PngChunks{{}, std::move(complaint)}; };
  if (!read_bytes(in, kSignature.size(), file.bytes) || file.bytes != kSignature) return refuse("is not a PNG file");
  Header header;
  while (true) {
    // Length, name, content, checksum of name and content.
    const std::size_t start = file.bytes.size();
    if (!read_bytes(in, 8, file.bytes)) return refuse("is truncated");
    const std::size_t size = big_endian(file.bytes, start);
    if (size > 0x7FFFFFFFU) return refuse("is damaged: a chunk has an impossible length");
    if (!read_bytes(in, size + 4, file.bytes)) return refuse("is truncated");
    const std::string_view checked = std::string_view(file.bytes).substr(start + 4, size + 4);
    if (crc(checked) != big_endian(file.bytes, start + 8 + size)) return refuse("is damaged: a checksum is wrong");
    std::string complaint;
    const Use use = judge(checked.substr(0, 4), checked.substr(4), header, complaint);
    if (!complaint.empty()) return refuse(std::move(complaint));
    if (checked.substr(0, 4) == "IEND") return file;
    if (use == Use::drop) file.bytes.resize(start);
  }
}

}  // namespace ninebit::image_detail
