#include <algorithm>

#include "kinegraph/ik/ik_lanes.h"
#include "kinegraph/kinematics/lane_storage.h"

namespace kinegraph::inline ik_internal {

namespace {

std::vector<int> framesOf(const IkProblem& problem) {
  std::vector<int> frames;
  for (const IkProblem::Task& task : problem.tasks) {
    if (task.inLanes()) frames.push_back(task.frame);
  }
  return frames;
}

}  // namespace

IkLaneModel::IkLaneModel(const IkProblem& problem)
    : rows_(problem.rows),
      links_(*problem.model, *problem.parameters, framesOf(problem), problem.variable, problem.variables()),
      lower_(problem.lower.data()),
      upper_(problem.upper.data()),
      longest_(problem.longest.data()) {
  const LaneModel links = links_.view();
  supported_ = rows_ <= kMostIkRows && std::ranges::all_of(problem.tasks, &IkProblem::Task::inLanes);
  for (int l = 1; l < links.links; ++l) {
    for (int s = links.link[l].first_step; s < links.link[l].first_step + links.link[l].steps; ++s) {
      if (kMotionFacts[int(links.step[s].kind)].effect == MotionFacts::Effect::orients) supported_ = false;
    }
  }
  if (supported_) addTasks(problem);
}

void IkLaneModel::addTasks(const IkProblem& problem) {
  for (const IkProblem::Task& task : problem.tasks) {
    IkKernelModel::Task lane_task{};
    lane_task.has_position = task.hasPosition();
    lane_task.has_direction = task.hasDirection();
    lane_task.has_rotation = task.hasRotation();
    lane_task.frame = links_.place(*problem.model, *problem.parameters, task.frame);
    lane_task.first_column = int(column_.size());
    for (int index : links_.chain(lane_task.frame.link)) {
      column_.push_back({index, links_.column(index).variable, links_.column(index).is_rotation});
    }
    lane_task.columns = int(column_.size()) - lane_task.first_column;
    std::copy_n(task.target.axis.data(), 3, lane_task.axis);
    task_.push_back(lane_task);
  }
}

IkKernelModel IkLaneModel::view() const {
  return {links_.view(), int(task_.size()), rows_, task_.data(), column_.data(), lower_, upper_, longest_};
}

LaneBuffer::LaneBuffer(const IkKernelModel& model, int lanes) {
  const auto size = [](int count) { return std::size_t(count); };
  const int n = model.variables();
  layOutLanes(storage_, lanes,
              {{&memory.x, size(n)},
               {&memory.next, size(n)},
               {&memory.goal, size(IkKernelMemory::kPerGoal * model.tasks)},
               {&memory.square, 1},
               {&memory.distance, 1},
               {&memory.angle, 1},
               {&memory.pose, size(LaneMemory::kPerPose * model.links.links)},
               {&memory.motion, size(LaneMemory::kPerColumn * model.links.columns)},
               {&memory.jacobian, size(n * model.rows)},
               {&memory.error, size(model.rows)},
               {&memory.keep, size(n)}});
  setWorld(memory.pose, lanes);
}

}  // namespace kinegraph::inline ik_internal
