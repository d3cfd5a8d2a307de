#include "ninebit/image/image_io.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <utility>

#include "src/image/faults.h"
#include "src/image/posix_file.h"

namespace ninebit {

namespace {

using image_detail::cannot_write;
using image_detail::CheckedFile;
using image_detail::complain_about_size;
using image_detail::invalid_input;

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
    return invalid_input(
        file, fmt::format("the picture has {} samples where its size needs {}", image.pixels.size(), needed));
  }
  return {};
}

// What OpenImageIO itself could not do; errors of the file are the CheckedFile's to tell.
template <class Sample>
std::string encode(CheckedFile& file, const Image<Sample>& image) {
  CheckedProxy proxy(file);
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("png");
  if (!output) return "OpenImageIO cannot write PNG: " + OIIO::geterror();
  constexpr auto kType = sizeof(Sample) == 1 ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::UINT16;
  OIIO::ImageSpec spec(image.width, image.height, image.channels, kType);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  if (!output->set_ioproxy(&proxy)) return "this OpenImageIO cannot write PNG to a stream";
  const bool done =
      output->open(file.path().string(), spec) && output->write_image(kType, image.pixels.data()) && output->close();
  return done ? std::string() : "could not be encoded as PNG: " + output->geterror();
}

template <class Sample>
Status write_image(const std::filesystem::path& file, const Image<Sample>& image) {
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

}  // namespace

Status write_png(const std::filesystem::path& file, const Image8& image) {
  return write_image(file, image);
}

Status write_png(const std::filesystem::path& file, const Image16& image) {
  return write_image(file, image);
}

}  // namespace ninebit
