#pragma once

#include <functional>

#include "kinegraph/common/cancellation.h"

namespace kinegraph::inline common_internal {

/// Calls work(worker, from, to) for consecutive parts of 0 .. count-1 of `part` indices each, in parallel.
///
/// `threads` workers, numbered from 0, share the parts; worker 0 is the calling thread. If the system provides fewer
/// threads, there are fewer workers. `cancellation` is asked on the calling thread before each of its parts, every 20
/// ms while it waits for others, and at the end. If it is cancelled or throws, no further part begins, and the function
/// throws. Otherwise it throws the exception of the first part that failed.
void parallelFor(int count, int part, int threads, const std::function<void(int worker, int from, int to)>& work,
                 const CancellationToken& cancellation = {});

}  // namespace kinegraph::inline common_internal
