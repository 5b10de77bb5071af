#include <algorithm>
#include <cmath>

#include "kinegraph/geometry/distance/proximity.h"
#include "kinegraph/ik/ik_search.h"

namespace kinegraph {

namespace {

constexpr double kNear = .05;    // m beyond the margin: pairs whose distance a step looks at
constexpr double kBlind = 1e-9;  // m: a point nearer than this has no direction

/// The rotation vector of E = R_target R^T, in world coordinates.
Vector3d rotationVector(const Matrix3d& R_target, const Matrix3d& R, double& angle) {
  const Vector3d twice_sine =
      R.col(0).cross(R_target.col(0)) + R.col(1).cross(R_target.col(1)) + R.col(2).cross(R_target.col(2));
  const double sine = .5 * twice_sine.norm();
  const double cosine = .5 * ((R.array() * R_target.array()).sum() - 1.);
  angle = std::atan2(sine, cosine);
  if (sine > 1e-5) return (.5 * angle / sine) * twice_sine;
  if (cosine > 0.) return .5 * twice_sine;
  const Eigen::AngleAxisd half_turn(Matrix3d(R_target * R.transpose()));
  return half_turn.angle() * half_turn.axis();
}

/// The rotation vector that turns the unit vector a into b the short way.
Vector3d turnBetween(const Vector3d& a, const Vector3d& b, double& angle) {
  const Vector3d across = a.cross(b);
  const double sine = across.norm();
  angle = std::atan2(sine, a.dot(b));
  if (sine > 1e-9) return (angle / sine) * across;
  return a.dot(b) > 0. ? across : Vector3d(angle * a.unitOrthogonal());
}

}  // namespace

/// Errors of the targets, and into `step_` their rows; those of the pairs stay. The kernels in lanes have rows of their
/// own (ik_kernel_body.h): they take angles from a polynomial that is good to 2e-8, which is enough to find the way and
/// the same in all lanes, where here they are exact to rounding, because this is what answers are judged by and what
/// results tell.
void IkSearch::measureTargets(bool with_jacobian) {
  errors_.position = errors_.rotation = errors_.feature = square_ = 0.;
  features_met_ = true;
  int row = 0;
  std::size_t feature = 0;
  for (std::size_t i = 0; i < job_->goals.size(); ++i) {
    const IkProblem::Task& task = problem_->tasks[i];
    if (task.residual) {
      measureFeature(i, residuals_[feature++], row, with_jacobian);
    } else {
      measureFrame(i, row, with_jacobian);
    }
    row += task.rows();
  }
}

/// Where a goal is in the world that another frame carries, or that is seen from the frame's own place.
void IkSearch::placeGoal(const IkProblem::Task& task, IkGoal& goal, const Vector3d& p_WF) const {
  const RigidTransform A = task.reference < 0 ? RigidTransform() : state_.pose(task.reference);
  if (task.kind() == IkTarget::Kind::direction) {
    goal.setDirection(A.R * goal.given.p);
  } else if (task.kind() == IkTarget::Kind::gaze) {
    const Vector3d sight = A * goal.given.p - p_WF;
    goal.setDirection(sight.norm() > kBlind ? Vector3d(sight.normalized()) : Vector3d(Vector3d::UnitZ()));
  } else {
    goal.R = A.R * goal.given.R;
    goal.p = A * goal.given.p;
  }
}

/// Rows of a pose, position, rotation, direction or gaze. With a Jacobian they are those of a goal that its frame
/// carries: seen from there, so that what moves both alike has no part in them.
void IkSearch::measureFrame(std::size_t target, int row, bool with_jacobian) {
  const KinematicModel& model = *problem_->model;
  const IkProblem::Task& task = problem_->tasks[target];
  IkGoal& goal = job_->goals[target];
  const RigidTransform X = state_.pose(task.frame);
  if (!task.inLanes()) placeGoal(task, goal, X.p);
  int at = row;
  if (task.placed()) {
    const Vector3d missing = goal.p - X.p;
    goal.position_error = missing.norm();
    square_ += missing.squaredNorm();
    errors_.position = std::max(errors_.position, goal.position_error);
    for (int k = 0; k < 3; ++k) step_.error(at++) = missing[k];
  }
  if (task.turned() || task.pointed()) {
    double& angle = goal.rotation_error;
    const Vector3d turn =
        task.turned() ? rotationVector(goal.R, X.R, angle) : turnBetween(X.R * task.target.axis, goal.p, angle);
    square_ += angle * angle;
    errors_.rotation = std::max(errors_.rotation, angle);
    if (task.turned()) {
      for (int k = 0; k < 3; ++k) step_.error(at++) = turn[k];
    } else {
      step_.error(at++) = turn.dot(goal.t1);
      step_.error(at++) = turn.dot(goal.t2);
    }
  }
  if (!with_jacobian) return;
  const bool gazes = task.kind() == IkTarget::Kind::gaze;
  const Vector3d seen = !gazes ? X.p : task.reference < 0 ? goal.given.p : state_.pose(task.reference) * goal.given.p;
  const double per_distance = gazes ? 1. / std::max((seen - X.p).norm(), kBlind) : 0.;
  const auto addColumns = [&](int frame, const Vector3d& point, double sign) {
    const int link = model.frame_link[frame];
    for (int c = model.last_column[link]; c >= 0; c = model.column_before[c]) {
      const int v = problem_->variable[model.column_dof[c]];
      if (v < 0) continue;
      const State::Twist& twist = state_.twist(c);
      const Vector3d velocity = twist.linear + twist.angular.cross(point);
      double* J = step_.column(v) + row;
      if (task.placed()) {
        for (int k = 0; k < 3; ++k) *J++ += sign * velocity[k];
      }
      if (task.turned()) {
        for (int k = 0; k < 3; ++k) *J++ += sign * twist.angular[k];
      } else if (gazes) {  // the axis turns with the frame, and the line of sight with both of its ends
        const double turns = sign > 0. ? 1. : 0.;
        *J++ += turns * twist.angular.dot(goal.t1) - sign * per_distance * velocity.dot(goal.t2);
        *J++ += turns * twist.angular.dot(goal.t2) + sign * per_distance * velocity.dot(goal.t1);
      } else if (task.pointed()) {
        *J++ += sign * twist.angular.dot(goal.t1);
        *J++ += sign * twist.angular.dot(goal.t2);
      }
    }
  };
  addColumns(task.frame, X.p, 1.);
  if (task.reference >= 0) addColumns(task.reference, seen, -1.);
}

/// Rows of a feature: what its residual lacks; none where a bound holds.
void IkSearch::measureFeature(std::size_t target, Residual& residual, int row, bool with_jacobian) {
  const IkProblem::Task& task = problem_->tasks[target];
  IkGoal& goal = job_->goals[target];
  const int rows = residual.rows();
  feature_value_.resize(rows);
  feature_jacobian_.resize(rows, with_jacobian ? problem_->model->dofs : 0);
  feature_jacobian_.setZero();
  JacobianRows J = feature_jacobian_;
  const State* state = &state_;
  residual.eval({&state, 1}, 1., feature_value_, with_jacobian ? &J : nullptr);
  goal.feature_error = 0.;
  for (int r = 0; r < rows; ++r) {
    const double value = feature_value_[r];
    const bool holds = task.target.feature->at_most && value <= 0.;
    step_.error(row + r) = holds ? 0. : -value;
    if (holds) continue;
    square_ += value * value;
    if (std::abs(value) > goal.feature_error) {
      goal.feature_error = std::abs(value);
      goal.worst_row = r;
    }
    for (int v = 0; with_jacobian && v < problem_->variables(); ++v)
      step_.column(v)[row + r] += feature_jacobian_(r, problem_->dofs[std::size_t(v)]);
  }
  errors_.feature = std::max(errors_.feature, goal.feature_error);
  features_met_ = features_met_ && goal.feature_error <= task.target.feature->tolerance;
}

/// The pairs nearer than the margin and a bit, with the gradients of their distances.
void IkSearch::measureDistances() {
  const KinematicModel& model = *problem_->model;
  const int variables = problem_->variables();
  near_.clear();
  gradients_.clear();
  errors_.penetration = 0.;
  const double margin = problem_->options.margin;
  placed_.place(state_);
  for (int i = 0; i < placed_.pairs(); ++i) {
    if (!placed_.mayBeNear(i, margin + kNear)) continue;  // most are far, which spheres show
    const Proximity near = placed_.proximity(i);
    if (near.distance > margin + kNear) continue;
    const auto [a, b] = problem_->pairs[i];
    errors_.penetration = std::max(errors_.penetration, margin - near.distance);
    near_.push_back({i, near.distance, near.distance < margin + kSlack});
    gradients_.resize(gradients_.size() + variables, 0.);
    double* gradient = gradients_.data() + gradients_.size() - variables;
    const auto add = [&](int frame, const Vector3d& point, double sign) {
      const int link = model.frame_link[frame];
      for (int c = model.last_column[link]; c >= 0; c = model.column_before[c]) {
        const int v = problem_->variable[model.column_dof[c]];
        if (v < 0) continue;
        const State::Twist& twist = state_.twist(c);
        gradient[v] += sign * near.rate * near.normal.dot(twist.linear + twist.angular.cross(point));
      }
    };
    add(a, near.point_a, 1.);
    add(b, near.point_b, -1.);
  }
}

}  // namespace kinegraph
