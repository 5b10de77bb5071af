#pragma once

#include <atomic>

namespace kinegraph {

/// How often this test program has asked for memory so far; its operator new counts.
extern std::atomic<long> heap_requests;

}  // namespace kinegraph
