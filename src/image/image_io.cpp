#include "ninebit/image/image_io.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <fstream>
#include <memory>
#include <new>
#include <system_error>
#include <utility>

#include "src/image/faults.h"
#include "src/image/png_chunks.h"
#include "src/image/posix_file.h"

namespace ninebit {

namespace {

using image_detail::cannot_write;
using image_detail::CheckedFile;
using image_detail::complain_about_size;
using image_detail::invalid_input;
using image_detail::PngChunks;
using image_detail::read_png_chunks;

// Lets OpenImageIO write into a CheckedFile, which remembers the errors that a caller in between may drop.
class CheckedProxy final : public OIIO::Filesystem::IOProxy {
 public:
  explicit CheckedProxy(CheckedFile& file) : IOProxy(file.path().string(), Write), file_(file) {}
  const char* proxytype() const override { return "ninebit"; }
  int64_t tell() override { return static_cast<int64_t>(file_.tell()); }
  bool seek(int64_t offset) override { return offset >= 0 && file_.seek(static_cast<std::uint64_t>(offset)); }
  size_t write(const void* bytes, size_t size) override { return file_.write(bytes, size) ? size : 0; }

 private:
  CheckedFile& file_;
};

bool channels_are_supported(int channels) {
  return channels == 1 || channels == 3 || channels == 4;
}

std::size_t byte_count(int width, int height, int channels) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(channels);
}

Status check(const std::filesystem::path& file, const Image8& image) {
  if (std::string complaint = complain_about_size(image.width, image.height); !complaint.empty()) {
    return invalid_input(file, "the picture " + complaint);
  }
  if (!channels_are_supported(image.channels)) {
    return invalid_input(file, fmt::format("the picture has {} channels; 1, 3 or 4 can be written", image.channels));
  }
  const std::size_t needed = byte_count(image.width, image.height, image.channels);
  if (image.pixels.size() != needed) {
    return invalid_input(file,
                         fmt::format("the picture has {} bytes where its size needs {}", image.pixels.size(), needed));
  }
  return {};
}

// What OpenImageIO itself could not do; errors of the file are the CheckedFile's to tell.
std::string encode(CheckedFile& file, const Image8& image) {
  CheckedProxy proxy(file);
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("png");
  if (!output) return "OpenImageIO cannot write PNG: " + OIIO::geterror();
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  if (!output->set_ioproxy(&proxy)) return "this OpenImageIO cannot write PNG to a stream";
  const bool done = output->open(file.path().string(), spec) &&
                    output->write_image(OIIO::TypeDesc::UINT8, image.pixels.data()) && output->close();
  return done ? std::string() : "could not be encoded as PNG: " + output->geterror();
}

// Empty, or why the PNG could not be decoded.
std::string decode(const std::string& png, Image8& image) {
  OIIO::Filesystem::IOMemReader memory(png.data(), png.size());
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create("png");
  if (!input) return "OpenImageIO cannot read PNG: " + OIIO::geterror();
  if (!input->set_ioproxy(&memory)) return "this OpenImageIO cannot read PNG from memory";
  OIIO::ImageSpec spec;
  OIIO::ImageSpec wishes;
  wishes.attribute("oiio:UnassociatedAlpha", 1);
  if (!input->open("memory.png", spec, wishes)) return "cannot be read as PNG: " + input->geterror();
  if (!channels_are_supported(spec.nchannels)) {
    return fmt::format("has {} channels; 1, 3 or 4 are expected", spec.nchannels);
  }
  image = {spec.width, spec.height, spec.nchannels, {}};
  image.pixels.resize(byte_count(image.width, image.height, image.channels));
  const bool done = input->read_image(0, 0, 0, image.channels, OIIO::TypeDesc::UINT8, image.pixels.data());
  return done ? std::string() : "cannot be read as PNG: " + input->geterror();
}

}  // namespace

Status write_png(const std::filesystem::path& file, const Image8& image) {
  if (Status status = check(file, image); !status) return status;
  CheckedFile output(file);
  std::string complaint;
  try {
    if (!output.failed()) complaint = encode(output, image);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    complaint = fmt::format("could not be encoded as PNG: {}", error.what());
  }
  if (!complaint.empty() && !output.failed()) return cannot_write(file, std::move(complaint));
  return output.close();
}

Result<Image8> read_png(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) return invalid_input(file, "is a folder");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return invalid_input(file, "cannot be opened");
  const PngChunks chunks = read_png_chunks(stream);
  if (!chunks.complaint.empty()) return invalid_input(file, chunks.complaint);
  try {
    Image8 image;
    std::string complaint = decode(chunks.bytes, image);
    if (!complaint.empty()) return invalid_input(file, std::move(complaint));
    return image;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& fault) {
    return invalid_input(file, fmt::format("cannot be read as PNG: {}", fault.what()));
  }
}

}  // namespace ninebit
