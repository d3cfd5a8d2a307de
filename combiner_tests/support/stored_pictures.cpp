#include "combiner_tests/support/stored_pictures.h"

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfEnvmap.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfStandardAttributes.h>
#include <half.h>

#include <stdexcept>
#include <utility>

#include "combiner_tests/support/picture_functions.h"
#include "src/system/process.h"

namespace ninebit::test {
namespace {

StoredPart read_part(Imf::InputPart& part) {
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
  return stored;
}

const PictureFunctions& picture_functions() {
  static const PictureFunctions* const functions = [] {
    void* const library = posix::load_library(NINEBIT_PICTURE_FUNCTIONS);
    if (library == nullptr) throw std::runtime_error(posix::library_error());
    return static_cast<const PictureFunctions*>(posix::find_symbol(library, "ninebit_picture_functions"));
  }();
  return *functions;
}

}  // namespace

std::vector<double> StoredChannel::numbers() const {
  std::vector<double> all(integers.begin(), integers.end());
  all.insert(all.end(), reals.begin(), reals.end());
  all.insert(all.end(), floats.begin(), floats.end());
  return all;
}

std::map<std::string, char> StoredPart::types() const {
  std::map<std::string, char> found;
  for (const auto& [channel_name, channel] : channels) {
    found[channel_name] = !channel.integers.empty() ? 'u' : !channel.reals.empty() ? 'h' : 'f';
  }
  return found;
}

std::vector<StoredPart> read_exr(const std::filesystem::path& file) {
  Imf::MultiPartInputFile input(file.c_str());
  std::vector<StoredPart> parts;
  for (int p = 0; p < input.parts(); ++p) {
    Imf::InputPart part(input, p);
    parts.push_back(read_part(part));
  }
  return parts;
}

Image8 read_png(const std::filesystem::path& file) {
  return picture_functions().read_png(file);
}

Image16 read_png16(const std::filesystem::path& file) {
  return picture_functions().read_png16(file);
}

void write_as(const std::filesystem::path& file, const Image8& image) {
  picture_functions().write_as(file, image);
}

}  // namespace ninebit::test
