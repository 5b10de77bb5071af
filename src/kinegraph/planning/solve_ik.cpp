#include "kinegraph/planning/solve_ik.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/planning/ik_search.h"

namespace kinegraph {

namespace {

void requireNumbers(const IkTarget& target) {
  using Kind = IkTarget::Kind;
  const auto fail = [&](const char* what) { throw ValueError(cat("solveIk: the ", what, " of the target of frame '", target.frame, "'")); };
  if (target.kind == Kind::direction) {
    if (!(target.axis.norm() > 0.) || !target.axis.allFinite()) fail("axis is zero or not finite in");
    if (!(target.direction.norm() > 0.) || !target.direction.allFinite()) fail("direction is zero or not finite in");
  } else if (!target.pose.p.allFinite() || !target.pose.q.coeffs().allFinite()) {
    fail(target.kind == Kind::pose ? "pose is not finite in" : "position is not finite in");
  }
}

void requireSameKind(const std::vector<IkTarget>& first, const std::vector<IkTarget>& other, std::size_t index) {
  bool same = first.size() == other.size();
  for (std::size_t i = 0; same && i < first.size(); ++i) {
    same = first[i].frame == other[i].frame && first[i].kind == other[i].kind &&
           (first[i].kind != IkTarget::Kind::direction || first[i].axis == other[i].axis);
  }
  if (!same) throw ValueError(cat("solveIkBatch: problem ", index, " has other frames or kinds of targets than problem 0"));
}

/// What the threads of a batch share.
struct Work {
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> stop = false;
  std::mutex mutex;
  std::condition_variable done;
  int running = 0;
  std::exception_ptr error;
};

}  // namespace

IkResult solveIk(const Config& config, const std::vector<IkTarget>& targets, const IkOptions& options, const IkCancel& cancel) {
  for (const IkTarget& target : targets) requireNumbers(target);
  return IkSearch(std::make_shared<IkProblem>(config, targets, options)).solve(targets, cancel);
}

std::vector<IkResult> solveIkBatch(const Config& config, const std::vector<std::vector<IkTarget>>& problems,
                                   const IkOptions& options, int threads, const IkCancel& cancel) {
  if (threads < 1) throw ValueError(cat("solveIkBatch: threads is ", threads, "; expected at least 1"));
  std::vector<IkResult> results(problems.size());
  if (problems.empty()) return results;
  for (std::size_t i = 0; i < problems.size(); ++i) {
    requireSameKind(problems[0], problems[i], i);
    for (const IkTarget& target : problems[i]) requireNumbers(target);
  }
  const auto problem = std::make_shared<const IkProblem>(config, problems[0], options);
  if (threads == 1) {
    IkSearch search(problem);
    for (std::size_t i = 0; i < problems.size(); ++i) results[i] = search.solve(problems[i], cancel);
    return results;
  }
  Work work;
  work.running = std::min(threads, int(problems.size()));
  const auto solveSome = [&] {
    try {
      IkSearch search(problem);
      const IkCancel stopped = [&] { return work.stop.load(std::memory_order_relaxed); };
      for (std::size_t i; !work.stop && (i = work.next++) < problems.size();) results[i] = search.solve(problems[i], stopped);
    } catch (...) {
      const std::lock_guard lock(work.mutex);
      work.error = std::current_exception();
      work.stop = true;
    }
    const std::lock_guard lock(work.mutex);
    --work.running;
    work.done.notify_one();
  };
  std::vector<std::jthread> pool;
  try {
    for (int i = work.running; i > 0; --i) pool.emplace_back(solveSome);
    std::unique_lock lock(work.mutex);
    while (!work.done.wait_for(lock, std::chrono::milliseconds(20), [&] { return work.running == 0; })) {
      lock.unlock();
      if (cancel && cancel()) work.stop = true;
      lock.lock();
    }
  } catch (...) {
    work.stop = true;
    throw;
  }
  if (work.error) std::rethrow_exception(work.error);
  for (IkResult& result : results) {
    if (result.q.size() == 0) result.q = problem->q, result.message = "cancelled before the first attempt";
  }
  return results;
}

}  // namespace kinegraph
