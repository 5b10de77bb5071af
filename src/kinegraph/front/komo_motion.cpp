#include "kinegraph/front/komo_motion.h"

#include <algorithm>

#include "kinegraph/komo/report.h"
#include "kinegraph/viewer/scene_items.h"

namespace kinegraph {

namespace {

bool isConstraint(ObjectiveType type) { return type == ObjectiveType::eq || type == ObjectiveType::ineq; }

/// How much of the constraints is violated in a slice, and the frames that this is about: those that the objectives
/// name, and those that collide, if an objective without frames is violated.
void markViolations(const Komo& komo, const Config& config, const MatrixXd& errors, int t, ShownMotion& motion) {
  constexpr double kTolerance = 1e-3;
  double& violation = motion.violations.emplace_back(0.);
  std::vector<int>& marked = motion.marked.emplace_back();
  for (std::size_t o = 0; t >= 0 && o < komo.objectives().size(); ++o) {
    const Objective& objective = komo.objectives()[o];
    const double error = isConstraint(objective.type) ? errors(t, Eigen::Index(o)) : 0.;
    violation += error;
    if (error < kTolerance) continue;
    for (const std::string& name : objective.frames) marked.push_back(config.getFrame(name).id());
    if (!objective.frames.empty()) continue;
    for (const Config::NearPair& pair : config.getCollisions()) marked.insert(marked.end(), {pair.a, pair.b});
  }
}

}  // namespace

ShownMotion motionOf(const Komo& komo) {
  ShownMotion motion;
  motion.prefix = komo.order();
  const int count = komo.slices() + komo.order();
  motion.seconds = komo.tau() * count;
  const MatrixXd errors = measurePath(komo).per_slice;
  std::vector<VectorXd> states;
  for (int t = -komo.order(); t < komo.slices(); ++t) {
    const Config config = komo.configuration(t);
    motion.poses.push_back(posesOf(config));
    states.push_back(config.getJointState());
    motion.texts.push_back(t < 0 ? "before the path" : sliceErrors(komo, t, errors));
    markViolations(komo, config, errors, t, motion);
  }
  const bool same_dofs =
      std::all_of(states.begin(), states.end(), [&](const VectorXd& q) { return q.size() == states[0].size(); });
  if (same_dofs) {
    motion.q.resize(count, states[0].size());
    for (int i = 0; i < count; ++i) motion.q.row(i) = states[std::size_t(i)];
  }
  for (std::size_t o = 0; o < komo.objectives().size(); ++o) {
    ShownMotion::Trace trace{
        objectiveTag(komo, komo.objectives()[o]), objectiveTypeName(komo.objectives()[o].type), {}};
    trace.values.assign(std::size_t(komo.order()), 0.);
    for (Eigen::Index t = 0; t < errors.rows(); ++t) trace.values.push_back(errors(t, Eigen::Index(o)));
    motion.traces.push_back(std::move(trace));
  }
  return motion;
}

}  // namespace kinegraph
