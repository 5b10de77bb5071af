#include "kinegraph/ik/ik_search.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/geometry/distance/proximity.h"

namespace kinegraph {

namespace {

constexpr double kSlack = 1e-4;  // m: what colliding pairs are moved apart beyond the margin
constexpr double kNear = .05;    // m beyond the margin: pairs whose distance a step looks at

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

IkSearch::IkSearch(std::shared_ptr<const IkProblem> problem)
    : problem_(std::move(problem)),
      state_(problem_->program, problem_->parameters),
      placed_(*problem_->bodies),
      q_(problem_->q),
      x_(problem_->variables()),
      pull_(problem_->variables()) {}

void IkSearch::open(IkJob& job, const std::vector<IkTarget>& targets) const {
  job.attempts = job.evals = 0;
  job.feasible = job.cancelled = job.kept_is_present = false;
  job.least = std::numeric_limits<double>::infinity();
  job.blocked.assign(problem_->pairs.size(), 0);
  job.kept.resize(problem_->variables());
  problem_->startingPoint(0, job.kept.data());
  job.goals.resize(targets.size());
  for (std::size_t i = 0; i < targets.size(); ++i) {
    IkGoal& goal = job.goals[i];
    goal.p = targets[i].pose.p;
    if (targets[i].kind != IkTarget::Kind::direction) {
      goal.R = targets[i].pose.q.normalized().toRotationMatrix();
      continue;
    }
    goal.p = targets[i].direction.normalized();
    goal.t1 = goal.p.unitOrthogonal();
    goal.t2 = goal.p.cross(goal.t1);
  }
}

void IkSearch::moveTo(const VectorXd& x) {
  for (int v = 0; v < problem_->variables(); ++v) q_[problem_->dofs[v]] = x[v];
  state_.setJoints(q_.data());
  ++job_->evals;
}

bool IkSearch::targetsMet() const {
  return errors_.position <= problem_->options.position_tolerance &&
         errors_.rotation <= problem_->options.rotation_tolerance;
}

/// Errors of the targets, and into `step_` their rows; those of the pairs stay. The kernels in lanes have rows of their
/// own (ik_kernel_body.h): they take angles from a polynomial that is good to 2e-8, which is enough to find the way and
/// the same in all lanes, where here they are exact to rounding, because this is what answers are judged by and what
/// results tell.
void IkSearch::measureTargets(bool with_jacobian) {
  using Kind = IkTarget::Kind;
  const Program& program = *problem_->program;
  errors_.position = errors_.rotation = square_ = 0.;
  int row = 0;
  for (std::size_t i = 0; i < job_->goals.size(); ++i) {
    const IkProblem::Task& task = problem_->tasks[i];
    IkGoal& goal = job_->goals[i];
    const RigidTransform X = state_.pose(task.frame);
    int at = row;
    if (task.placed()) {
      const Vector3d missing = goal.p - X.p;
      goal.position_error = missing.norm();
      square_ += missing.squaredNorm();
      errors_.position = std::max(errors_.position, goal.position_error);
      for (int k = 0; k < 3; ++k) step_.error(at++) = missing[k];
    }
    if (task.kind != Kind::position) {
      double& angle = goal.rotation_error;
      const bool whole = task.kind != Kind::direction;
      const Vector3d turn = whole ? rotationVector(goal.R, X.R, angle) : turnBetween(X.R * task.axis, goal.p, angle);
      square_ += angle * angle;
      errors_.rotation = std::max(errors_.rotation, angle);
      if (whole) {
        for (int k = 0; k < 3; ++k) step_.error(at++) = turn[k];
      } else {
        step_.error(at++) = turn.dot(goal.t1);
        step_.error(at++) = turn.dot(goal.t2);
      }
    }
    const int link = program.frame_link[task.frame];
    for (int c = with_jacobian ? program.last_column[link] : -1; c >= 0; c = program.column_before[c]) {
      const int v = problem_->variable[program.column_dof[c]];
      const State::Twist& twist = state_.twist(c);
      double* J = step_.column(v) + row;
      if (task.placed()) {
        const Vector3d velocity = twist.linear + twist.angular.cross(X.p);
        for (int k = 0; k < 3; ++k) *J++ += velocity[k];
      }
      if (task.kind == Kind::pose || task.kind == Kind::rotation) {
        for (int k = 0; k < 3; ++k) *J++ += twist.angular[k];
      } else if (task.kind == Kind::direction) {
        *J++ += twist.angular.dot(goal.t1);
        *J++ += twist.angular.dot(goal.t2);
      }
    }
    row = at;
  }
}

/// The pairs nearer than the margin and a bit, with the gradients of their distances.
void IkSearch::measureDistances() {
  const Program& program = *problem_->program;
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
      const int link = program.frame_link[frame];
      for (int c = program.last_column[link]; c >= 0; c = program.column_before[c]) {
        const int v = problem_->variable[program.column_dof[c]];
        if (v < 0) continue;
        const State::Twist& twist = state_.twist(c);
        gradient[v] += sign * near.rate * near.normal.dot(twist.linear + twist.angular.cross(point));
      }
    };
    add(a, near.point_a, 1.);
    add(b, near.point_b, -1.);
  }
}

