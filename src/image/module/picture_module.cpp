// The module ninebit_pictures: OpenImageIO's readers, which the program loads when it needs them.
#include "src/image/texture/picture_module.h"

using namespace ninebit::image_detail;

extern "C" __attribute__((visibility("default"))) const char* ninebit_pictures_build() {
  return kPictureModuleBuild;
}

extern "C" __attribute__((visibility("default"))) void ninebit_pictures_read(const PictureSource& source,
                                                                             ninebit::Result<FileTexture>& out) {
  out = read_picture(source);
}
