#include <algorithm>
#include <cmath>

#include "kinegraph/geometry/distance/proximity.h"
#include "kinegraph/ik/ik_iterate.h"

namespace kinegraph::inline ik_internal {

namespace {

constexpr double kNear = .05;    // m beyond the margin: a step considers pairs up to this distance
constexpr double kSlack = 1e-4;  // m: distance beyond the margin to which colliding pairs are moved apart
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
  const Eigen::AngleAxisd half_rotation(Matrix3d(R_target * R.transpose()));
  return half_rotation.angle() * half_rotation.axis();
}

/// The shortest rotation vector that brings the unit vector a to b.
Vector3d rotationBetween(const Vector3d& a, const Vector3d& b, double& angle) {
  const Vector3d across = a.cross(b);
  const double sine = across.norm();
  angle = std::atan2(sine, a.dot(b));
  if (sine > 1e-9) return (angle / sine) * across;
  return a.dot(b) > 0. ? across : Vector3d(angle * a.unitOrthogonal());
}

}  // namespace

IkIterate::IkIterate(const IkProblem& problem)
    : problem_(problem),
      state_(problem_.model, problem_.parameters),
      placed_(*problem_.bodies),
      q_(problem_.q),
      x_(problem_.variables()) {
  for (const IkTask& task : problem_.tasks) {
    if (task.residual) residuals_.push_back(*task.residual);
  }
}

void IkGoal::setDirection(const Vector3d& direction) {
  p = direction;
  t1 = p.unitOrthogonal();
  t2 = p.cross(t1);
}

void IkIterate::setTargets(IkJob& job, const std::vector<IkTarget>& targets) {
  job.goals.resize(targets.size());
  std::size_t feature = 0;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    IkGoal& goal = job.goals[i];
    if (targets[i].kind == IkTarget::Kind::feature) {
      residuals_[feature++].setTarget(targets[i].value);
    } else if (targets[i].kind == IkTarget::Kind::direction) {
      goal.relative.p = targets[i].direction.normalized();
      goal.setDirection(goal.relative.p);
    } else {
      goal.relative = {targets[i].pose.q.normalized().toRotationMatrix(), targets[i].pose.p};
      goal.R = goal.relative.R;
      goal.p = goal.relative.p;
    }
  }
}

/// Moves the scene to x.
void IkIterate::place() {
  for (int v = 0; v < problem_.variables(); ++v) q_[problem_.dofs[v]] = x_[v];
  state_.setJoints(q_.data());
  ++job_->evals;
}

void IkIterate::evaluateTargets(bool with_jacobian) {
  place();
  step_.resize(problem_.rows, problem_.variables());
  if (with_jacobian) std::fill_n(step_.column(0), problem_.rows * problem_.variables(), 0.);
  measureTargets(with_jacobian);
}

void IkIterate::evaluate() {
  place();
  evaluateDistances();
  step_.resize(problem_.rows, problem_.variables());
  measureTargets(false);
}

/// Computes the errors of the targets, and their rows in `step_`; the rows of pairs stay. The kernels in lanes have
/// rows of their own (ik_kernel_body.h). Their angles come from a polynomial that is accurate to 2e-8, which is the
/// same in all lanes and good enough for an approach. Here angles are exact to rounding, because answers are accepted
/// and reported by these errors.
void IkIterate::measureTargets(bool with_jacobian) {
  errors_.position = errors_.rotation = errors_.feature = square_ = 0.;
  features_met_ = true;
  int row = 0;
  std::size_t feature = 0;
  for (std::size_t i = 0; i < job_->goals.size(); ++i) {
    const IkTask& task = problem_.tasks[i];
    if (task.residual) {
      measureFeature(i, residuals_[feature++], row, with_jacobian);
    } else {
      measureFrame(i, row, with_jacobian);
    }
    row += task.rows();
  }
}

/// Computes the world coordinates of a goal that another frame carries, and the direction of a gaze from p_WF.
void IkIterate::placeGoal(const IkTask& task, IkGoal& goal, const Vector3d& p_WF) const {
  const RigidTransform A = task.reference < 0 ? RigidTransform() : state_.pose(task.reference);
  if (task.kind() == IkTarget::Kind::direction) {
    goal.setDirection(A.R * goal.relative.p);
  } else if (task.kind() == IkTarget::Kind::gaze) {
    const Vector3d sight = A * goal.relative.p - p_WF;
    goal.setDirection(sight.norm() > kBlind ? Vector3d(sight.normalized()) : Vector3d(Vector3d::UnitZ()));
  } else {
    goal.R = A.R * goal.relative.R;
    goal.p = A * goal.relative.p;
  }
}

