#include <algorithm>
#include <cmath>
#include <cstdint>

#include "kinegraph/planning/ik_lanes.h"

namespace kinegraph {

namespace {

/// Rotations by quarter turns are met often; what misses 0 and 1 by rounding would cost time.
double cleaned(double value) {
  const double nearest = std::round(value);
  return std::abs(value - nearest) < 1e-15 ? nearest : value;
}

void copyTransform(const RigidTransform& X, double* R, double* p) {
  for (int k = 0; k < 9; ++k) R[k] = cleaned(X.R.data()[k]);
  std::copy_n(X.p.data(), 3, p);
}

}  // namespace

IkLaneModel::IkLaneModel(const IkProblem& problem)
    : variables_(problem.variables()),
      rows_(problem.rows),
      lane_link_(problem.program->links.size(), -1),
      lower_(problem.lower.data()),
      upper_(problem.upper.data()),
      longest_(problem.longest.data()) {
  supported_ = rows_ <= kMostLaneRows;
  if (supported_) addLinks(problem);
  if (supported_) addTasks(problem);
}

void IkLaneModel::addLinks(const IkProblem& problem) {
  using Kind = MotionStep::Kind;
  const Program& program = *problem.program;
  std::vector<char> needed(program.links.size(), 0);
  for (const IkProblem::Task& task : problem.tasks) {
    for (int l = program.frame_link[task.frame]; l != 0; l = program.links[l].parent) needed[l] = 1;
  }
  for (std::size_t l = 1; l < program.links.size(); ++l) {
    if (!needed[l]) continue;
    const Program::Link& link = program.links[l];
    LaneModel::Link lane_link{lane_link_[link.parent], int(step_.size()), 0, {}, {}};
    copyTransform(problem.parameters->joint_base[l], lane_link.R, lane_link.p);
    int dof = link.dof;
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
      const MotionStep& step = program.steps[s];
      LaneModel::Step lane_step{0, step.axis, problem.variable[dof], step.sign * link.scale, {}};
      std::copy_n(link.axis.data(), 3, lane_step.about);
      dof += step.dofs();
      if (step.kind == Kind::time) continue;
      if (step.kind == Kind::quaternion || step.kind == Kind::circle) supported_ = false;
      lane_step.kind = step.kind == Kind::translate ? LaneModel::Step::translate
                       : step.kind == Kind::rotate  ? LaneModel::Step::rotate
                                                    : LaneModel::Step::rotateAbout;
      step_.push_back(lane_step);
      ++lane_link.steps;
    }
    lane_link_[l] = int(link_.size());
    link_.push_back(lane_link);
  }
}

void IkLaneModel::addTasks(const IkProblem& problem) {
  for (const IkProblem::Task& task : problem.tasks) {
    LaneModel::Task lane_task{};
    lane_task.placed = task.placed();
    lane_task.directed = task.kind == IkTarget::Kind::direction;
    lane_task.turned = task.kind == IkTarget::Kind::pose || task.kind == IkTarget::Kind::rotation;
    lane_task.link = lane_link_[problem.program->frame_link[task.frame]];
    lane_task.first_column = int(column_.size());
    for (int l = lane_task.link; l >= 0; l = link_[l].parent) {
      for (int s = 0; s < link_[l].steps; ++s) column_.push_back(link_[l].first_step + s);
    }
    lane_task.columns = int(column_.size()) - lane_task.first_column;
    copyTransform(problem.parameters->frame_offset[task.frame], lane_task.R, lane_task.p);
    std::copy_n(task.axis.data(), 3, lane_task.axis);
    task_.push_back(lane_task);
  }
}

LaneModel IkLaneModel::view() const {
  return {int(link_.size()), int(step_.size()), int(task_.size()), variables_, rows_,   link_.data(),
          step_.data(),      task_.data(),      column_.data(),    lower_,     upper_, longest_};
}

LaneBuffer::LaneBuffer(const LaneModel& model, int lanes) {
  const int n = model.variables;
  const std::pair<double**, int> parts[] = {{&memory.x, n},
                                            {&memory.next, n},
                                            {&memory.goal, LaneMemory::kPerGoal * model.tasks},
                                            {&memory.square, 1},
                                            {&memory.distance, 1},
                                            {&memory.angle, 1},
                                            {&memory.pose, LaneMemory::kPerPose * model.links},
                                            {&memory.motion, LaneMemory::kPerStep * model.steps},
                                            {&memory.jacobian, n * model.rows},
                                            {&memory.error, model.rows},
                                            {&memory.keep, n}};
  std::size_t rows = 1;  // one more, to begin at a multiple of the register's size
  for (const auto& [part, size] : parts) rows += size;
  storage_.assign(rows * lanes, 0.);
  const std::uintptr_t width = lanes * sizeof(double);
  double* from = reinterpret_cast<double*>((reinterpret_cast<std::uintptr_t>(storage_.data()) + width - 1) / width * width);
  for (const auto& [part, size] : parts) {
    *part = from;
    from += std::size_t(size) * lanes;
  }
}

}  // namespace kinegraph
