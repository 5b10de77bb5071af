#include "kinegraph/ik/ik_search.h"

#include <algorithm>

namespace kinegraph {

IkSearch::IkSearch(std::shared_ptr<const IkProblem> problem)
    : problem_(std::move(problem)),
      state_(problem_->model, problem_->parameters),
      placed_(*problem_->bodies),
      q_(problem_->q),
      x_(problem_->variables()),
      pull_(problem_->variables()) {
  for (const IkProblem::Task& task : problem_->tasks) {
    if (task.residual) residuals_.push_back(*task.residual);
  }
}

void IkGoal::setDirection(const Vector3d& direction) {
  p = direction;
  t1 = p.unitOrthogonal();
  t2 = p.cross(t1);
}

void IkSearch::open(IkJob& job, const std::vector<IkTarget>& targets) {
  job.attempts = job.evals = 0;
  job.feasible = job.cancelled = job.kept_is_present = false;
  job.least = std::numeric_limits<double>::infinity();
  job.blocked.assign(problem_->pairs.size(), 0);
  job.kept.resize(problem_->variables());
  problem_->startingPoint(0, job.kept.data());
  job.goals.resize(targets.size());
  std::size_t feature = 0;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    IkGoal& goal = job.goals[i];
    if (targets[i].kind == IkTarget::Kind::feature) {
      residuals_[feature++].setTarget(targets[i].value);
    } else if (targets[i].kind == IkTarget::Kind::direction) {
      goal.given.p = targets[i].direction.normalized();
      goal.setDirection(goal.given.p);
    } else {
      goal.given = {targets[i].pose.q.normalized().toRotationMatrix(), targets[i].pose.p};
      goal.R = goal.given.R;
      goal.p = goal.given.p;
    }
  }
}

void IkSearch::moveTo(const VectorXd& x) {
  for (int v = 0; v < problem_->variables(); ++v) q_[problem_->dofs[v]] = x[v];
  state_.setJoints(q_.data());
  ++job_->evals;
}

bool IkSearch::targetsMet() const {
  return errors_.position <= problem_->options.position_tolerance &&
         errors_.rotation <= problem_->options.rotation_tolerance && features_met_;
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
  return {targetsMet(), errors_.position + errors_.rotation + errors_.feature, job_->evals - evals};
}

/// From x_ that meets the targets, and is measured, to one where also no pair collides.
IkSearch::Outcome IkSearch::avoidCollisions(const CancellationToken& cancellation) {
  errors_.penetration = 0.;
  if (problem_->pairs.empty()) return Outcome::feasible;
  measureDistances();
  if (errors_.penetration == 0.) return Outcome::feasible;
  // The worst pair of every attempt is counted, because a failure is best told by what was mostly in the way.
  ++job_->blocked[std::ranges::min_element(near_, {}, &NearPair::distance)->pair];
  return moveApart(problem_->options.steps, cancellation);
}

/// Steps that mind the distances, until all is well. x_ is measured.
IkSearch::Outcome IkSearch::moveApart(int steps, const CancellationToken& cancellation) {
  double before = 1e300;
  for (int i = 0;; ++i) {
    if (feasible()) return Outcome::feasible;
    if (i == steps) return Outcome::missed;
    if (i % 8 == 7) {  // slower than the way to the targets: which pairs are near changes as they move apart
      if (errors_.sum() > .8 * before) return Outcome::missed;
      before = errors_.sum();
    }
    if (cancellation()) return Outcome::cancelled;
    stepApart(nullptr);
    measure();
  }
}

}  // namespace kinegraph
