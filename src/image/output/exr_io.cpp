#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "ninebit/image/image_io.h"
#include "src/image/output/exr_file.h"
#include "src/image/output/faults.h"
#include "src/system/files.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {

namespace {

using image_detail::cannot_write;
using image_detail::complain_about_size;
using image_detail::ExrBlock;
using image_detail::ExrFile;
using image_detail::ExrRows;
using image_detail::Flips;
using image_detail::invalid_input;
using image_detail::kExrBlockRows;
using posix::CheckedFile;

constexpr std::size_t kLongestName = 255;  // of a channel, by the file format

// Empty, or what is wrong with the channels of a picture.
std::string complain_about_channels(std::span<const ExrChannel> channels) {
  if (channels.empty()) return "has no channels";
  std::set<std::string_view> names;
  for (const ExrChannel& channel : channels) {
    if (channel.name.empty() || channel.name.size() > kLongestName || channel.name.find('\0') != std::string::npos) {
      return fmt::format("has a channel whose name is not 1 to {} characters long", kLongestName);
    }
    if (!names.insert(channel.name).second) return fmt::format("has two channels named {}", channel.name);
    const bool callable = std::visit([](const auto& fill) { return static_cast<bool>(fill); }, channel.rows);
    if (!callable) return fmt::format("has no function for the rows of channel {}", channel.name);
  }
  return {};
}

std::string complain_about_parts(std::span<const ExrPart> parts) {
  if (parts.empty()) return "no parts to write";
  std::set<std::string_view> names;
  for (const ExrPart& part : parts) {
    if (part.name.empty() || part.name.find('\0') != std::string::npos) return "a part has an invalid name";
    if (!names.insert(part.name).second) return fmt::format("two parts are named {}", part.name);
    std::string complaint = complain_about_size(part.width, part.height);
    if (complaint.empty()) complaint = complain_about_channels(part.channels);
    if (!complaint.empty()) return fmt::format("part {} {}", part.name, complaint);
  }
  return {};
}

std::string complain_about_faces(int size, std::span<const std::vector<ExrChannel>, 6> faces) {
  if (std::string complaint = complain_about_size(size, size); !complaint.empty()) return "a cube face " + complaint;
  for (std::size_t face = 0; face < faces.size(); ++face) {
    const std::string complaint = complain_about_channels(faces[face]);
    if (!complaint.empty()) return fmt::format("cube face {} {}", face, complaint);
    const auto alike = [](const ExrChannel& a, const ExrChannel& b) {
      return a.name == b.name && a.rows.index() == b.rows.index();
    };
    if (!std::equal(faces[face].begin(), faces[face].end(), faces[0].begin(), faces[0].end(), alike)) {
      return fmt::format("cube face {} has other channels than face 0", face);
    }
  }
  return {};
}

// Writes the blocks of pictures, a few at a time: the caller's thread fetches their rows, all threads compress them.
class BlockWriter {
 public:
  explicit BlockWriter(ExrFile& file) : file_(file) {}

  // All blocks of a part; fetch(row, to) stores the bytes of a row.
  template <class Fetch>
  void write(int part, int height, std::size_t row_bytes, const Fetch& fetch) {
    constexpr int kBatch = static_cast<int>(kBlocks) * kExrBlockRows;
    for (int batch = 0; batch < height; batch += kBatch) {
      std::size_t blocks = 0;
      for (int row = batch; row < std::min(batch + kBatch, height); row += kExrBlockRows) {
        const int rows = std::min(kExrBlockRows, height - row);
        std::vector<std::uint8_t>& bytes = blocks_[blocks++].rows();
        bytes.resize(static_cast<std::size_t>(rows) * row_bytes);
        for (int r = 0; r < rows; ++r) fetch(row + r, bytes.data() + static_cast<std::size_t>(r) * row_bytes);
      }
      parallel_for(blocks, 1, [&](std::size_t i) { blocks_[i].compress(); });
      for (std::size_t i = 0; i < blocks; ++i) {
        file_.add_block(part, batch + static_cast<int>(i) * kExrBlockRows, blocks_[i].stored());
      }
    }
  }

 private:
  static constexpr std::size_t kBlocks = 4;  // at a time

  ExrFile& file_;
  std::array<ExrBlock, kBlocks> blocks_;
};

// Runs write(exr) on a new file; leaves no incomplete file behind.
template <class Write>
Status write_checked(const std::filesystem::path& file, const Write& write) {
  CheckedFile output(file);
  if (!output.failed()) {
    ExrFile exr(output);
    write(exr);
    const std::string fault = exr.finish();
    if (!fault.empty() && !output.failed()) {
      return cannot_write(file, fmt::format("could not be written as EXR: {}", fault));
    }
  }
  return image_detail::close_written(output);
}

}  // namespace

Status write_exr_parts(const std::filesystem::path& file, std::span<const ExrPart> parts) {
  if (std::string complaint = complain_about_parts(parts); !complaint.empty()) {
    return invalid_input(file, std::move(complaint));
  }
  return write_checked(file, [&](ExrFile& exr) {
    exr.set_window(parts[0].width, parts[0].height);
    for (const ExrPart& part : parts) exr.add_part(part.name, part.width, part.height, part.channels);
    exr.begin_blocks();
    BlockWriter blocks(exr);
    for (std::size_t p = 0; p < parts.size(); ++p) {
      const ExrPart& part = parts[p];
      ExrRows rows(part.width, part.height, part.channels, Flips{});
      blocks.write(static_cast<int>(p), part.height, rows.row_bytes(),
                   [&](int row, std::uint8_t* to) { rows.fetch(row, to); });
    }
  });
}

Status write_exr_cube(const std::filesystem::path& file, int size, std::span<const std::vector<ExrChannel>, 6> faces) {
  if (std::string complaint = complain_about_faces(size, faces); !complaint.empty()) {
    return invalid_input(file, std::move(complaint));
  }
  return write_checked(file, [&](ExrFile& exr) {
    exr.set_window(size, 6 * size);
    exr.add_part({}, size, 6 * size, faces[0]);
    exr.mark_as_cube();
    exr.begin_blocks();
    std::vector<ExrRows> rows;
    for (int face = 0; face < 6; ++face) {
      // ARB_texture_cube_map views the faces from inside a left-handed cube, OpenEXR from outside a right-handed one:
      // columns are reversed on the four sides, rows on +Y and -Y.
      const bool is_y = face / 2 == 1;
      rows.emplace_back(size, size, faces[static_cast<std::size_t>(face)], Flips{!is_y, is_y});
    }
    BlockWriter(exr).write(0, 6 * size, rows[0].row_bytes(), [&](int row, std::uint8_t* to) {
      rows[static_cast<std::size_t>(row / size)].fetch(row % size, to);
    });
  });
}

}  // namespace ninebit
