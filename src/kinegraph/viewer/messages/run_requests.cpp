#include "kinegraph/viewer/messages/run_requests.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/viewer/messages/commands.h"

namespace kinegraph::inline viewer_internal {

namespace {

constexpr int kPause = 1, kGoOn = 2, kStep = 3, kReset = 4;  // as in viewer/src/run.ts
constexpr int kMaxSteps = 1000;                              ///< pending
constexpr double kFar = 1e6;                                 ///< m: positions beyond are rejected

bool isPoint(const std::vector<double>& numbers) {
  return numbers.size() == 3 &&
         std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::abs(x) <= kFar; });
}

}  // namespace

bool RunRequests::apply(const RunCommand& command) {
  switch (command.what) {
    case kPause:
      paused = true;
      return true;
    case kGoOn:
      paused = false;
      steps = 0;
      return true;
    case kStep:
      paused = true;
      steps = std::min(steps + 1, kMaxSteps);
      return true;
    case kReset:
      reset = true;
      return true;
    default:
      return false;
  }
}

bool RunRequests::apply(const PerturbCommand& command) {
  if (command.point.empty() && command.target.empty()) {
    perturbation.reset();
    return true;
  }
  if (!isPoint(command.point) || !isPoint(command.target)) return false;
  perturbation = {command.structure, command.frame, Vector3d(command.point.data()), Vector3d(command.target.data())};
  return true;
}

RunRequests RunRequests::take() {
  const RunRequests now = *this;
  reset = false;
  if (steps > 0) --steps;
  return now;
}

}  // namespace kinegraph::inline viewer_internal
