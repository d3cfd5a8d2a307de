#include "src/image/openimageio/image_threads.h"

#include <ImfThreading.h>

namespace ninebit::image_detail {

WithoutImageThreads::WithoutImageThreads() : threads_(Imf::globalThreadCount()) {
  if (threads_ > 0) Imf::setGlobalThreadCount(0);
}

WithoutImageThreads::~WithoutImageThreads() {
  if (threads_ > 0) Imf::setGlobalThreadCount(threads_);
}

}  // namespace ninebit::image_detail
