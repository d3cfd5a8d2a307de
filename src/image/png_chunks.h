// The part of a PNG file that holds its picture, checked.
#pragma once

#include <istream>
#include <string>

namespace ninebit::image_detail {

struct PngChunks {
  std::string bytes;      // a PNG file of the chunks that decide the pixels, and of no other
  std::string complaint;  // what is wrong with the file; empty: nothing
};

// Reads a PNG file's chunks. libpng prints whatever it finds wrong, such as the unusual colour profiles of many
// textures, and OpenImageIO cannot keep it from that; so it is shown only chunks that are whole, needed and in order.
// Reports: not a PNG, a truncated file, a wrong checksum, a malformed header or palette, a size out of range, other
// samples than of 8 bits, other than 1, 3 or 4 channels.
[[nodiscard]] PngChunks read_png_chunks(std::istream& in);

}  // namespace ninebit::image_detail
