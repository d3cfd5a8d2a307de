// Large pages for large memory.
#pragma once

#include <cstddef>

namespace ninebit {

// Asks the system for large pages for memory that has not been touched. A tile's rows lie in pages of their own, in
// each of the planes; with small pages the processor looks most of them up anew, and the system has to provide them one
// by one.
void ask_for_large_pages(const void* memory, std::size_t bytes);

}  // namespace ninebit
