#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/tool_paths/plan_tool_path.h"
#include "kinegraph/trajectories/time_scaling.h"

namespace kinegraph {

std::string toolPathStatusName(ToolPathStatus status) {
  static const char* const names[] = {"solved",   "out_of_reach", "in_collision", "no_branch",
                                      "too_fast", "no_transfer",  "out_of_time"};
  return names[int(status)];
}

std::string toolSegmentName(ToolSegment::Kind kind) {
  static const char* const names[] = {"transfer", "approach", "path", "retract"};
  return names[int(kind)];
}

void ToolPathPlan::setParts(std::vector<Part> parts, int dofs) {
  parts_ = std::move(parts);
  dofs_ = dofs;
  duration_ = parts_.empty() ? 0. : parts_.back().begin + parts_.back().timed.duration();
}

const ToolPathPlan::Part& ToolPathPlan::partAt(double t) const {
  if (parts_.empty()) throw ValueError(cat("ToolPathPlan: there is no motion: ", message));
  if (std::isnan(t)) throw ValueError("ToolPathPlan: t is NaN; expected a time in s");
  const auto after = std::upper_bound(parts_.begin(), parts_.end(), t,
                                      [](double time, const Part& part) { return time < part.begin; });
  return after == parts_.begin() ? parts_.front() : *(after - 1);
}

void ToolPathPlan::evalTo(double t, double* q, double* velocity, double* acceleration) const {
  const Part& part = partAt(t);
  const MotionState state = part.timed.eval(t - part.begin);
  std::copy_n(state.q.data(), dofs_, q);
  std::copy_n(state.velocity.data(), dofs_, velocity);
  std::copy_n(state.acceleration.data(), dofs_, acceleration);
}

ToolPlace ToolPathPlan::way(double t) const {
  const Part& part = partAt(t);
  if (part.is_transfer) return {};
  const TimeScaling& scaling = part.timed.scaling();
  const double time = std::clamp(t - part.begin, 0., scaling.duration());
  const ScalingPhase& phase = scaling.phaseAt(time);
  return {part.path, phase.at(time - phase.time).s - part.offset};
}

double ToolPathPlan::speed(double t) const {
  const Part& part = partAt(t);
  return part.is_transfer ? 0. : part.timed.eval(t - part.begin).velocity[dofs_];
}

std::string ToolPathPlan::str() const {
  if (!feasible()) return cat(toolPathStatusName(status), ": ", message);
  const auto count = std::count_if(segments.begin(), segments.end(),
                                   [](const ToolSegment& s) { return s.kind == ToolSegment::Kind::path; });
  return cat("solved: ", count, count == 1 ? " path in " : " paths in ", duration_, " s");
}

}  // namespace kinegraph
