#include "kinegraph/ik/ik_lanes.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/math/lane_widths.h"

namespace kinegraph::inline ik_internal {

IkLanes::IkLanes(std::shared_ptr<const IkProblem> problem, int width)
    : problem_(std::move(problem)),
      model_(*problem_),
      view_(model_.view()),
      kernel_(ikKernel(checkedLaneWidth(width))),
      search_(problem_),
      buffer_(view_, kernel_.lanes),
      memory_(buffer_.memory),
      open_(kernel_.lanes),
      lanes_(kernel_.lanes),
      start_(problem_->variables()) {}

void IkLanes::solve(const std::vector<IkTarget>* problems, const VectorXd* starts, int count, IkResult* results,
                    std::atomic<int>& done, const CancellationToken& cancellation) {
  problems_ = problems;
  starts_ = starts;
  results_ = results;
  done_ = &done;
  cancellation_ = &cancellation;
  count_ = count;
  next_ = 0;
  cancelled_ = false;
  if (!model_.supported()) {
    for (int i = 0; i < count; ++i, ++done) results[i] = search_.solve(problems[i], cancellation, startOf(i));
    return;
  }
  // All lanes step together. Finished attempts are replaced between the steps.
  for (int run = 0;; ++run) {
    if (run % 16 == 0 && cancellation()) cancelled_ = true;
    bool busy = false;
    for (int l = 0; l < kernel_.lanes && !cancelled_; ++l) busy = lanes_[l].open >= 0 || fill(l) || busy;
    if (!busy) break;
    kernel_.run(view_, memory_);
    for (int l = 0; l < kernel_.lanes; ++l) {
      if (lanes_[l].open >= 0) advance(l);
    }
  }
  for (int o = 0; o < kernel_.lanes; ++o) {
    if (open_[o].problem >= 0) close(o, true);
  }
  for (; next_ < count_; ++next_) {  // cancelled before their first attempt
    IkJob job;
    search_.open(job, problems_[next_], startOf(next_));
    results_[next_] = search_.finish(job, true, cancellation);
  }
}

/// Gives an idle lane an attempt: of an open problem without a lane, else of a new problem, else of the open problem
/// with the fewest attempts started. Returns false if there is none.
bool IkLanes::fill(int lane) {
  int chosen = -1;
  for (int o = 0; o < kernel_.lanes; ++o) {
    const Open& open = open_[o];
    if (open.problem < 0 || open.next_attempt >= problem_->options.attempts) continue;
    const bool waits = std::ranges::find(lanes_, o, &Lane::open) == lanes_.end();
    if (waits) return start(lane, o), true;
    if (chosen < 0 || open.next_attempt < open_[chosen].next_attempt) chosen = o;
  }
  if (next_ < count_) {
    chosen = int(std::ranges::find(open_, -1, &Open::problem) - open_.begin());
    Open& open = open_[chosen];
    open.problem = next_++;
    open.next_attempt = 0;
    open.ended.clear();
    search_.open(open.job, problems_[open.problem], startOf(open.problem));
  }
  if (chosen >= 0) start(lane, chosen);
  return chosen >= 0;
}

void IkLanes::start(int lane, int open) {
  lanes_[lane] = {open, open_[open].next_attempt++, 0, 1e300};
  problem_->startingPoint(lanes_[lane].attempt, start_.data(), open_[open].job.start);
  for (int v = 0; v < view_.variables(); ++v) at(memory_.x, v, lane) = start_[v];
  const std::vector<IkGoal>& goals = open_[open].job.goals;
  for (int t = 0; t < view_.tasks; ++t) {
    double* to = memory_.goal + t * IkKernelMemory::kPerGoal * kernel_.lanes;
    for (int k = 0; k < 9; ++k) at(to, k, lane) = goals[t].R.data()[k];
    for (int k = 0; k < 3; ++k) {
      at(to, 9 + k, lane) = goals[t].p[k];
      at(to, 12 + k, lane) = goals[t].t1[k];
      at(to, 15 + k, lane) = goals[t].t2[k];
    }
  }
}

/// Checks the errors of a lane after the kernel ran, and accepts its step.
void IkLanes::advance(int lane) {
  const IkOptions& options = problem_->options;
  Lane& state = lanes_[lane];
  const double distance = memory_.distance[lane], angle = memory_.angle[lane], square = memory_.square[lane];
  const int step = state.evals++;
  if (distance <= options.position_tolerance * options.position_tolerance && angle <= options.rotation_tolerance)
    return end(lane, true);
  if (step == options.steps || search_.stalls(step, square, state.before)) return end(lane, false);
  for (int v = 0; v < view_.variables(); ++v) at(memory_.x, v, lane) = at(memory_.next, v, lane);
}

void IkLanes::end(int lane, bool met) {
  const Lane state = lanes_[lane];
  lanes_[lane].open = -1;
  Open& open = open_[state.open];
  open.ended.push_back({state.attempt,
                        {met, std::sqrt(memory_.distance[lane]) + memory_.angle[lane], state.evals},
                        VectorXd(view_.variables())});
  for (int v = 0; v < view_.variables(); ++v) open.ended.back().x[v] = at(memory_.x, v, lane);
  assessEnded(state.open);
}

/// Attempts end in any order but are assessed in the order of their numbers, so that the answer equals that of a search
/// without lanes.
void IkLanes::assessEnded(int index) {
  Open& open = open_[index];
  for (;;) {
    const auto next = std::ranges::find(open.ended, open.job.attempts, &Ended::attempt);
    if (next == open.ended.end()) return;
    const bool decided = search_.assess(open.job, next->x, next->approach, *cancellation_);
    if (decided) return close(index, false);
    open.ended.erase(next);
  }
}

void IkLanes::close(int index, bool cancelled) {
  Open& open = open_[index];
  results_[open.problem] = search_.finish(open.job, cancelled, *cancellation_);
  if (!cancelled) ++*done_;
  open.problem = -1;
  for (Lane& lane : lanes_) {  // abandons attempts that were started speculatively
    if (lane.open == index) lane.open = -1;
  }
}

}  // namespace kinegraph::inline ik_internal
