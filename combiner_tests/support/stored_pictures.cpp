#include "combiner_tests/support/stored_pictures.h"

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

#include <stdexcept>
#include <utility>

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

template <class Sample>
Image<Sample> read_png_as(const std::filesystem::path& file, OIIO::TypeDesc type) {
  OIIO::ImageSpec wishes;
  wishes.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::open(file.string(), &wishes);
  if (!input) throw std::runtime_error(OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.format != type) throw std::runtime_error(file.string() + " has samples of another depth");
  Image<Sample> image{spec.width, spec.height, spec.nchannels, {}};
  image.pixels.resize(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
                      static_cast<std::size_t>(spec.nchannels));
  if (!input->read_image(0, 0, 0, spec.nchannels, type, image.pixels.data())) {
    throw std::runtime_error(input->geterror());
  }
  return image;
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
  return read_png_as<std::uint8_t>(file, OIIO::TypeDesc::UINT8);
}

Image16 read_png16(const std::filesystem::path& file) {
  return read_png_as<std::uint16_t>(file, OIIO::TypeDesc::UINT16);
}

void write_as(const std::filesystem::path& file, const Image8& image) {
  const auto output = OIIO::ImageOutput::create(file.string());
  const OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
  if (!output || !output->open(file.string(), spec) ||
      !output->write_image(OIIO::TypeDesc::UINT8, image.pixels.data()) || !output->close()) {
    throw std::runtime_error(output ? output->geterror() : OIIO::geterror());
  }
}

}  // namespace ninebit::test
