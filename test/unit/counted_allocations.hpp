// Counts every allocation of the program that includes this, in one source file at most: it
// replaces operator new.
#pragma once

#include <atomic>
#include <cstdlib>
#include <new>

namespace otter_nav::test {
inline std::atomic<int> allocations{0};
}  // namespace otter_nav::test

void* operator new(std::size_t size) {
  ++otter_nav::test::allocations;
  void* memory = std::malloc(size);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  return memory;
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t /*size*/) noexcept {
  std::free(memory);
}
