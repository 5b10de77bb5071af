#pragma once

#include <functional>

#include "kinegraph/common/cancellation.h"

namespace kinegraph::inline common_internal {

/// Runs jobs 0 .. count-1 in parallel and passes their results on in this order, so that the outcome does not depend on
/// the number of threads.
///
/// `job(i, cancellation)` stores its result for `take(i)`, which runs on the calling thread. If `take` returns false,
/// the remaining jobs are cancelled. Job i begins when all but `threads - 1` of the jobs before it were taken. With one
/// thread all jobs run on the calling thread, one after the other. An exception of job i is thrown instead of the call
/// of `take(i)`. `cancellation` is asked on the calling thread before it waits for a job, and every 20 ms while it
/// waits; the function throws if it is cancelled. Returns when no job runs any more.
void orderedParallelFor(int count, int threads,
                        const std::function<void(int job, const CancellationToken& cancellation)>& job,
                        const std::function<bool(int job)>& take, const CancellationToken& cancellation = {});

}  // namespace kinegraph::inline common_internal