void IkSearch::stepTowardsTargets() {
  step_.solve(x_.data(), problem_->lower.data(), problem_->upper.data(), problem_->longest.data(),
              DampedStep::damping(square_), nullptr);
  x_ += step_.step();
  problem_->normalize(x_.data());
}

/// A step that also keeps the near pairs apart. Which pairs need a row is not known before the step is: those that it
/// would bring too near get one and the step is solved again; those whose row pulls them together, which no inequality
/// does, lose it. That is an active set method cut short after a few passes, as the next step looks again.
void IkSearch::stepApart(const double* pull, double damping) {
  const int variables = problem_->variables();
  const double wanted = problem_->options.margin + kSlack;
  for (int pass = 0; pass < 4; ++pass) {
    const int rows =
        problem_->rows + int(std::count_if(near_.begin(), near_.end(), [](const NearPair& n) { return n.active; }));
    step_.resize(rows, variables);
    std::fill_n(step_.column(0), rows * variables, 0.);
    measureTargets(true);
    int row = problem_->rows;
    double square = square_;
    for (std::size_t n = 0; n < near_.size(); ++n) {
      if (!near_[n].active) continue;
      step_.error(row) = wanted - near_[n].distance;
      square += step_.error(row) * step_.error(row);
      for (int v = 0; v < variables; ++v) step_.column(v)[row] = gradients_[n * variables + v];
      ++row;
    }
    // More damping than on the way to the targets: rows of pairs that touch are often dependent.
    step_.solve(x_.data(), problem_->lower.data(), problem_->upper.data(), problem_->longest.data(),
                1e-7 + DampedStep::damping(square) + damping, pull);
    bool changed = false;
    row = problem_->rows;
    for (std::size_t n = 0; n < near_.size(); ++n) {
      if (near_[n].active) {
        if (step_.multiplier(row++) < 0. && near_[n].distance >= problem_->options.margin)
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
  problem_->normalize(x_.data());
}

/// All errors at x_.
void IkSearch::measure() {
  moveTo(x_);
  measureDistances();
  step_.resize(problem_->rows, problem_->variables());
  measureTargets(false);
}

bool IkSearch::stalls(int step, double square, double& before) {
  // Far from a solution Gauss-Newton may wander for a while, so that single steps say little: every five they must have
  // halved the sum of squares, else another starting point is the better use of the time.
  if (step % 5 != 4) return false;
  if (square > .5 * before) return true;
  before = square;
  return false;
}

/// From x_ to the targets.
IkApproach IkSearch::approach() {
  const int steps = problem_->options.steps, size = problem_->rows * problem_->variables(), evals = job_->evals;
  step_.resize(problem_->rows, problem_->variables());
  double before = 1e300;
  for (int i = 0;; ++i) {
    moveTo(x_);
    std::fill_n(step_.column(0), size, 0.);
    measureTargets(true);
    if (targetsMet() || i == steps || stalls(i, square_, before)) break;
    stepTowardsTargets();
  }
  return {targetsMet(), errors_.position + errors_.rotation, job_->evals - evals};
}

/// From x_ that meets the targets, and is measured, to one where also no pair collides.
IkSearch::Outcome IkSearch::avoidCollisions(const Stop& stop) {
  errors_.penetration = 0.;
  if (problem_->pairs.empty()) return Outcome::feasible;
  measureDistances();
  if (errors_.penetration == 0.) return Outcome::feasible;
  // The worst pair of every attempt is counted, because a failure is best told by what was mostly in the way.
  ++job_->blocked[std::ranges::min_element(near_, {}, &NearPair::distance)->pair];
  return moveApart(problem_->options.steps, stop);
}

/// Steps that mind the distances, until all is well. x_ is measured.
IkSearch::Outcome IkSearch::moveApart(int steps, const Stop& stop) {
  double before = 1e300;
  for (int i = 0;; ++i) {
    if (feasible()) return Outcome::feasible;
    if (i == steps) return Outcome::missed;
    if (i % 8 == 7) {  // slower than the way to the targets: which pairs are near changes as they move apart
      if (errors_.sum() > .8 * before) return Outcome::missed;
      before = errors_.sum();
    }
    if (stop()) return Outcome::cancelled;
    stepApart(nullptr);
    measure();
  }
}

}  // namespace kinegraph
