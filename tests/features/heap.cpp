// Separate from the tests: if the compiler sees both, it warns that `free` releases memory from `new`.
#include "tests/features/heap.h"

#include <cstdlib>
#include <new>

namespace kinegraph {

std::atomic<long> heap_requests = 0;

}  // namespace kinegraph

void* operator new(std::size_t size) {
  ++kinegraph::heap_requests;
  if (void* memory = std::malloc(size ? size : 1)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
