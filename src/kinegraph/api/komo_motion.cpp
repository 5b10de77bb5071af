#include "kinegraph/api/komo_motion.h"

#include <algorithm>

#include "kinegraph/komo/komo.h"
#include "kinegraph/komo/objective.h"
#include "kinegraph/komo/objective_list.h"
#include "kinegraph/viewer/scene_items.h"

namespace kinegraph::inline api_internal {

namespace {

bool isConstraint(ObjectiveType type) { return type == ObjectiveType::eq || type == ObjectiveType::ineq; }

bool isCollision(const FeatureSource& feature) {
  return feature == FeatureSymbol::accumulatedCollisions || feature == FeatureSymbol::pairCollisions;
}

/// Returns whether a feature measures the distance of two frames' shapes.
bool isOfPair(const FeatureSource& feature) {
  using S = FeatureSymbol;
  constexpr S kPairs[] = {S::distance,         S::pairCollision_negScalar, S::pairCollision_vector,
                          S::pairCollision_p1, S::pairCollision_p2,        S::pairCollision_normal};
  return std::any_of(std::begin(kPairs), std::end(kPairs), [&](S symbol) { return feature == symbol; });
}

/// Returns the pairs of a collision objective that are closer than it allows.
std::vector<NearLine> nearPairs(const Objective& objective, const Config& config) {
  constexpr double kMinPenetration = 1e-4;  // m: smaller penetrations count as zero
  constexpr std::size_t kMaxLines = 100;
  const bool aims_apart = objective.feature == FeatureSymbol::pairCollisions && objective.target.size() == 1;
  const double margin = std::max(objective.margin, aims_apart ? -objective.target[0] : 0.);
  const State& state = config.state();
  const auto concerns = [&](int frame) {
    const std::string& name = state.model().frame_name[std::size_t(frame)];
    return std::find(objective.frames.begin(), objective.frames.end(), name) != objective.frames.end();
  };
  std::vector<NearLine> lines;
  for (const auto& [a, b, distance] : config.getCollisions(margin - kMinPenetration)) {
    if (!state.model().movesApart(a, b) || lines.size() == kMaxLines) continue;
    if (objective.frames.empty() || concerns(a) || concerns(b)) lines.push_back(nearLine(state, a, b));
  }
  return lines;
}

/// Marks the constraint violations of a slice and their causes: the frames of the objectives, or the touching pairs of
/// collision objectives.
void markViolations(const Komo& komo, const Config& config, const MatrixXd& errors, int t, ShownMotion& motion) {
  constexpr double kTolerance = 1e-3;
  double& violation = motion.violations.emplace_back(0.);
  std::vector<int>& marked = motion.marked.emplace_back();
  std::vector<NearLine>& touching = motion.touching.emplace_back();
  for (std::size_t o = 0; t >= 0 && o < komo.objectives().size(); ++o) {
    const Objective& objective = komo.objectives()[o];
    const double error = isConstraint(objective.type) ? errors(t, Eigen::Index(o)) : 0.;
    violation += error;
    if (error < kTolerance) continue;
    std::vector<int> frames;
    for (const std::string& name : objective.frames) frames.push_back(config.getFrame(name).id());
    if (isCollision(objective.feature)) {
      for (NearLine& line : nearPairs(objective, config)) touching.push_back(std::move(line));
    } else if (isOfPair(objective.feature)) {
      touching.push_back(nearLine(config.state(), frames[0], frames[1]));
    } else {
      marked.insert(marked.end(), frames.begin(), frames.end());
    }
  }
}

}  // namespace

ShownMotion motionOf(const Komo& komo) {
  ShownMotion motion;
  motion.prefix = komo.order();
  const int count = komo.slices() + komo.order();
  if (count == 0) throw Error("KOMO: a view needs a configuration and a timing; call setConfig and setTiming first");
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

}  // namespace kinegraph::inline api_internal
