// Pictures as they stand in files, read by the readers of OpenEXR and OpenImageIO: no code is shared with src/.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "ninebit/image/image_io.h"

namespace ninebit::test {

// One channel of an EXR file as stored; only the vector of its type is filled.
struct StoredChannel {
  std::vector<std::uint32_t> integers;  // UINT
  std::vector<float> reals;             // HALF
  std::vector<float> floats;            // FLOAT
  // Whichever there are.
  [[nodiscard]] std::vector<double> numbers() const;
};

struct StoredPart {
  std::string name;
  int width = 0;
  int height = 0;
  bool zip = false;
  bool cube = false;  // has the envmap attribute with ENVMAP_CUBE
  std::map<std::string, StoredChannel> channels;
  // 'u' (UINT), 'h' (HALF) or 'f' (FLOAT) by the channel's name.
  [[nodiscard]] std::map<std::string, char> types() const;
};

// All parts. Throws where OpenEXR's reader does.
std::vector<StoredPart> read_exr(const std::filesystem::path& file);

// An 8-bit picture with alpha as stored. Throws std::runtime_error where OpenImageIO's reader fails, and for another
// depth.
Image8 read_png(const std::filesystem::path& file);
// The same of a 16-bit picture.
Image16 read_png16(const std::filesystem::path& file);

// Writes a picture in the format of the file's extension. Throws std::runtime_error where OpenImageIO does not.
void write_as(const std::filesystem::path& file, const Image8& image);

}  // namespace ninebit::test
