#include "ninebit/image/image_io.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "src/image/output/deflate.h"
#include "src/image/output/faults.h"
#include "src/system/files.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {

namespace {

using image_detail::complain_about_size;
using image_detail::DeflateFrame;
using image_detail::Deflater;
using image_detail::invalid_input;
using posix::CheckedFile;

// Pieces of about this size are filtered and compressed alone, as many at a time: they stay in the second-level cache.
constexpr std::size_t kPieceBytes = std::size_t{1} << 18, kPiecesAtOnce = 16;

using Bytes = std::vector<std::uint8_t>;

void put_big_endian(std::uint32_t value, std::uint8_t* to) {
  for (int shift = 24; shift >= 0; shift -= 8) *to++ = static_cast<std::uint8_t>(value >> shift);
}

constexpr std::size_t kChunkStart = 8;  // bytes before a chunk's content: its size and its type

// Whether write(bytes, size) could write a chunk. Its size, in its first four bytes, and its checksum are added here.
template <class Write>
bool write_chunk(Bytes& chunk, const Write& write) {
  constexpr std::size_t kSize = 4;
  put_big_endian(static_cast<std::uint32_t>(chunk.size() - kChunkStart), chunk.data());
  const auto sum = static_cast<std::uint32_t>(crc32_z(0, chunk.data() + kSize, chunk.size() - kSize));
  chunk.resize(chunk.size() + sizeof sum);
  put_big_endian(sum, chunk.data() + chunk.size() - sizeof sum);
  return write(chunk.data(), chunk.size());
}

// The bytes of a row, in the order of the file.
template <class Sample>
void put_row(std::span<const Sample> row, std::uint8_t* to) {
  if constexpr (sizeof(Sample) == 1) {
    std::copy(row.begin(), row.end(), to);
  } else {
    for (std::size_t i = 0; i < row.size(); ++i) {
      to[2 * i] = static_cast<std::uint8_t>(row[i] >> 8);
      to[2 * i + 1] = static_cast<std::uint8_t>(row[i]);
    }
  }
}

// Some rows, filtered and compressed: the content of a chunk, and the checksum of what it decompresses to.
struct Piece {
  Bytes chunk{0, 0, 0, 0, 'I', 'D', 'A', 'T'};
  uLong sum = 0;
  std::size_t bytes = 0;
};

// The filter Up, differences from the row above, takes next to no time and makes most pictures smaller.
template <class Sample>
Piece compress_rows(const Image<Sample>& image, std::size_t first, std::size_t last) {
  constexpr std::array<std::uint8_t, 2> kZlibHeader{0x78, 0x5E};
  const std::size_t samples = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
  const std::size_t row_bytes = 1 + samples * sizeof(Sample);
  const auto row_of = [&](std::size_t row) { return std::span(image.pixels).subspan(row * samples, samples); };
  Bytes filtered((last - first) * row_bytes), above(row_bytes - 1), line(above.size());
  if (first > 0) put_row(row_of(first - 1), above.data());
  for (std::size_t row = first; row < last; ++row) {
    std::uint8_t* const to = filtered.data() + (row - first) * row_bytes;
    put_row(row_of(row), line.data());
    to[0] = 2;  // Up
    for (std::size_t i = 0; i < line.size(); ++i) to[1 + i] = static_cast<std::uint8_t>(line[i] - above[i]);
    line.swap(above);
  }
  Piece piece;
  if (first == 0) piece.chunk.insert(piece.chunk.end(), kZlibHeader.begin(), kZlibHeader.end());
  Deflater deflater(DeflateFrame::none);
  deflater.add(filtered, piece.chunk);
  if (last == static_cast<std::size_t>(image.height)) {
    deflater.end(piece.chunk);
  } else {
    deflater.flush(piece.chunk);
  }
  piece.sum = adler32_z(adler32_z(0, nullptr, 0), filtered.data(), filtered.size());
  piece.bytes = filtered.size();
  return piece;
}

// Gives the bytes of a file to write(bytes, size) until that returns false. They do not depend on the number of
// threads.
template <class Sample, class Write>
void encode(const Image<Sample>& image, const Write& write) {
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1A\n";
  if (!write(kSignature.data(), kSignature.size())) return;
  Bytes header{0, 0, 0, 0, 'I', 'H', 'D', 'R', 0, 0, 0, 0, 0, 0, 0, 0, 8 * sizeof(Sample), 0, 0, 0, 0};
  put_big_endian(static_cast<std::uint32_t>(image.width), &header[8]);
  put_big_endian(static_cast<std::uint32_t>(image.height), &header[12]);
  header[17] = image.channels == 1 ? 0 : image.channels == 3 ? 2 : 6;  // grey, RGB, RGBA
  if (!write_chunk(header, write)) return;
  const std::size_t row_bytes = image.pixels.size() / static_cast<std::size_t>(image.height) * sizeof(Sample);
  const auto height = static_cast<std::size_t>(image.height);
  const std::size_t piece_rows = std::clamp<std::size_t>(kPieceBytes / row_bytes, 1, height);
  uLong sum = adler32_z(0, nullptr, 0);
  for (std::size_t first = 0; first < height; first += piece_rows * kPiecesAtOnce) {
    std::vector<Piece> pieces(std::min(kPiecesAtOnce, (height - first + piece_rows - 1) / piece_rows));
    parallel_for(pieces.size(), [&](std::size_t i) {
      const std::size_t row = first + i * piece_rows;
      pieces[i] = compress_rows(image, row, std::min(row + piece_rows, height));
    });
    for (Piece& piece : pieces) {
      sum = adler32_combine(sum, piece.sum, static_cast<z_off_t>(piece.bytes));
      if (&piece == &pieces.back() && height - first <= piece_rows * kPiecesAtOnce) {
        piece.chunk.resize(piece.chunk.size() + sizeof(std::uint32_t));
        put_big_endian(static_cast<std::uint32_t>(sum), &piece.chunk.back() - 3);
      }
      if (!write_chunk(piece.chunk, write)) return;
    }
  }
  Bytes end{0, 0, 0, 0, 'I', 'E', 'N', 'D'};
  write_chunk(end, write);
}

template <class Sample>
Status check(const std::filesystem::path& file, const Image<Sample>& image) {
  if (std::string complaint = complain_about_size(image.width, image.height); !complaint.empty()) {
    return invalid_input(file, "the picture " + complaint);
  }
  if (image.channels != 1 && image.channels != 3 && image.channels != 4) {
    return invalid_input(file, fmt::format("the picture has {} channels; 1, 3 or 4 can be written", image.channels));
  }
  const std::size_t needed = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                             static_cast<std::size_t>(image.channels);
  if (image.pixels.size() != needed) {
    return invalid_input(file,
                         fmt::format("the picture has {} samples; its size requires {}", image.pixels.size(), needed));
  }
  return {};
}

template <class Sample>
Status write_image(const std::filesystem::path& file, const Image<Sample>& image) {
  if (Status status = check(file, image); !status) return status;
  CheckedFile output(file);  // keeps the errors
  encode(image, [&](const void* bytes, std::size_t size) { return output.write(bytes, size); });
  return image_detail::close_written(output);
}

}  // namespace

Status write_png(const std::filesystem::path& file, const Image8& image) {
  return write_image(file, image);
}

Status write_png(const std::filesystem::path& file, const Image16& image) {
  return write_image(file, image);
}

Result<std::string> encode_png(const Image8& image) {
  if (Status status = check({}, image); !status) return status.error();
  std::string text;
  encode(image, [&](const void* bytes, std::size_t size) {
    text.append(static_cast<const char*>(bytes), size);
    return true;
  });
  return text;
}

}  // namespace ninebit