/// Computes the rows of a pose, position, rotation, direction or gaze. The Jacobian holds the motion relative to the
/// frame that carries the goal, so joints that move both alike contribute nothing.
void IkIterate::measureFrame(std::size_t target, int row, bool with_jacobian) {
  const KinematicModel& model = *problem_.model;
  const IkTask& task = problem_.tasks[target];
  IkGoal& goal = job_->goals[target];
  const RigidTransform X = state_.pose(task.frame);
  if (!task.inLanes()) placeGoal(task, goal, X.p);
  int at = row;
  if (task.hasPosition()) {
    const Vector3d offset = goal.p - X.p;
    goal.position_error = offset.norm();
    square_ += offset.squaredNorm();
    errors_.position = std::max(errors_.position, goal.position_error);
    for (int k = 0; k < 3; ++k) step_.error(at++) = offset[k];
  }
  if (task.hasRotation() || task.hasDirection()) {
    double& angle = goal.rotation_error;
    const Vector3d rotation = task.hasRotation() ? rotationVector(goal.R, X.R, angle)
                                                 : rotationBetween(X.R * task.target.axis, goal.p, angle);
    square_ += angle * angle;
    errors_.rotation = std::max(errors_.rotation, angle);
    if (task.hasRotation()) {
      for (int k = 0; k < 3; ++k) step_.error(at++) = rotation[k];
    } else {
      step_.error(at++) = rotation.dot(goal.t1);
      step_.error(at++) = rotation.dot(goal.t2);
    }
  }
  if (!with_jacobian) return;
  const bool gazes = task.kind() == IkTarget::Kind::gaze;
  const Vector3d seen = !gazes               ? X.p
                        : task.reference < 0 ? goal.relative.p
                                             : state_.pose(task.reference) * goal.relative.p;
  const double per_distance = gazes ? 1. / std::max((seen - X.p).norm(), kBlind) : 0.;
  const auto addColumns = [&](int frame, const Vector3d& point, double sign) {
    const int link = model.frame_link[frame];
    for (int c = model.last_column[link]; c >= 0; c = model.column_before[c]) {
      const int v = problem_.variable[model.column_dof[c]];
      if (v < 0) continue;
      const State::Twist& twist = state_.twist(c);
      const Vector3d velocity = twist.linear + twist.angular.cross(point);
      double* J = step_.column(v) + row;
      if (task.hasPosition()) {
        for (int k = 0; k < 3; ++k) *J++ += sign * velocity[k];
      }
      if (task.hasRotation()) {
        for (int k = 0; k < 3; ++k) *J++ += sign * twist.angular[k];
      } else if (gazes) {  // the axis rotates with the frame, the line of sight with both of its ends
        const double own = sign > 0. ? 1. : 0.;
        *J++ += own * twist.angular.dot(goal.t1) - sign * per_distance * velocity.dot(goal.t2);
        *J++ += own * twist.angular.dot(goal.t2) + sign * per_distance * velocity.dot(goal.t1);
      } else if (task.hasDirection()) {
        *J++ += sign * twist.angular.dot(goal.t1);
        *J++ += sign * twist.angular.dot(goal.t2);
      }
    }
  };
  addColumns(task.frame, X.p, 1.);
  if (task.reference >= 0) addColumns(task.reference, seen, -1.);
}

/// Computes the rows of a feature: its negative residual, or 0 if a bound is satisfied.
void IkIterate::measureFeature(std::size_t target, Residual& residual, int row, bool with_jacobian) {
  const IkTask& task = problem_.tasks[target];
  IkGoal& goal = job_->goals[target];
  const int rows = residual.rows();
  feature_value_.resize(rows);
  feature_jacobian_.resize(rows, with_jacobian ? problem_.model->dofs : 0);
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
      goal.worst_component = r;
    }
    for (int v = 0; with_jacobian && v < problem_.variables(); ++v)
      step_.column(v)[row + r] += feature_jacobian_(r, problem_.dofs[std::size_t(v)]);
  }
  errors_.feature = std::max(errors_.feature, goal.feature_error);
  features_met_ = features_met_ && goal.feature_error <= task.target.feature->tolerance;
}

