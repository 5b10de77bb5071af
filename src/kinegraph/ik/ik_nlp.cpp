#include "kinegraph/ik/solve_ik.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/ik/ik_problem.h"

namespace kinegraph {

namespace {

using Kind = IkTarget::Kind;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double kMayTouch = 2e-3;  // m beyond the margin: pairs that may touch near the solution

/// The rotation vector r of R = exp(r).
Vector3d logarithm(const Matrix3d& R) {
  const Eigen::AngleAxisd rotation(R);
  const Vector3d twice_sine(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  return rotation.angle() < 1e-4 ? Vector3d(.5 * twice_sine) : Vector3d(rotation.angle() * rotation.axis());
}

/// Derivative of r for R = exp(r) and a small rotation w from the left, exp(w) R. The transpose is the derivative for a
/// rotation from the right.
Matrix3d logarithmJacobian(const Vector3d& r) {
  const double angle = r.norm();
  const double k =
      angle < 1e-3 ? 1. / 12. : 1. / (angle * angle) - (1. + std::cos(angle)) / (2. * angle * std::sin(angle));
  const Matrix3d S = skew(r);
  return Matrix3d::Identity() - .5 * S + k * S * S;
}

/// The x from which the cost of an answer was measured.
VectorXd preferredOf(const IkResult& result) {
  const IkRequest& request = *result.request;
  if (request.starts.empty()) return request.problem->preferred;
  return request.problem->preferredFor(request.problem->variablesOf(request.starts[std::size_t(result.number)]));
}

class IkNlp final : public Nlp {
 public:
  explicit IkNlp(const IkResult& result)
      : problem_(result.request->problem),
        targets_(result.request->problems[std::size_t(result.number)]),
        preferred_(preferredOf(result)),
        state_(problem_->model, problem_->parameters) {
    const IkProblem& problem = *problem_;
    lower_ = upper_ = result.q;
    for (int v = 0; v < problem.variables(); ++v) {
      lower_[problem.dofs[std::size_t(v)]] = problem.lower[v];
      upper_[problem.dofs[std::size_t(v)]] = problem.upper[v];
    }
    for (std::size_t i = 0; i < problem.tasks.size(); ++i) {
      const IkTask& task = problem.tasks[i];
      const bool is_bound = task.residual && task.target.feature->at_most;
      types_.insert(types_.end(), std::size_t(rowsOf(task)), is_bound ? ObjectiveType::ineq : ObjectiveType::eq);
      if (task.residual) residuals_.push_back(*task.residual);
      task_of_.insert(task_of_.end(), std::size_t(rowsOf(task)), int(i));
    }
    for (std::size_t i = 0; i < targets_.size(); ++i) setTarget(i, targets_[i]);
    findNearPairs(result.q);
    types_.insert(types_.end(), near_.size(), ObjectiveType::ineq);
    first_cost_ = int(types_.size());
    if (problem.has_preference) types_.insert(types_.end(), std::size_t(problem.variables()), ObjectiveType::sos);
    linear_.assign(types_.size(), false);
    std::fill(linear_.begin() + first_cost_, linear_.end(), true);
  }

  const IkProblem& problem() const { return *problem_; }
  const std::vector<IkTarget>& targets() const { return targets_; }

  /// Replaces the numbers of a target.
  void setTarget(std::size_t i, const IkTarget& target) {
    const IkTask& task = problem_->tasks[i];
    if (task.residual) {
      const auto own = std::count_if(problem_->tasks.begin(), problem_->tasks.begin() + std::ptrdiff_t(i),
                                     [](const IkTask& before) { return before.residual != nullptr; });
      residuals_[std::size_t(own)].setTarget(target.value);
    }
    goals_.resize(targets_.size());
    goals_[i] = {target.pose.q.normalized().toRotationMatrix(), target.pose.p};
    if (task.kind() == Kind::direction) goals_[i].p = target.direction.normalized();
  }

  Jacobian makeJacobian() const override {
    Jacobian J = Jacobian::dense(int(types_.size()), dimension());
    for (int v = 0; first_cost_ + v < J.rows(); ++v)
      J.values[std::size_t((first_cost_ + v) * dimension() + problem_->dofs[std::size_t(v)])] = 1.;
    return J;
  }

  void evaluate(const VectorXd& q, VectorXd& phi, Jacobian* J) override {
    state_.setJoints(q.data());
    J_ = J;
    if (J) std::fill_n(J->values.begin(), std::size_t(first_cost_ * dimension()), 0.);
    int row = 0;
    std::size_t feature = 0;
    for (std::size_t i = 0; i < goals_.size(); ++i) {
      const IkTask& task = problem_->tasks[i];
      if (task.residual) {
        evaluateFeature(residuals_[feature++], row, phi);
      } else {
        evaluateFrame(task, goals_[i], row, phi);
      }
      row += rowsOf(task);
    }
    evaluatePairs(row, phi);
    for (int v = 0; first_cost_ + v < phi.size(); ++v)
      phi[first_cost_ + v] = q[problem_->dofs[std::size_t(v)]] - preferred_[v];
  }

  std::string rowName(int row) const override {
    if (row < int(task_of_.size())) {
      const IkTask& task = problem_->tasks[std::size_t(task_of_[std::size_t(row)])];
      return cat(task.goal(), " of ", task.name());
    }
    if (row >= first_cost_)
      return cat("distance from the preferred configuration, ",
                 describeVariable(problem_->dofs[std::size_t(row - first_cost_)]).name);
    const auto [a, b] = problem_->pairs[std::size_t(near_[std::size_t(row) - task_of_.size()])];
    return cat("distance of '", problem_->model->frame_name[std::size_t(a)], "' and '",
               problem_->model->frame_name[std::size_t(b)], "'");
  }

  VariableDescription describeVariable(int dof) const override {
    VariableDescription description;
    description.name = description.frame = jointName(*problem_->model, dof);
    return description;
  }

 private:
  static int rowsOf(const IkTask& task) { return task.hasDirection() ? 3 : task.rows(); }

  void findNearPairs(const VectorXd& q) {
    state_.setJoints(q.data());
    if (!problem_->bodies) return;
    PlacedBodies placed(*problem_->bodies);
    placed.place(state_);
    placed.forMaybeNear(problem_->options.margin + kMayTouch, [&](int pair) {
      if (placed.proximity(pair).distance < problem_->options.margin + kMayTouch) near_.push_back(pair);
    });
  }

  /// Adds the effect of the motion of a frame's link to three rows: `linear` times the velocity of a point, and
  /// `angular` times the angular velocity.
  void addMotion(int row, int frame, const Vector3d& point, const Matrix3d& linear, const Matrix3d& angular) {
    if (frame < 0) return;
    const int n = dimension();
    state_.forTwists(frame, [&](int dof, const State::Twist& twist) {
      const Vector3d column = linear * (twist.linear + twist.angular.cross(point)) + angular * twist.angular;
      for (int k = 0; k < 3; ++k) J_->values[std::size_t((row + k) * n + dof)] += column[k];
    });
  }

  void evaluateFrame(const IkTask& task, const RigidTransform& goal, int row, VectorXd& phi) {
    const RigidTransform X = state_.pose(task.frame),
                         A = task.reference < 0 ? RigidTransform() : state_.pose(task.reference);
    const Matrix3d one = Matrix3d::Identity(), zero = Matrix3d::Zero();
    if (task.hasPosition()) {
      const Vector3d p = A * goal.p;
      phi.segment<3>(row) = X.p - p;
      if (J_) {
        addMotion(row, task.frame, X.p, one, zero);
        addMotion(row, task.reference, p, -one, zero);
      }
      row += 3;
    }
    if (task.hasRotation()) {
      const Vector3d r = logarithm(X.R * (A.R * goal.R).transpose());
      phi.segment<3>(row) = r;
      if (!J_) return;
      const Matrix3d turns = logarithmJacobian(r);
      addMotion(row, task.frame, X.p, zero, turns);
      addMotion(row, task.reference, X.p, zero, -turns.transpose());
    } else if (task.hasDirection()) {
      const bool gazes = task.kind() == Kind::gaze;
      const Vector3d axis = X.R * task.target.axis, point = A * goal.p;
      const Vector3d sight = gazes ? Vector3d(point - X.p) : Vector3d(A.R * goal.p);
      phi.segment<3>(row) = axis.cross(sight);
      if (!J_) return;
      addMotion(row, task.frame, X.p, gazes ? Matrix3d(-skew(axis)) : zero, skew(sight) * skew(axis));
      addMotion(row, task.reference, point, gazes ? skew(axis) : zero,
                gazes ? zero : Matrix3d(-skew(axis) * skew(sight)));
    }
  }

  void evaluateFeature(Residual& residual, int row, VectorXd& phi) {
    const int rows = residual.rows(), n = dimension();
    const State* const state = &state_;
    if (!J_) return residual.eval({&state, 1}, 1., phi.segment(row, rows), nullptr);
    Eigen::Map<RowMajor> block(J_->values.data() + row * n, rows, n);
    JacobianRows view = block;
    residual.eval({&state, 1}, 1., phi.segment(row, rows), &view);
  }

  void evaluatePairs(int row, VectorXd& phi) {
    if (near_.empty()) return;
    PlacedBodies placed(*problem_->bodies);
    placed.place(state_);
    for (const int pair : near_) {
      const Proximity near = placed.proximity(pair);
      const auto [a, b] = problem_->pairs[std::size_t(pair)];
      phi[row] = problem_->options.margin - near.distance;
      const auto add = [&](int frame, const Vector3d& point, double sign) {
        state_.forTwists(frame, [&](int dof, const State::Twist& twist) {
          J_->values[std::size_t(row * dimension() + dof)] +=
              sign * near.rate * near.normal.dot(twist.linear + twist.angular.cross(point));
        });
      };
      if (J_) {
        add(a, near.point_a, -1.);
        add(b, near.point_b, 1.);
      }
      ++row;
    }
  }

  std::shared_ptr<const IkProblem> problem_;
  std::vector<IkTarget> targets_;
  VectorXd preferred_;                 ///< per variable
  std::vector<RigidTransform> goals_;  ///< per target; p holds a direction or the point of a gaze
  std::vector<Residual> residuals_;    ///< of the feature tasks
  std::vector<int> task_of_;           ///< per row of the targets
  std::vector<int> near_;              ///< numbers of the near pairs
  int first_cost_ = 0;
  State state_;
  Jacobian* J_ = nullptr;  ///< the Jacobian that is being filled
};

const IkNlp& requireIk(const Nlp& nlp) {
  const auto* of_ik = dynamic_cast<const IkNlp*>(&nlp);
  if (!of_ik) throw ValueError("the problem was not made from a result of solveIk");
  return *of_ik;
}

class IkTargetNumbers final : public FiniteDifferenceParameter {
 public:
  IkTargetNumbers(const IkNlp& nlp, int target)
      : FiniteDifferenceParameter(cat("target of ", nlp.problem().tasks[std::size_t(target)].name()),
                                  namesOf(nlp, target)),
        target_(std::size_t(target)),
        original_(nlp.targets()[target_]) {}

 private:
  static std::vector<std::string> namesOf(const IkNlp& nlp, int number) {
    const IkTask& task = nlp.problem().tasks[std::size_t(number)];
    std::vector<std::string> names;
    const auto add = [&](const char* what) {
      for (const char* axis : {"x", "y", "z"}) names.push_back(cat(what, " of ", task.name(), ", ", axis));
    };
    if (task.hasPosition()) add("target position");
    if (task.hasRotation()) add("target rotation");
    if (task.kind() == Kind::direction) add("target direction");
    if (task.kind() == Kind::gaze) add("gaze");
    for (int row = 0; task.residual && row < task.residual->feature().rows(); ++row)
      names.push_back(cat("target of ", task.name(), ", row ", row));
    return names;
  }

  void move(Nlp& nlp, int number, double by) override {
    IkTarget target = original_;
    const IkNlp& problem = requireIk(nlp);
    const IkTask& task = problem.problem().tasks[target_];
    const Vector3d axis = Vector3d::Unit(number % 3);
    if (task.residual) {
      const Eigen::Index rows = task.residual->feature().rows();
      if (target.value.size() != rows)
        target.value = VectorXd::Constant(rows, target.value.size() == 1 ? target.value[0] : 0.);
      target.value[number] += by;
    } else if (task.kind() == Kind::direction) {
      target.direction += by * axis;
    } else if (task.hasRotation() && (number >= 3 || !task.hasPosition())) {
      target.pose.q = Quaterniond(Eigen::AngleAxisd(by, axis)) * target.pose.q.normalized();
    } else {
      target.pose.p += by * axis;
    }
    static_cast<IkNlp&>(nlp).setTarget(target_, target);
  }

  std::size_t target_;
  IkTarget original_;
};

}  // namespace

std::shared_ptr<Nlp> makeNlp(const IkResult& result) {
  if (!result.request)
    throw ValueError(
        "the result has no problem, because it was loaded from a file; call solveIk in this process first");
  if (!result.feasible()) throw ValueError(cat("the result is not a solution: ", result.str()));
  return std::make_shared<IkNlp>(result);
}

int ikTargetNumber(const Nlp& nlp, const std::string& name) {
  const std::vector<IkTask>& tasks = requireIk(nlp).problem().tasks;
  std::vector<std::string> known;
  int found = -1, count = 0;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    known.push_back(tasks[i].residual ? tasks[i].residual->name() : tasks[i].target.frame);
    if (known.back() != name) continue;
    found = int(i);
    ++count;
  }
  if (count > 1)
    throw NameError(
        cat("there are ", count, " targets of '", name, "'; expected the number of one, in the order of the targets"));
  if (count == 0)
    throw NameError(
        cat("there is no target of '", name, "'; the targets are of ", join(known), similarHint(name, known)));
  return found;
}

int ikTargetCount(const Nlp& nlp) { return int(requireIk(nlp).targets().size()); }

std::shared_ptr<NlpParameter> ikTarget(const Nlp& nlp, int target) {
  const IkNlp& problem = requireIk(nlp);
  const int count = int(problem.targets().size());
  if (target < 0 || target >= count) throw ValueError(cat("there is no target ", target, "; there are ", count));
  return std::make_shared<IkTargetNumbers>(problem, target);
}

}  // namespace kinegraph
