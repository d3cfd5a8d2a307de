// Large pages for large memory.
#pragma once

#include <cstddef>

namespace ninebit {

// Asks the system for large pages for memory that has not been touched. In a large target each row of a tile lies in
// another page: with small pages the processor looks most of them up anew.
void ask_for_large_pages(const void* memory, std::size_t bytes);

}  // namespace ninebit
