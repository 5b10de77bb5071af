#pragma once

#include <atomic>

namespace kinegraph {

/// Number of memory allocations of this test program so far, counted by its operator new.
extern std::atomic<long> heap_requests;

}  // namespace kinegraph
