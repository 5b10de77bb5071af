#pragma once

#include <functional>

#include "kinegraph/common/cancellation.h"

namespace kinegraph {

/// Runs jobs 0 .. count-1 and has their results taken in this order, computed ahead by threads, so that what comes out
/// does not depend on how many there are. `job(i, stopped)` leaves its result where `take(i)`, on the calling thread,
/// finds it; once `take` is false the others are not wanted. No job begins before all but `threads - 1` of the ones
/// before it were taken. With one thread all run on the calling thread, one after the other. Where a job throws, the
/// exception is passed on in place of `take(i)`. `cancellation`, where given, is asked on the calling thread before it waits for a
/// job, and every 20 ms while it waits; it may throw to end it. Returns when no job runs any more.
void orderedParallelFor(int count, int threads,
                        const std::function<void(int job, const CancellationToken& stopped)>& job,
                        const std::function<bool(int job)>& take, const CancellationToken& cancellation = {});

}  // namespace kinegraph
