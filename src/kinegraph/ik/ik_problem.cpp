#include "kinegraph/ik/ik_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/ik/target_questions.h"
#include "kinegraph/kinematics/chains.h"

namespace kinegraph::inline ik_internal {

namespace {

constexpr double kLongestRotation = .5;  // rad

/// Per dof: true for rotations, whose starting points cover a full rotation if there are no limits.
std::vector<char> rotationalDofs(const KinematicModel& model) {
  std::vector<char> rotates(model.dofs, 0);
  for (std::size_t l = 1; l < model.links.size(); ++l) {
    const KinematicModel::Link& link = model.links[l];
    int dof = link.dof;
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
      rotates[dof] = model.steps[s].rotates();
      dof += model.steps[s].dofs();
    }
  }
  return rotates;
}

}  // namespace

IkProblem::IkProblem(const Config& config, const std::vector<IkTarget>& targets, const IkOptions& given)
    : options(given), model(config.model()), parameters(config.parameters()) {
  options.validate();
  if (targets.empty())
    throw ValueError("solveIk: there are no targets; expected at least one frame with a pose, position or direction");
  if (options.best && options.start_weight + options.home_weight == 0.) options.start_weight = 1.;
  q = config.getJointState().cwiseMax(model->lower).cwiseMin(model->upper);
  State state(model, parameters);
  state.setJoints(q.data());
  for (const IkTarget& target : targets) {
    tasks.emplace_back(state, target);
    rows += tasks.back().rows();
    if (question.empty()) question = askAboutOrder(tasks.back(), state);
  }
  chooseVariables(state);
  for (const Task& task : tasks) requireAtRest(task);
  const double weight = options.start_weight + options.home_weight;
  has_preference = weight > 0.;
  preferred = preferredFor(variablesOf(q));
  if (options.collisions) choosePairs();
  bodies.emplace(*model, pairs);
}

void IkProblem::chooseVariables(const State& state) {
  // Joints that move no target keep their values and need no columns.
  variable.assign(model->dofs, -1);
  for (const Task& task : tasks) {
    const std::vector<int> moving = task.dofs(state);
    if (moving.empty()) {
      const std::string against = task.reference < 0 ? "" : cat(" relative to '", task.target.relative_to, "'");
      throw ValueError(cat("solveIk: no active joint ", task.frame < 0 ? "changes " : "moves ", task.name(), against));
    }
    for (const int dof : moving) variable[dof] = 0;
  }
  // Steps do not preserve the norm of quaternions, so their variables are listed for normalize().
  for (const KinematicModel::DofRange& norm : model->unit_norms) {
    if (variable[norm.first] == 0) norms_.emplace_back(norm.first, norm.count);
  }
  for (int dof = 0; dof < model->dofs; ++dof) {
    if (variable[dof] < 0) continue;
    variable[dof] = int(dofs.size());
    dofs.push_back(dof);
  }
  for (auto& norm : norms_) norm.first = variable[norm.first];
  // Steps of angles are bounded because their linear model is accurate up to about half a radian. Without limits,
  // starting points are sampled around the present value: full rotations for angles, one meter to both sides otherwise.
  const std::vector<char> rotates = rotationalDofs(*model);
  lower.resize(variables());
  upper.resize(variables());
  longest.resize(variables());
  sample_lower_.resize(variables());
  sample_upper_.resize(variables());
  for (int v = 0; v < variables(); ++v) {
    const int dof = dofs[v];
    lower[v] = model->lower[dof];
    upper[v] = model->upper[dof];
    longest[v] = rotates[dof] ? kLongestRotation : std::numeric_limits<double>::infinity();
    const double reach = rotates[dof] ? std::numbers::pi : 1.;
    sample_lower_[v] = std::isfinite(lower[v]) ? lower[v] : std::min(q[dof], upper[v]) - reach;
    sample_upper_[v] = std::isfinite(upper[v]) ? upper[v] : std::max(q[dof], lower[v]) + reach;
  }
  // Entries of quaternions are sampled in the cube around the unit sphere and then normalized.
  for (const auto& [first, count] : norms_) {
    for (int v = first; v < first + count; ++v) {
      longest[v] = kLongestRotation;
      sample_lower_[v] = std::max(lower[v], -1.);
      sample_upper_[v] = std::min(upper[v], 1.);
    }
  }
  sequence_ = LowDiscrepancy(variables(), options.seed);
}

