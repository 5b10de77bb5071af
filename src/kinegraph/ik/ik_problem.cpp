#include "kinegraph/ik/ik_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/kinematics/chains.h"

namespace kinegraph {

namespace {

constexpr double kLongestTurn = .5;  // rad

/// Per dof: does it turn, so that without limits a full turn is worth trying?
std::vector<char> turningDofs(const KinematicModel& model) {
  std::vector<char> turns(model.dofs, 0);
  for (std::size_t l = 1; l < model.links.size(); ++l) {
    const KinematicModel::Link& link = model.links[l];
    int dof = link.dof;
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
      turns[dof] = model.steps[s].turns();
      dof += model.steps[s].dofs();
    }
  }
  return turns;
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
  }
  chooseVariables(state);
  for (const Task& task : tasks) requireAtRest(task);
  const double weight = options.start_weight + options.home_weight;
  pulls = weight > 0.;
  nearest.resize(variables());
  for (int v = 0; v < variables(); ++v) {
    const double home = model->home[dofs[v]], start = q[dofs[v]];
    nearest[v] = pulls ? (options.start_weight * start + options.home_weight * home) / weight : start;
  }
  nearest = nearest.cwiseMax(lower).cwiseMin(upper);
  if (options.collisions) choosePairs();
  bodies.emplace(*model, pairs);
}

void IkProblem::chooseVariables(const State& state) {
  // Joints that move no target stay where they are, and need no columns.
  variable.assign(model->dofs, -1);
  for (const Task& task : tasks) {
    const std::vector<int> moving = task.dofs(state);
    if (moving.empty()) {
      const std::string against = task.reference < 0 ? "" : cat(" relative to '", task.target.relative_to, "'");
      throw ValueError(cat("solveIk: no active joint ", task.frame < 0 ? "changes " : "moves ", task.name(), against));
    }
    for (const int dof : moving) variable[dof] = 0;
  }
  // Quaternions are not kept at norm one by the steps, so it is noted where they are.
  for (const KinematicModel::DofRange& norm : model->unit_norms) {
    if (variable[norm.first] == 0) norms_.emplace_back(norm.first, norm.count);
  }
  for (int dof = 0; dof < model->dofs; ++dof) {
    if (variable[dof] < 0) continue;
    variable[dof] = int(dofs.size());
    dofs.push_back(dof);
  }
  for (auto& norm : norms_) norm.first = variable[norm.first];
  // Steps of angles are bounded, because their linear model is good for about half a radian. Where there is no limit,
  // starting points are drawn around the present value: all angles, and a meter to both sides.
  const std::vector<char> turns = turningDofs(*model);
  lower.resize(variables());
  upper.resize(variables());
  longest.resize(variables());
  draw_lower_.resize(variables());
  draw_upper_.resize(variables());
  for (int v = 0; v < variables(); ++v) {
    const int dof = dofs[v];
    lower[v] = model->lower[dof];
    upper[v] = model->upper[dof];
    longest[v] = turns[dof] ? kLongestTurn : std::numeric_limits<double>::infinity();
    const double reach = turns[dof] ? std::numbers::pi : 1.;
    draw_lower_[v] = std::isfinite(lower[v]) ? lower[v] : std::min(q[dof], upper[v]) - reach;
    draw_upper_[v] = std::isfinite(upper[v]) ? upper[v] : std::max(q[dof], lower[v]) + reach;
  }
  // Entries of quaternions are drawn from the cube around the sphere, and brought to norm one.
  for (const auto& [first, count] : norms_) {
    for (int v = first; v < first + count; ++v) {
      longest[v] = kLongestTurn;
      draw_lower_[v] = std::max(lower[v], -1.);
      draw_upper_[v] = std::min(upper[v], 1.);
    }
  }
  sequence_ = LowDiscrepancy(variables(), options.seed);
}

/// A pose that was taken from a frame must not be left by it while the targets are gone for.
void IkProblem::requireAtRest(const Task& task) const {
  const std::string& from = task.target.taken_from;
  if (from.empty()) return;
  int mover = -1;
  forColumnsBetween(*model, frameId(*model, from, "solveIk"), task.reference, [&](int column) {
    if (mover < 0 && variable[model->column_dof[column]] >= 0) mover = model->column_dof[column];
  });
  if (mover < 0) return;
  const std::string against = task.reference < 0 ? "" : cat(" against '", task.target.relative_to, "'");
  throw ValueError(cat("solveIk: the target of ", task.name(), " is where frame '", from, "' is, which moves", against,
                       " with joint '", jointName(*model, mover), "', as the targets do; to meet it wherever it goes, ",
                       "say relativeTo '", from, "'; to go where it is now, give its pose as numbers"));
}

void IkProblem::choosePairs() {
  const auto moves = [&](int column) { return variable[model->column_dof[column]] >= 0; };
  std::vector<std::pair<int, int>> unmoved;
  for (const auto& pair : model->movingPairs()) {
    const bool moved = anyColumnBetween(*model, pair.first, pair.second, moves);
    (moved ? pairs : unmoved).push_back(pair);
  }
  if (!unmoved.empty()) describeStuck(unmoved);
}

/// No answer can be free where other joints than the variables hold a pair too near.
void IkProblem::describeStuck(const std::vector<std::pair<int, int>>& unmoved) {
  constexpr int kNamed = 3;
  State state(model, parameters);
  state.setJoints(q.data());
  const BodyPairs listed(*model, unmoved);
  PlacedBodies placed(listed);
  placed.place(state);
  std::vector<std::string> reasons;
  placed.forMaybeNear(options.margin, [&](int pair) {
    const double distance = placed.proximity(pair).distance;
    if (distance >= options.margin) return;
    const auto [a, b] = unmoved[std::size_t(pair)];
    const std::string how = distance < 0. ? cat("overlap by ", -distance, " m") : cat("are ", distance, " m apart");
    reasons.push_back(cat("frames '", model->frame_name[a], "' and '", model->frame_name[b], "' ", how));
  });
  if (reasons.empty()) return;
  const std::size_t more = reasons.size() > kNamed ? reasons.size() - kNamed : 0;
  reasons.resize(reasons.size() - more);
  in_the_way = cat(join(reasons, "; "), more > 0 ? cat("; and ", more, " more pairs") : "",
                   "; no joint that moves a target parts them");
}

void IkProblem::startingPoint(int i, double* x) const {
  for (int v = 0; v < variables(); ++v) {
    x[v] = i == 0 ? q[dofs[v]] : draw_lower_[v] + (draw_upper_[v] - draw_lower_[v]) * sequence_.at(i, v);
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

}  // namespace kinegraph
