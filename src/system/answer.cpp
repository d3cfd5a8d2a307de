#include "src/system/answer.h"

#include <unistd.h>

#include <cerrno>
#include <new>

namespace ninebit::posix {

void AnswerWriter::put(const void* bytes, std::size_t size) {
  const auto* from = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t done = ::write(descriptor_, from, size);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) throw std::bad_alloc();  // the answer is a file in memory with a size limit
    from += done;
    size -= static_cast<std::size_t>(done);
  }
}

AnswerReader::~AnswerReader() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool AnswerReader::text(std::string& one) {
  std::uint64_t count = 0;
  if (!value(count) || count > left_) return fail();
  one.resize(static_cast<std::size_t>(count));
  return get(one.data(), one.size());
}

bool AnswerReader::get(void* bytes, std::size_t size) {
  if (size > left_) return fail();
  auto* to = static_cast<char*>(bytes);
  while (size > 0) {
    const ssize_t done = ::read(descriptor_, to, size);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return fail();
    to += done;
    size -= static_cast<std::size_t>(done);
    left_ -= static_cast<std::uint64_t>(done);
  }
  return true;
}

}  // namespace ninebit::posix
