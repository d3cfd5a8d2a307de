// OpenEXR's thread pool, which OpenImageIO starts for the first EXR file.
#pragma once

namespace ninebit::image_detail {

// Ends the threads of the pool; the destructor starts as many again. A child process has none of its parent's threads,
// and OpenEXR would wait for them there.
class WithoutImageThreads {
 public:
  WithoutImageThreads();
  WithoutImageThreads(const WithoutImageThreads&) = delete;
  WithoutImageThreads& operator=(const WithoutImageThreads&) = delete;
  ~WithoutImageThreads();

 private:
  int threads_;
};

}  // namespace ninebit::image_detail
