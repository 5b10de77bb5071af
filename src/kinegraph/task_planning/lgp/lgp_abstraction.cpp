#include "kinegraph/task_planning/lgp/lgp_abstraction.h"

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

std::shared_ptr<Komo> LgpAbstraction::setup_sequence(const Config& scene, int K) {
  begin(K);
  const auto helper = newHelper();
  helper->setup_sequence(scene, K, 0., 1e-2, {.accumulated_collisions = false, .joint_limits = false});
  return helper->komo;
}

std::shared_ptr<Komo> LgpAbstraction::setup_motion(const Config& scene, int K) {
  begin(K);
  const auto helper = newHelper();
  helper->setup_motion(scene, K, kSteps);
  return helper->komo;
}

void LgpAbstraction::add_action_constraints(const std::shared_ptr<Komo>&, double, const TaskAction&,
                                            const TaskAction& action) {
  throw ValueError(cat("action ", planText({action}), " has no constraints; override add_action_constraints"));
}

void LgpAbstraction::add_action_constraints_motion(const std::shared_ptr<Komo>& komo, double time,
                                                   const TaskAction& prev_action, const TaskAction& action) {
  add_action_constraints(komo, time, prev_action, action);
}

void LgpAbstraction::add_all(const std::shared_ptr<Komo>& komo, const std::vector<TaskAction>& plan, bool motion) {
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const TaskAction before = i > 0 ? plan[i - 1] : TaskAction();
    const double time = double(i + 1);
    if (motion)
      add_action_constraints_motion(komo, time, before, plan[i]);
    else
      add_action_constraints(komo, time, before, plan[i]);
  }
  if (explicitCollisions.size() % 2 != 0)
    throw ValueError(cat("explicitCollisions has ", explicitCollisions.size(), " names; expected pairs"));
  for (std::size_t i = 0; i < explicitCollisions.size(); i += 2) {
    komo->addObjective({}, FeatureSymbol::distance, {explicitCollisions[i], explicitCollisions[i + 1]},
                       ObjectiveType::ineq, 1e1);
  }
}

}  // namespace kinegraph