void IkIterate::evaluateDistances() {
  const KinematicModel& model = *problem_.model;
  const int variables = problem_.variables();
  near_.clear();
  gradients_.clear();
  errors_.penetration = 0.;
  const double margin = problem_.options.margin;
  placed_.place(state_);
  for (int i = 0; i < placed_.pairs(); ++i) {
    if (!placed_.mayBeNear(i, margin + kNear)) continue;  // bounding spheres exclude most pairs
    const Proximity near = placed_.proximity(i);
    if (near.distance > margin + kNear) continue;
    const auto [a, b] = problem_.pairs[i];
    errors_.penetration = std::max(errors_.penetration, margin - near.distance);
    near_.push_back({i, near.distance, near.distance < margin + kSlack});
    gradients_.resize(gradients_.size() + variables, 0.);
    double* gradient = gradients_.data() + gradients_.size() - variables;
    const auto add = [&](int frame, const Vector3d& point, double sign) {
      const int link = model.frame_link[frame];
      for (int c = model.last_column[link]; c >= 0; c = model.column_before[c]) {
        const int v = problem_.variable[model.column_dof[c]];
        if (v < 0) continue;
        const State::Twist& twist = state_.twist(c);
        gradient[v] += sign * near.rate * near.normal.dot(twist.linear + twist.angular.cross(point));
      }
    };
    add(a, near.point_a, 1.);
    add(b, near.point_b, -1.);
  }
}

bool IkIterate::targetsMet() const {
  return errors_.position <= problem_.options.position_tolerance &&
         errors_.rotation <= problem_.options.rotation_tolerance && features_met_;
}

double IkIterate::squaredError() const {
  double sum = square_;
  for (const NearPair& near : near_) {
    const double overlap = std::max(problem_.options.margin - near.distance, 0.);
    sum += overlap * overlap;
  }
  return sum;
}

VectorXd IkIterate::descentDirection() {
  const int variables = problem_.variables();
  step_.resize(problem_.rows, variables);
  std::fill_n(step_.column(0), problem_.rows * variables, 0.);
  measureTargets(true);
  VectorXd push(variables);
  for (int v = 0; v < variables; ++v) {
    double sum = 0.;
    for (int r = 0; r < problem_.rows; ++r) sum += step_.column(v)[r] * step_.error(r);
    for (std::size_t n = 0; n < near_.size(); ++n) {
      if (near_[n].distance < problem_.options.margin) {
        sum += gradients_[n * variables + v] * (problem_.options.margin - near_[n].distance);
      }
    }
    push[v] = sum;
  }
  return push;
}

void IkIterate::stepTowardsTargets() {
  step_.solve(x_.data(), problem_.lower.data(), problem_.upper.data(), problem_.longest.data(),
              DampedStep::damping(square_), nullptr);
  x_ += step_.step();
  problem_.normalize(x_.data());
}

void IkIterate::stepApart(const double* preferred, double damping) {
  const int variables = problem_.variables();
  const double wanted = problem_.options.margin + kSlack;
  for (int pass = 0; pass < 4; ++pass) {
    const int rows =
        problem_.rows + int(std::count_if(near_.begin(), near_.end(), [](const NearPair& n) { return n.active; }));
    step_.resize(rows, variables);
    std::fill_n(step_.column(0), rows * variables, 0.);
    measureTargets(true);
    int row = problem_.rows;
    double square = square_;
    for (std::size_t n = 0; n < near_.size(); ++n) {
      if (!near_[n].active) continue;
      step_.error(row) = wanted - near_[n].distance;
      square += step_.error(row) * step_.error(row);
      for (int v = 0; v < variables; ++v) step_.column(v)[row] = gradients_[n * variables + v];
      ++row;
    }
    // More damping than in stepTowardsTargets: the rows of touching pairs are often linearly dependent.
    step_.solve(x_.data(), problem_.lower.data(), problem_.upper.data(), problem_.longest.data(),
                1e-7 + DampedStep::damping(square) + damping, preferred);
    bool changed = false;
    row = problem_.rows;
    for (std::size_t n = 0; n < near_.size(); ++n) {
      if (near_[n].active) {
        if (step_.multiplier(row++) < 0. && near_[n].distance >= problem_.options.margin)
          near_[n].active = false, changed = true;
        continue;
      }
      double predicted = near_[n].distance;
      for (int v = 0; v < variables; ++v) predicted += gradients_[n * variables + v] * step_.step()[v];
      if (predicted < wanted - 1e-9) near_[n].active = changed = true;
    }
    if (!changed) break;
  }
  x_ += step_.step();
  problem_.normalize(x_.data());
}

}  // namespace kinegraph::inline ik_internal
