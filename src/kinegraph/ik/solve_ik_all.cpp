#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "kinegraph/ik/closed_form.h"
#include "kinegraph/ik/ik_search.h"
#include "kinegraph/ik/solve_ik.h"

namespace kinegraph {

namespace {

constexpr double kTurn = 2. * std::numbers::pi;
constexpr double kSameSolution = 1e-4;  // rad or m
constexpr int kRedundancySteps = 32;    // of the seventh hinge, over its range
constexpr double kPure = 1e-9;          // of the twist of a hinge, relatively

/// The hinges that move a frame, from the world to the frame, at the q of a problem.
struct HingeChain {
  std::vector<HingeAxis> axes;
  std::vector<int> dofs;
  RigidTransform X;     ///< of the frame at that q
  RigidTransform goal;  ///< of the target, in the world
};

/// None unless the only target is a pose in coordinates that stay, and all variables are hinges of a serial chain.
std::optional<HingeChain> hingeChain(const IkProblem& problem, const IkTarget& target) {
  const IkTask& task = problem.tasks[0];
  if (problem.tasks.size() != 1 || task.kind() != IkTarget::Kind::pose) return std::nullopt;
  State state(problem.model, problem.parameters);
  state.setJoints(problem.q.data());
  HingeChain chain;
  chain.goal = target.pose.transform();
  bool fits = true;
  if (task.reference >= 0) {
    state.forTwists(task.reference,
                    [&](int dof, const State::Twist&) { fits = fits && problem.variable[std::size_t(dof)] < 0; });
    chain.goal = state.pose(task.reference) * chain.goal;
  }
  state.forTwists(task.frame, [&](int dof, const State::Twist& twist) {
    if (std::ranges::find(chain.dofs, dof) != chain.dofs.end()) fits = false;  // it moves two joints
    if (std::abs(twist.angular.norm() - 1.) > kPure) fits = false;
    if (std::abs(twist.angular.dot(twist.linear)) > kPure) fits = false;
    chain.dofs.push_back(dof);
    chain.axes.push_back({twist.angular, twist.angular.cross(twist.linear)});
  });
  if (!fits || int(chain.dofs.size()) != problem.variables()) return std::nullopt;
  std::ranges::reverse(chain.dofs);
  std::ranges::reverse(chain.axes);
  chain.X = state.pose(task.frame);
  return chain;
}

/// Six of seven hinges, and the pose that they have to reach, while hinge `fixed` is turned by an angle.
std::pair<std::array<HingeAxis, 6>, RigidTransform> withoutHinge(const HingeChain& chain, std::size_t fixed,
                                                                 double angle) {
  const RigidTransform turn = chain.axes[fixed].turn(angle);
  std::array<HingeAxis, 6> axes;
  for (std::size_t k = 0; k < 7; ++k) {
    if (k < fixed) axes[k] = chain.axes[k];
    if (k > fixed) axes[k - 1] = {turn.R * chain.axes[k].direction, turn * chain.axes[k].point};
  }
  return {axes, chain.goal * chain.X.inverse() * turn.inverse()};
}

/// One solveIkAll call.
class AllSolutions {
 public:
  AllSolutions(std::shared_ptr<const IkProblem> problem, const std::vector<IkTarget>& targets,
               const CancellationToken& cancellation)
      : problem_(std::move(problem)),
        request_(std::make_shared<const IkRequest>(problem_, std::vector<std::vector<IkTarget>>{targets})),
        targets_(targets),
        cancellation_(cancellation),
        search_(problem_) {}

  std::vector<IkResult> run() {
    const std::optional<HingeChain> chain = hingeChain(*problem_, targets_[0]);
    if (!chain || !addClosedForm(*chain)) addNumeric();
    std::ranges::stable_sort(results_, {}, [this](const IkResult& r) { return (r.q - problem_->q).norm(); });
    return std::move(results_);
  }

