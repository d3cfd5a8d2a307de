// OpenEXR's thread pool, shared by all files of the process.
#pragma once

namespace ninebit::image_detail {

// Ends the threads of the pool; the destructor starts them again.
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
