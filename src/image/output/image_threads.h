// OpenEXR's threads, which all files of the process share.
#pragma once

namespace ninebit::image_detail {

// Ends them for as long as it lives.
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
