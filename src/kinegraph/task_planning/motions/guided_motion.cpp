#include "kinegraph/task_planning/motions/guided_motion.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline task_planning_internal {

namespace {

constexpr double kStep = .02;       ///< rad or m: between configurations, per dof
constexpr double kFarther = 8.;     ///< steps: configurations that are farther apart count as a jump
constexpr double kFine = 1e-3;      ///< tolerance of constraints
constexpr double kPerMeter = 10.;   ///< scale of positions
constexpr double kDirections = 1.;  ///< scale of axes

Matrix3d turnOf(const Config& C, const std::string& frame, const std::string& in) {
  return C.getFrame(in).getRotationMatrix().transpose() * C.getFrame(frame).getRotationMatrix();
}

Vector3d placeOf(const Config& C, const std::string& frame, const std::string& in) {
  const Frame base = C.getFrame(in);
  return base.getRotationMatrix().transpose() * (C.getFrame(frame).getPosition() - base.getPosition());
}

}  // namespace

std::vector<MotionConstraint> gripConstraints(const Config& C, const std::string& hand, const std::string& handle) {
  using F = FeatureSymbol;
  const MatrixXd meters = MatrixXd::Constant(1, 1, kPerMeter), directions = MatrixXd::Constant(1, 1, kDirections);
  std::vector<MotionConstraint> all = {{.feature = F::positionRel,
                                        .frames = {hand, handle},
                                        .scale = meters,
                                        .target = VectorXd(placeOf(C, hand, handle))}};
  const auto keep = [&](F axis, int column, const std::string& frame, const std::string& in) {
    const VectorXd target = turnOf(C, frame, in).col(column);
    all.push_back({.feature = axis, .frames = {frame, in}, .scale = directions, .target = target});
  };
  switch (gripOf(C, hand, handle)) {
    case Grip::rigid:
      keep(F::vectorXRel, 0, hand, handle);
      keep(F::vectorZRel, 2, hand, handle);
      break;
    case Grip::axis:
      keep(F::vectorZRel, 2, handle, hand);
      break;
    case Grip::point:
      break;
  }
  return all;
}

MatrixXd guidedConfigurations(const Config& C, const VectorXd& q0, const VectorXd& q1,
                              const std::vector<MotionConstraint>& constraints) {
  Config scene = C;
  const State state = scene.scene()->state();
  const JointSpace space(state.model());
  Manifold held(state, space, constraints, kFine);
  const VectorXd way = space.difference(q0, q1);
  const int count = std::max(int(std::ceil(way.cwiseAbs().maxCoeff() / kStep)), 2) + 1;
  MatrixXd rows(count, q0.size());
  rows.row(0) = q0;
  rows.row(count - 1) = q1;
  VectorXd moved = VectorXd::Zero(q0.size());  // offset of the last configuration from the line
  for (int i = 1; i + 1 < count; ++i) {
    const double share = double(i) / double(count - 1);
    VectorXd q = q0 + share * way + moved;
    if (!held.project(q)) {
      q = q0 + share * way;
      if (!held.project(q)) return {};
    }
    moved = (q - q0 - share * way) * (1. - 1. / double(count - i));  // fades to 0 at q1
    rows.row(i) = q;
  }
  for (int i = 1; i < count; ++i)
    if ((rows.row(i) - rows.row(i - 1)).cwiseAbs().maxCoeff() > kFarther * kStep) return {};
  return rows;
}

Slip slipOf(const Config& taken, const Config& now, const std::string& hand, const std::string& handle) {
  Slip slip;
  slip.distance = (placeOf(now, hand, handle) - placeOf(taken, hand, handle)).norm();
  const Matrix3d before = turnOf(taken, handle, hand), after = turnOf(now, handle, hand);
  switch (gripOf(taken, hand, handle)) {
    case Grip::rigid:
      slip.cosine = .5 * ((before.transpose() * after).trace() - 1.);
      break;
    case Grip::axis:
      slip.cosine = before.col(2).dot(after.col(2));
      break;
    case Grip::point:
      break;
  }
  return slip;
}

Slip mostSlip(const Config& taken, const MatrixXd& path, const std::string& hand, const std::string& handle) {
  Config now = taken;
  Slip most;
  const auto look = [&](const VectorXd& q) {
    now.setJointState(q);
    const Slip slip = slipOf(taken, now, hand, handle);
    most = {std::max(most.distance, slip.distance), std::min(most.cosine, slip.cosine)};
  };
  for (Eigen::Index row = 0; row < path.rows(); ++row) {
    if (row > 0) {
      const VectorXd before = path.row(row - 1), step = path.row(row).transpose() - before;
      const int pieces = std::max(2, int(std::ceil(step.cwiseAbs().maxCoeff() / kStep)));
      for (int i = 1; i < pieces; ++i) look(before + double(i) / pieces * step);
    }
    look(path.row(row));
  }
  return most;
}

}  // namespace kinegraph::inline task_planning_internal
