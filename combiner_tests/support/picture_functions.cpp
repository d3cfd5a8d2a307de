#include "combiner_tests/support/picture_functions.h"

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <stdexcept>

namespace ninebit::test {
namespace {

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

void write_as(const std::filesystem::path& file, const Image8& image) {
  const auto output = OIIO::ImageOutput::create(file.string());
  const OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
  if (!output || !output->open(file.string(), spec) ||
      !output->write_image(OIIO::TypeDesc::UINT8, image.pixels.data()) || !output->close()) {
    throw std::runtime_error(output ? output->geterror() : OIIO::geterror());
  }
}

}  // namespace

extern "C" {
extern const PictureFunctions ninebit_picture_functions;
const PictureFunctions ninebit_picture_functions{
    [](const std::filesystem::path& file) { return read_png_as<std::uint8_t>(file, OIIO::TypeDesc::UINT8); },
    [](const std::filesystem::path& file) { return read_png_as<std::uint16_t>(file, OIIO::TypeDesc::UINT16); },
    write_as};
}

}  // namespace ninebit::test
