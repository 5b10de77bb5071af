#pragma once

#include <functional>

#include "kinegraph/common/cancellation.h"

namespace kinegraph {

/// Calls work(worker, from, to) for the parts of 0 .. count-1, `part` indices long, until all are done. `threads`
/// workers, numbered from 0, share them; worker 0 is the calling thread. Where the system gives fewer threads, there
/// are fewer workers. `cancellation`, where given, is called on the calling thread before each of its parts, every 20 ms
/// while it waits for the others, and once at the end; it may throw to stop: no part begins then. Where parts throw,
/// the exception of the first of them is passed on; that of `cancellation` comes before them.
void parallelFor(int count, int part, int threads, const std::function<void(int worker, int from, int to)>& work,
                 const CancellationToken& cancellation = {});

}  // namespace kinegraph
