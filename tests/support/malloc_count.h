#pragma once

// Counts how often memory is asked for. Exactly one source of a test program may include it. All of malloc is counted
// if possible, because Eigen's matrices do not ask operator new.

#include <atomic>
#include <cstdlib>
#include <new>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define COUNTS_MALLOC 1
#endif

namespace {

std::atomic<long> heap_requests = 0;

}  // namespace

#ifdef COUNTS_MALLOC
extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* malloc(std::size_t size) {
  heap_requests.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}
#else
void* operator new(std::size_t size) {
  ++heap_requests;
  if (void* memory = std::malloc(size ? size : 1)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
#endif
