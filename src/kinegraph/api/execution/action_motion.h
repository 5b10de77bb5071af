#pragma once

#include <algorithm>

#include "kinegraph/task_planning/search/task_plan.h"

namespace kinegraph::inline api_internal {

/// The motion of one action of a plan.
class ActionMotion final : public Trajectory {
 public:
  ActionMotion(const TaskPlan& plan, const RowRange& rows)
      : plan_(plan), begin_(plan.times[rows.begin]), end_(plan.times[rows.end - 1]) {}
  int dimension() const override { return plan_.dimension(); }
  double duration() const override { return end_ - begin_; }
  void evalTo(double t, double* q, double* velocity, double* acceleration) const override {
    plan_.evalTo(std::clamp(begin_ + t, begin_, end_), q, velocity, acceleration);
    if (t > 0. && t < duration()) return;
    std::fill_n(velocity, dimension(), 0.);
  }

 private:
  const TaskPlan& plan_;
  double begin_, end_;
};

}  // namespace kinegraph::inline api_internal
