#include "combiner_tests/image/read_back.h"

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfEnvmap.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfStandardAttributes.h>
#include <OpenImageIO/imageio.h>
#include <half.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace image_test {

namespace fs = std::filesystem;

TempFolder::TempFolder() {
  std::string name = (fs::temp_directory_path() / "ninebit-image-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make " + name);
  path_ = name;
}

TempFolder::~TempFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::vector<std::string> TempFolder::names() const {
  std::vector<std::string> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(path_)) {
    found.push_back(entry.path().filename().string());
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::string read_bytes(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void write_bytes(const fs::path& file, std::string_view bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

std::vector<StoredPart> read_exr(const fs::path& file) {
  Imf::MultiPartInputFile input(file.c_str());
  std::vector<StoredPart> parts;
  for (int p = 0; p < input.parts(); ++p) {
    Imf::InputPart part(input, p);
    const Imf::Header& header = part.header();
    const Imath::Box2i window = header.dataWindow();
    StoredPart stored;
    stored.name = header.hasName() ? header.name() : std::string();
    stored.width = window.max.x - window.min.x + 1;
    stored.height = window.max.y - window.min.y + 1;
    stored.zip = header.compression() == Imf::ZIP_COMPRESSION;
    stored.cube = Imf::hasEnvmap(header) && Imf::envmap(header) == Imf::ENVMAP_CUBE;
    const auto count = static_cast<std::size_t>(stored.width) * static_cast<std::size_t>(stored.height);
    std::map<std::string, std::vector<half>> halves;
    Imf::FrameBuffer frame;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
      const auto type = channel.channel().type;
      StoredChannel& target = stored.channels[channel.name()];
      void* samples = nullptr;
      if (type == Imf::HALF) {
        halves[channel.name()].resize(count);
        samples = halves[channel.name()].data();
      } else if (type == Imf::FLOAT) {
        target.floats.resize(count);
        samples = target.floats.data();
      } else {
        target.integers.resize(count);
        samples = target.integers.data();
      }
      frame.insert(channel.name(), Imf::Slice::Make(type, samples, window));
    }
    part.setFrameBuffer(frame);
    part.readPixels(window.min.y, window.max.y);
    for (const auto& [name, samples] : halves) stored.channels[name].reals.assign(samples.begin(), samples.end());
    parts.push_back(std::move(stored));
  }
  return parts;
}

namespace {

template <class Sample>
ninebit::Image<Sample> read_png_as(const fs::path& file, OIIO::TypeDesc type) {
  OIIO::ImageSpec wishes;
  wishes.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::open(file.string(), &wishes);
  if (!input) throw std::runtime_error(OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.format != type) throw std::runtime_error("the file has samples of another depth");
  ninebit::Image<Sample> image{spec.width, spec.height, spec.nchannels, {}};
  image.pixels.resize(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
                      static_cast<std::size_t>(spec.nchannels));
  if (!input->read_image(0, 0, 0, spec.nchannels, type, image.pixels.data())) {
    throw std::runtime_error(input->geterror());
  }
  return image;
}

}  // namespace

ninebit::Image8 read_png(const fs::path& file) {
  return read_png_as<std::uint8_t>(file, OIIO::TypeDesc::UINT8);
}

ninebit::Image16 read_png16(const fs::path& file) {
  return read_png_as<std::uint16_t>(file, OIIO::TypeDesc::UINT16);
}

std::vector<std::string> png_chunks(std::string_view png) {
  std::vector<std::string> names;
  std::size_t at = 8;
  while (at + 12 <= png.size()) {
    std::size_t size = 0;
    for (std::size_t b = 0; b < 4; ++b) size = (size << 8) | static_cast<std::uint8_t>(png[at + b]);
    names.emplace_back(png.substr(at + 4, 4));
    at += 12 + size;
  }
  return names;
}

FileSizeLimit::FileSizeLimit(std::uint64_t bytes) {
  handler_before_ = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit = {};
  if (::getrlimit(RLIMIT_FSIZE, &limit) != 0) throw std::runtime_error("getrlimit failed");
  before_ = limit.rlim_cur;
  limit.rlim_cur = bytes;
  if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) throw std::runtime_error("setrlimit failed");
}

FileSizeLimit::~FileSizeLimit() {
  rlimit limit = {};
  if (::getrlimit(RLIMIT_FSIZE, &limit) == 0) {
    limit.rlim_cur = before_;
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  std::signal(SIGXFSZ, handler_before_);
}

}  // namespace image_test
