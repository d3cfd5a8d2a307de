#include <IexBaseExc.h>
#include <ImfEnvmap.h>
#include <ImfIO.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfThreading.h>
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <future>
#include <new>
#include <set>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "ninebit/image/image_io.h"
#include "src/image/output/exr_blocks.h"
#include "src/image/output/faults.h"
#include "src/image/output/image_threads.h"
#include "src/system/checked_file.h"
#include "src/system/process.h"

namespace ninebit {

namespace {

using image_detail::cannot_write;
using image_detail::complain_about_size;
using image_detail::ExrBlocks;
using image_detail::Flips;
using image_detail::invalid_input;
using image_detail::pixel_type;
using posix::CheckedFile;

constexpr std::size_t kLongestName = 255;  // of a channel, by the file format
// Faster than OpenEXR's default level 4: ×1.7 on flat layers, at no larger size; ×1.1 on noisy layers.
constexpr int kExrZipLevel = 2;

// OpenEXR ignores errors in its destructors, which write the offset tables; the CheckedFile keeps them.
class CheckedStream final : public Imf::OStream {
 public:
  explicit CheckedStream(CheckedFile& file) : OStream(file.path().c_str()), file_(file) {}
  void write(const char bytes[], int size) override {
    if (size < 0 || !file_.write(bytes, static_cast<std::size_t>(size))) fail();
  }
  std::uint64_t tellp() override { return file_.tell(); }
  void seekp(std::uint64_t position) override {
    if (!file_.seek(position)) fail();
  }

 private:
  [[noreturn]] static void fail() { throw Iex::BaseExc("the file could not be written"); }
  CheckedFile& file_;
};

void compress(Imf::Header& header) {
  header.compression() = Imf::ZIP_COMPRESSION;
  header.zipCompressionLevel() = kExrZipLevel;
}

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
      return a.name == b.name && pixel_type(a) == pixel_type(b);
    };
    if (!std::equal(faces[face].begin(), faces[face].end(), faces[0].begin(), faces[0].end(), alike)) {
      return fmt::format("cube face {} has other channels than face 0", face);
    }
  }
  return {};
}

// OpenEXR converts exceptions of its threads to texts. Compressing rows in memory fails only if memory runs out.
bool lacks_memory(std::string_view what) {
  return what.find("bad_alloc") != std::string_view::npos || what.find("(zlib) failed") != std::string_view::npos;
}

// Runs write(stream) on a new file; leaves no incomplete file behind.
template <class Write>
Status write_checked(const std::filesystem::path& file, const Write& write) {
  CheckedFile output(file);
  try {
    if (!output.failed()) {
      CheckedStream stream(output);
      write(stream);
    }
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    if (output.failed()) return image_detail::close_written(output);
    if (lacks_memory(error.what())) throw std::bad_alloc();
    return cannot_write(file, fmt::format("could not be written as EXR: {}", error.what()));
  }
  return image_detail::close_written(output);
}

// Whether this many additional threads can run at once. In a limited address space none is tried, because it is unknown
// how much memory each thread leaves for the next.
bool can_start(int threads) {
  if (posix::is_address_space_limited()) return false;
  std::promise<void> end;
  const std::shared_future<void> ended = end.get_future().share();
  std::vector<std::thread> started;
  bool all = true;
  try {
    started.reserve(static_cast<std::size_t>(threads));
    for (int i = 0; i < threads; ++i) started.emplace_back([&ended] { ended.wait(); });
  } catch (const std::exception&) {
    all = false;
  }
  end.set_value();
  for (std::thread& thread : started) thread.join();
  return all;
}

}  // namespace

Status write_exr_parts(const std::filesystem::path& file, std::span<const ExrPart> parts) {
  if (std::string complaint = complain_about_parts(parts); !complaint.empty()) {
    return invalid_input(file, std::move(complaint));
  }
  return write_checked(file, [&](Imf::OStream& stream) {
    // The file format requires one display window for all parts: that of the first.
    const Imath::Box2i display(Imath::V2i(0, 0), Imath::V2i(parts[0].width - 1, parts[0].height - 1));
    std::vector<Imf::Header> headers;
    headers.reserve(parts.size());
    for (const ExrPart& part : parts) {
      const Imath::Box2i data(Imath::V2i(0, 0), Imath::V2i(part.width - 1, part.height - 1));
      Imf::Header& header = headers.emplace_back(display, data);
      compress(header);
      header.setName(part.name);
      header.setType(Imf::SCANLINEIMAGE);
      image_detail::add_channels(header, part.channels);
    }
    Imf::MultiPartOutputFile output(stream, headers.data(), static_cast<int>(headers.size()));
    for (std::size_t p = 0; p < parts.size(); ++p) {
      Imf::OutputPart target(output, static_cast<int>(p));
      ExrBlocks(parts[p].width, parts[p].height, parts[p].channels, Flips{}).write(target, 0);
    }
  });
}

Status write_exr_cube(const std::filesystem::path& file, int size, std::span<const std::vector<ExrChannel>, 6> faces) {
  if (std::string complaint = complain_about_faces(size, faces); !complaint.empty()) {
    return invalid_input(file, std::move(complaint));
  }
  return write_checked(file, [&](Imf::OStream& stream) {
    Imf::Header header(size, 6 * size);
    compress(header);
    Imf::addEnvmap(header, Imf::ENVMAP_CUBE);
    image_detail::add_channels(header, faces[0]);
    Imf::OutputFile output(stream, header);
    for (int face = 0; face < 6; ++face) {
      // ARB_texture_cube_map views the faces from inside a left-handed cube, OpenEXR from outside a right-handed one:
      // columns are reversed on the four sides, rows on +Y and -Y.
      const bool is_y = face == Imf::CUBEFACE_POS_Y || face == Imf::CUBEFACE_NEG_Y;
      ExrBlocks(size, size, faces[static_cast<std::size_t>(face)], Flips{!is_y, is_y}).write(output, face * size);
    }
  });
}

void set_image_threads(int threads) {
  try {
    // OpenEXR aborts the program if a thread of its pool cannot be started, so this is tried first.
    Imf::setGlobalThreadCount(threads > 1 && can_start(threads) ? threads : 0);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    // A smaller pool only costs time.
  }
}

namespace image_detail {

WithoutImageThreads::WithoutImageThreads() : threads_(Imf::globalThreadCount()) {
  if (threads_ > 0) Imf::setGlobalThreadCount(0);
}

WithoutImageThreads::~WithoutImageThreads() {
  if (threads_ > 0) set_image_threads(threads_);
}

}  // namespace image_detail

}  // namespace ninebit