 private:
  /// False if the chain has no closed form.
  bool addClosedForm(const HingeChain& chain) {
    if (chain.axes.size() == 6) {
      std::array<HingeAxis, 6> axes;
      std::ranges::copy(chain.axes, axes.begin());
      const ClosedFormArm arm(axes);
      if (!arm.isSolvable()) return false;
      for (const SixAngles& angles : arm.solve(chain.goal * chain.X.inverse())) add(chain, angles);
      return true;
    }
    if (chain.axes.size() != 7) return false;
    for (const std::size_t fixed : {2, 6, 0, 1, 3, 4, 5}) {  // the arm angle of a spherical shoulder and wrist first
      if (!ClosedFormArm(withoutHinge(chain, fixed, 0.).first).isSolvable()) continue;
      const auto dof = chain.dofs[fixed];
      const double q = problem_->q[dof], lower = std::max(problem_->model->lower[dof], q - std::numbers::pi);
      const double upper = std::min(problem_->model->upper[dof], q + std::numbers::pi);
      addRedundant(chain, fixed, 0.);
      for (int k = 0; k <= kRedundancySteps; ++k)
        addRedundant(chain, fixed, lower + (upper - lower) * k / kRedundancySteps - q);
      return true;
    }
    return false;
  }

  void addRedundant(const HingeChain& chain, std::size_t fixed, double angle) {
    const auto [axes, X] = withoutHinge(chain, fixed, angle);
    for (const SixAngles& six : ClosedFormArm(axes).solve(X)) {
      std::array<double, 7> angles;
      for (std::size_t k = 0; k < 7; ++k) angles[k] = k == fixed ? angle : six[k < fixed ? k : k - 1];
      add(chain, angles);
    }
  }

  template <std::size_t count>
  void add(const HingeChain& chain, const std::array<double, count>& angles) {
    VectorXd x(problem_->variables());
    for (std::size_t k = 0; k < count; ++k) {
      const int v = problem_->variable[std::size_t(chain.dofs[k])];
      const double present = problem_->q[chain.dofs[k]];
      x[v] = present + angles[k];
      // The turn that is the nearest one to the present value; at a limit, rounding may have left it.
      constexpr double slack = 1e-7;
      if (x[v] > problem_->upper[v] + slack) x[v] -= kTurn;
      if (x[v] < problem_->lower[v] - slack) x[v] += kTurn;
      if (x[v] > problem_->upper[v] + slack) return;
      x[v] = std::clamp(x[v], problem_->lower[v], problem_->upper[v]);
    }
    check(x);
  }

  void addNumeric() {
    VectorXd x(problem_->variables());
    for (int i = 0; i < problem_->options.attempts; ++i) {
      problem_->startingPoint(i, x.data());
      check(x);
    }
  }

  /// Keeps the solution that the general method finds from x, unless it is known.
  void check(const VectorXd& x) {
    if (cancellation_.isCancelled()) return;
    IkJob job;
    search_.open(job, targets_);
    search_.assess(job, x, {true, 0., 0}, cancellation_);
    if (!job.feasible) return;
    const bool known = std::ranges::any_of(results_, [&](const IkResult& r) { return isSame(r.q, job.best); });
    if (known) return;
    IkResult result = search_.finish(job, false, cancellation_);
    if (!result.feasible()) return;
    result.request = request_;
    results_.push_back(std::move(result));
  }

  bool isSame(const VectorXd& q, const VectorXd& x) const {
    for (int v = 0; v < problem_->variables(); ++v) {
      double difference = q[problem_->dofs[std::size_t(v)]] - x[v];
      if (std::isfinite(problem_->longest[v])) difference = std::remainder(difference, kTurn);
      if (std::abs(difference) > kSameSolution) return false;
    }
    return true;
  }

  std::shared_ptr<const IkProblem> problem_;
  std::shared_ptr<const IkRequest> request_;
  const std::vector<IkTarget>& targets_;
  const CancellationToken& cancellation_;
  IkSearch search_;
  std::vector<IkResult> results_;
};

}  // namespace

std::vector<IkResult> solveIkAll(const Config& config, const std::vector<IkTarget>& targets, const IkOptions& options,
                                 const CancellationToken& cancellation) {
  const auto problem = std::make_shared<const IkProblem>(config, targets, options);
  std::vector<IkResult> all = AllSolutions(problem, targets, cancellation).run();
  if (all.empty()) all.push_back(solveIk(config, targets, options, cancellation));
  return all;
}

}  // namespace kinegraph
