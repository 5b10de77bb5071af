#pragma once

#include <functional>

namespace kinegraph {

/// Calls work(worker, from, to) for the parts of 0 .. count-1, `part` indices long, until all are done. `threads` workers,
/// numbered from 0, share them; worker 0 is the calling thread. `between`, where given, is called on the calling thread
/// before each of its parts and may throw to stop. Where parts throw, the exception of the first of them is passed on.
void forParts(int count, int part, int threads, const std::function<void(int worker, int from, int to)>& work,
              const std::function<void()>& between = {});

}  // namespace kinegraph