/// Throws ValueError if the targets move a frame whose pose was taken as a target.
void IkProblem::requireAtRest(const Task& task) const {
  const std::string& from = task.target.taken_from;
  if (from.empty()) return;
  int mover = -1;
  forColumnsBetween(*model, frameId(*model, from, "solveIk"), task.reference, [&](int column) {
    if (mover < 0 && variable[model->column_dof[column]] >= 0) mover = model->column_dof[column];
  });
  if (mover < 0) return;
  const std::string against = task.reference < 0 ? "" : cat(" against '", task.target.relative_to, "'");
  throw ValueError(cat("solveIk: the target of ", task.name(), " is the pose of frame '", from, "', which moves",
                       against, " with joint '", jointName(*model, mover), "', like the targets; pass relativeTo '",
                       from, "' to follow it, or its present pose as numbers"));
}

void IkProblem::choosePairs() {
  const auto moves = [&](int column) { return variable[model->column_dof[column]] >= 0; };
  std::vector<std::pair<int, int>> unmoved;
  for (const auto& pair : model->movingPairs()) {
    const bool moved = anyColumnBetween(*model, pair.first, pair.second, moves);
    (moved ? pairs : unmoved).push_back(pair);
  }
  if (!unmoved.empty()) describeUnmoved(unmoved);
}

/// Describes pairs that are too close and that no variable can separate. If one is deep, no answer is collision-free.
/// The others, such as fingers that touch, have nothing to do with the targets.
void IkProblem::describeUnmoved(const std::vector<std::pair<int, int>>& unmoved) {
  constexpr std::size_t kNamed = 3;
  State state(model, parameters);
  state.setJoints(q.data());
  const BodyPairs listed(*model, unmoved);
  PlacedBodies placed(listed);
  placed.place(state);
  std::vector<std::string> deep, shallow;
  placed.forMaybeNear(options.margin, [&](int pair) {
    const double distance = placed.proximity(pair).distance;
    if (distance >= options.margin) return;
    const auto [a, b] = unmoved[std::size_t(pair)];
    const std::string how = distance < 0. ? cat("overlap by ", -distance, " m") : cat("are ", distance, " m apart");
    (distance < -options.max_start_penetration ? deep : shallow)
        .push_back(cat("frames '", model->frame_name[a], "' and '", model->frame_name[b], "' ", how));
  });
  const auto text = [](std::vector<std::string>& reasons) {
    const std::size_t more = reasons.size() > kNamed ? reasons.size() - kNamed : 0;
    reasons.resize(reasons.size() - more);
    return cat(join(reasons, "; "), more > 0 ? cat("; and ", more, " more pairs") : "",
               "; no joint that moves a target separates them");
  };
  if (!deep.empty()) blocking = text(deep);
  if (!shallow.empty())
    slight = cat(text(shallow),
                 ", so the answer keeps it; move them apart, or leave the pair out of collision checks "
                 "(ignoreCollisionsNow)");
}

VectorXd IkProblem::variablesOf(const VectorXd& from) const {
  VectorXd x(variables());
  for (int v = 0; v < variables(); ++v) x[v] = from[dofs[v]];
  return x.cwiseMax(lower).cwiseMin(upper);
}

VectorXd IkProblem::preferredFor(const VectorXd& start) const {
  VectorXd x = start;
  const double weight = options.start_weight + options.home_weight;
  for (int v = 0; v < variables() && has_preference; ++v)
    x[v] = (options.start_weight * start[v] + options.home_weight * model->home[dofs[v]]) / weight;
  return x.cwiseMax(lower).cwiseMin(upper);
}

void IkProblem::startingPoint(int i, double* x, const VectorXd& first) const {
  for (int v = 0; v < variables(); ++v) {
    x[v] = i == 0 ? (first.size() > 0 ? first[v] : q[dofs[v]])
                  : sample_lower_[v] + (sample_upper_[v] - sample_lower_[v]) * sequence_.at(i, v);
  }
  normalize(x);
}

void IkProblem::normalize(double* x) const {
  for (const auto& [first, count] : norms_) {
    double square = 0.;
    for (int v = first; v < first + count; ++v) square += x[v] * x[v];
    if (square < 1e-20) {
      x[first] = 1.;
      continue;
    }
    for (int v = first; v < first + count; ++v) x[v] /= std::sqrt(square);
  }
}

const std::string& jointName(const KinematicModel& model, int dof) {
  const auto owner = std::ranges::find_if(model.frame_dofs, [&](const KinematicModel::DofRange& range) {
    return dof >= range.first && dof < range.first + range.count;
  });
  return model.frame_name[std::size_t(owner - model.frame_dofs.begin())];
}

}  // namespace kinegraph::inline ik_internal
