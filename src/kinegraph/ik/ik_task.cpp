#include "kinegraph/ik/ik_task.h"

#include <algorithm>
#include <set>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/random.h"
#include "kinegraph/common/text.h"
#include "kinegraph/features/eval.h"
#include "kinegraph/features/make_residual.h"
#include "kinegraph/features/masses.h"
#include "kinegraph/kinematics/chains.h"

namespace kinegraph {

namespace {

constexpr char kCenterOfMass[] = "centerOfMass";

constexpr int kSamples = 3;         // random configurations; a dof counts if it has an effect in one of them
constexpr double kNoEffect = 1e-9;  // largest entry of a Jacobian that is attributed to rounding

std::shared_ptr<const Residual> makeFeatureResidual(const State& scene, const IkTarget& target) {
  const IkFeature& feature = *target.feature;
  if (!(feature.tolerance > 0.))
    throw ValueError(cat("solveIk: the tolerance of ", feature.source.name(), " is ", feature.tolerance,
                         "; expected a positive number"));
  auto residual =
      std::make_shared<Residual>(makeResidual(scene, feature.source, feature.frames, feature.scale, target.value));
  if (residual->order() > 0)
    throw ValueError(cat("solveIk: ", feature.source.name(), " needs ", residual->order() + 1,
                         " configurations in time; expected a feature of one configuration, such as position"));
  return residual;
}

std::string quoted(const std::vector<std::string>& frames) {
  std::vector<std::string> quotes;
  for (const std::string& frame : frames) quotes.push_back(cat("'", frame, "'"));
  return join(quotes);
}

/// Returns those of `dofs` that influence the residual in at least one of several random configurations.
std::vector<int> effective(const std::vector<int>& dofs, const State& scene, Residual residual) {
  const KinematicModel& model = scene.model();
  State state = scene;
  Rng rng(0);
  std::vector<char> acts(std::size_t(model.dofs), 0);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> J(residual.rows(), model.dofs);
  VectorXd y(residual.rows()), q = scene.q();
  for (int probe = 0; probe < kSamples; ++probe) {
    for (const int dof : dofs) {
      const double at = scene.q()[dof];
      q[dof] = rng.uniform(std::max(model.lower[dof], at - 1.), std::min(model.upper[dof], at + 1.));
    }
    state.setJoints(q.data());
    J.setZero();
    JacobianRows rows = J;
    const State* at = &state;
    residual.eval({&at, 1}, 1., y, &rows);
    for (const int dof : dofs) acts[std::size_t(dof)] |= J.col(dof).cwiseAbs().maxCoeff() > kNoEffect;
  }
  std::vector<int> result;
  std::ranges::copy_if(dofs, std::back_inserter(result), [&](int dof) { return acts[std::size_t(dof)] != 0; });
  return result;
}

}  // namespace

void ik_internal::requireNumbers(const IkTarget& target) {
  using Kind = IkTarget::Kind;
  const auto require = [&](bool good, const char* what) {
    if (!good) throw ValueError(cat("solveIk: the ", what, " in the target of frame '", target.frame, "'"));
  };
  if (target.kind == Kind::feature) {
    if (!target.value.allFinite())
      throw ValueError(cat("solveIk: the target of ", target.feature->source.name(), " is not finite"));
    return;
  }
  if (target.kind == Kind::direction || target.kind == Kind::gaze)
    require(target.axis.allFinite() && target.axis.norm() > 0., "axis is zero or not finite");
  if (target.kind == Kind::direction) {
    require(target.direction.allFinite() && target.direction.norm() > 0., "direction is zero or not finite");
    return;
  }
  require(target.pose.p.allFinite(), target.kind == Kind::gaze ? "point is not finite" : "position is not finite");
  require(target.pose.q.coeffs().allFinite() && target.pose.q.norm() > 0., "quaternion is zero or not finite");
}

FeatureSource IkTarget::centerOfMass() {
  return {kCenterOfMass,
          [](const std::vector<int>& frames, const State&) { return std::make_unique<CenterOfMass>(frames); }};
}

IkTask::IkTask(const State& scene, const IkTarget& given) : target(given) {
  requireNumbers(given);
  if (kind() == Kind::feature) {
    residual = makeFeatureResidual(scene, given);
    return;
  }
  frame = frameId(scene.model(), given.frame, "solveIk");
  if (!given.relative_to.empty()) reference = frameId(scene.model(), given.relative_to, "solveIk");
  target.axis.normalize();
}

int IkTask::rows() const {
  return kind() == Kind::feature ? residual->rows() : kind() == Kind::pose ? 6 : hasDirection() ? 2 : 3;
}

std::vector<int> IkTask::dofs(const State& scene) const {
  const KinematicModel& model = scene.model();
  std::set<int> found;
  const auto add = [&](int a, int b) {
    forColumnsBetween(model, a, b, [&](int column) { found.insert(model.column_dof[column]); });
  };
  if (kind() != Kind::feature) {
    add(frame, reference);
    return {found.begin(), found.end()};
  }
  const std::optional<FeatureSymbol> symbol = target.feature->source.symbol();
  const FeatureDofs which = symbol ? featureInfo(*symbol).dofs : FeatureDofs::of_scene;
  for (const std::string& name : target.feature->frames) {
    const int id = frameId(model, name, "solveIk");
    if (which == FeatureDofs::of_frames) add(id, -1);
    if (which != FeatureDofs::of_joints) continue;
    const KinematicModel::DofRange& own = model.frame_dofs[std::size_t(id)];
    for (int dof = own.first; dof < own.first + own.count; ++dof) found.insert(dof);
  }
  if (which == FeatureDofs::of_scene || target.feature->frames.empty()) {
    for (int dof = 0; dof < model.dofs; ++dof) found.insert(dof);
  }
  const std::vector<int> all(found.begin(), found.end());
  // A common base of two arms has no influence between their hands. This test is skipped for distances and custom
  // functions, since these may be constant at the tested configurations.
  const bool is_testable = symbol ? which == FeatureDofs::of_frames : target.feature->source.name() == kCenterOfMass;
  return is_testable && !residual->reportsZeroRows() ? effective(all, scene, *residual) : all;
}

std::string IkTask::name() const {
  if (kind() != Kind::feature) return cat("frame '", target.frame, "'");
  const std::vector<std::string>& frames = target.feature->frames;
  return frames.empty() ? cat("feature ", residual->name()) : cat("feature ", residual->name(), " of ", quoted(frames));
}

std::string IkTask::goal() const {
  const std::string relative = reference < 0 ? "" : cat(" relative to '", target.relative_to, "'");
  switch (kind()) {
    case Kind::pose:
      return "pose" + relative;
    case Kind::position:
      return "position" + relative;
    case Kind::rotation:
      return "rotation" + relative;
    case Kind::direction:
      return "direction" + relative;
    case Kind::gaze:
      return reference < 0 ? "gaze" : cat("gaze at '", target.relative_to, "'");
    case Kind::feature:
      return target.feature->at_most ? "bound" : "target";
  }
  return "target";
}

std::string IkTask::unitOf(int row) const {
  const std::optional<FeatureSymbol> symbol = target.feature->source.symbol();
  if (residual->scale().size() > 0) return "";
  if (!symbol) return target.feature->source.name() == kCenterOfMass ? " m" : "";
  const FeatureUnit unit = featureInfo(*symbol).unitOf(row);
  return unit == FeatureUnit::meter ? " m" : unit == FeatureUnit::radian ? " rad" : "";
}

void IkTask::requireSame(const IkTarget& other, std::size_t problem) const {
  bool same = target.frame == other.frame && kind() == other.kind && target.relative_to == other.relative_to &&
              target.taken_from == other.taken_from && (!hasDirection() || target.axis == other.axis.normalized());
  if (same && kind() == Kind::feature && target.feature != other.feature) {
    const IkFeature &a = *target.feature, &b = *other.feature;
    same = a.source.name() == b.source.name() && a.source.symbol() == b.source.symbol() && a.frames == b.frames &&
           a.tolerance == b.tolerance && a.at_most == b.at_most && a.scale.matrix().rows() == b.scale.matrix().rows() &&
           a.scale.matrix().cols() == b.scale.matrix().cols() && a.scale.matrix() == b.scale.matrix();
  }
  if (!same)
    throw ValueError(cat("solveIk: problem ", problem, " must have the frames and kinds of targets of problem 0"));
  requireNumbers(other);
  if (kind() != Kind::feature) return;
  const Eigen::Index size = other.value.size(), rows = residual->feature().rows();
  if (size > 1 && size != rows)
    throw ValueError(cat("solveIk: problem ", problem, ": the target of ", residual->name(), " has ", size,
                         " numbers; expected 1 or ", rows));
}

}  // namespace kinegraph
