#include "kinegraph/control/diff_ik.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/features/distance.h"
#include "kinegraph/scene/motor_limits.h"

namespace kinegraph {

namespace {

constexpr double kNoBound = std::numeric_limits<double>::infinity();
constexpr double kElasticity = 1e8;  // cost of the square of what dampers give way, in units of the largest other cost
constexpr double kGivesWay = 1e-9;   // rad or m, from which on it is told

void checkLimits(const char* name, const VectorXd& limits, int dofs) {
  if (limits.size() != 0 && limits.size() != dofs)
    throw ValueError(cat("DiffIk: ", name, " has ", limits.size(), " entries; the scene has ", dofs, " dofs"));
  if ((limits.array() > 0.).all()) return;
  throw ValueError(cat("DiffIk: ", name, " has entries that are not positive"));
}

/// The largest speed from which a joint can brake before `gap` ends, if it goes on for `dt` first.
double brakingSpeed(double gap, double acceleration, double dt) {
  return acceleration * (std::sqrt(dt * dt + 2. * gap / acceleration) - dt);
}

}  // namespace

void DiffIkOptions::validate(int dofs) const {
  checkLimits("velocity", velocity, dofs);
  checkLimits("acceleration", acceleration, dofs);
  const auto check = [](const char* name, double value, double most) {
    if (!(value > 0. && value <= most))
      throw ValueError(cat("DiffIk: ", name, " is ", value, "; expected a number > 0",
                           most < kNoBound ? cat(", at most ", most) : ""));
  };
  if (!(posture >= 0.)) throw ValueError(cat("DiffIk: posture is ", posture, "; expected a number >= 0"));
  check("damping", damping, kNoBound);
  check("collision_gain", collision_gain, 1.);
  check("range", range, kNoBound);
  if (!std::isfinite(margin)) throw ValueError(cat("DiffIk: margin is ", margin, "; expected a finite number (m)"));
}

DiffIk::DiffIk(const Config& config, const DiffIkOptions& options)
    : config_(config.scene()), options_(options), posture_(config.getJointState()) {
  options_.validate(config_.getJointDimension());
  prepare();
}

/// What follows from the structure of the scene.
void DiffIk::prepare() {
  program_ = config_.program();
  const int n = config_.getJointDimension();
  if (posture_.size() != n) posture_ = config_.getJointState();
  options_.validate(n);
  limits_ = config_.getJointLimits();
  velocity_limit_ = options_.velocity.size() ? options_.velocity : getVelocityLimits(config_);
  acceleration_limit_ = options_.acceleration.size() ? options_.acceleration : VectorXd::Constant(n, kNoBound);
  velocity_.setZero(n), change_.setZero(n), low_.resize(n), high_.resize(n);
  gradient_row_.resize(n), cost_.resize(n, n), slope_.resize(n), elastic_row_.resize(n + 1);
  std::vector<std::pair<int, int>> moving;
  if (options_.collisions)
    for (const auto& [a, b] : program_->collidable())
      if (program_->movesApart(a, b)) moving.emplace_back(a, b);
  pairs_ = std::make_unique<BodyPairs>(*program_, moving);
  bodies_ = std::make_unique<PlacedBodies>(*pairs_);
  const int rows = 2 * n + int(moving.size());
  rows_.resize(n, rows), bounds_.resize(rows), meanings_.reserve(std::size_t(rows)),
      gave_way_.reserve(std::size_t(rows));
  program_rigid_.resize(n, rows), program_elastic_.resize(n + 1, rows + 1);
  for (Task& task : tasks_) {
    task.residual.clear();
    task.residual.push_back(makeResidual(config_.state(), task.feature, task.frames, task.weight, task.target));
    task.y.resize(task.residual[0].rows()), task.J.resize(task.residual[0].rows(), n);
  }
}

int DiffIk::addTask(const FeatureSource& feature, const std::vector<std::string>& frames, double weight, double gain,
                    const VectorXd& target) {
  if (!(gain > 0. && gain <= 1.)) throw ValueError(cat("DiffIk: gain is ", gain, "; expected a number in (0, 1]"));
  Residual residual = makeResidual(config_.state(), feature, frames, weight, target);
  if (residual.order() > 0)
    throw ValueError(
        cat("DiffIk: ", residual.name(), " is of order ", residual.order(), "; expected a feature of one q"));
  const int rows = residual.rows();
  tasks_.push_back({feature, frames, weight, gain, target, {std::move(residual)}, VectorXd(rows), {}});
  tasks_.back().J.resize(rows, config_.getJointDimension());
  return int(tasks_.size()) - 1;
}

void DiffIk::setTarget(int task, const VectorXd& target) {
  if (task < 0 || task >= int(tasks_.size()))
    throw ValueError(cat("DiffIk: there is no task ", task, "; there are ", tasks_.size()));
  tasks_[std::size_t(task)].residual[0].setTarget(target);
  tasks_[std::size_t(task)].target = target;
}

void DiffIk::setPosture(const VectorXd& q) {
  if (q.size() != config_.getJointDimension())
    throw ValueError(
        cat("DiffIk: the posture has ", q.size(), " numbers; the scene has ", config_.getJointDimension(), " dofs"));
  posture_ = q;
}

void DiffIk::addCosts(const VectorXd& q) {
  const double pull = options_.posture * options_.posture;
  cost_.setZero();
  cost_.diagonal().setConstant(pull + options_.damping);
  slope_ = pull * (q - posture_);
  for (Task& task : tasks_) {
    task.J.setZero();
    eval(config_, task.residual[0], task.y, task.J);
    cost_.noalias() += task.J.transpose() * task.J;
    slope_.noalias() += task.gain * task.J.transpose() * task.y;
  }
}

/// One interval per joint for all of its limits. Accelerations come first: within what they leave, as near as can be to
/// what positions and velocities ask.
void DiffIk::addIntervals(const VectorXd& q, double dt) {
  for (int j = 0; j < q.size(); ++j) {
    const double most = velocity_limit_[j], change = acceleration_limit_[j] * dt;
    double low = -most, high = most;
    if (limits_(0, j) < limits_(1, j)) {
      const auto toLimit = [&](double gap) {
        if (gap < 0.) return std::max(gap / dt, -most);
        const double within_step = gap / dt;
        return std::min({most, within_step, std::isfinite(change) ? brakingSpeed(gap, change / dt, dt) : kNoBound});
      };
      low = -toLimit(q[j] - limits_(0, j)), high = toLimit(limits_(1, j) - q[j]);
    }
    const double from = velocity_[j] - change, to = velocity_[j] + change;
    const double missed = std::max({0., from - high, low - to});
    if (missed * dt > kGivesWay)
      gave_way_.push_back({{from > high ? Meaning::Kind::upper : Meaning::Kind::lower, j, 0.}, missed * dt});
    low = std::clamp(low, from, to), high = std::clamp(high, from, to);
    low_[j] = low * dt, high_[j] = high * dt;
    const auto add = [&](double sign, double bound, Meaning::Kind kind) {
      if (!std::isfinite(bound)) return;
      const Eigen::Index row = Eigen::Index(meanings_.size());
      rows_.col(row).setZero();
      rows_(j, row) = sign, bounds_[row] = sign * bound;
      meanings_.push_back({kind, j, 0.});
    };
    add(1., low_[j], Meaning::Kind::lower);
    add(-1., high_[j], Meaning::Kind::upper);
  }
}

/// Where accelerations are limited, a pair comes no nearer than joints can brake with half of what they have; the other
/// half is for other pairs, and for gradients that turn.
void DiffIk::addDampers(const State& state, double dt) {
  const bool must_brake = acceleration_limit_.allFinite();
  if (pairs_->pairs.empty()) return;
  bodies_->place(state);
  bodies_->forMaybeNear(options_.range, [&](int pair) {
    const Proximity near = bodies_->proximity(pair);
    if (near.distance >= options_.range) return;
    const auto [a, b] = pairs_->pairs[std::size_t(pair)];
    gradient_row_.setZero();
    JacobianRows row(gradient_row_);
    addDistanceGradient(state, pairs_->frames[std::size_t(a)], pairs_->frames[std::size_t(b)], near, 1., row);
    const Eigen::Index at = Eigen::Index(meanings_.size());
    rows_.col(at) = gradient_row_.transpose();
    const double gap = near.distance - options_.margin;
    double most = options_.collision_gain * gap;
    const double deceleration = must_brake ? .5 * gradient_row_.cwiseAbs() * acceleration_limit_ : 0.;
    if (gap > 0. && deceleration > 0.) most = std::min(most, brakingSpeed(gap, deceleration, dt) * dt);
    bounds_[at] = -most;
    meanings_.push_back({Meaning::Kind::pair, pair, near.distance});
  });
}

/// Exactly, where all rows can hold; else dampers share a slack, whose square costs more than all else.
void DiffIk::solve() {
  const int n = int(slope_.size()), count = int(meanings_.size());
  program_rigid_.clear();
  program_rigid_.hessian() = cost_, program_rigid_.gradient() = slope_;
  for (int r = 0; r < count; ++r) program_rigid_.addRow(rows_.col(r), bounds_[r]);
  is_elastic_ = !program_rigid_.solve();
  if (!is_elastic_) {
    change_ = program_rigid_.x();
  } else {
    program_elastic_.clear();
    program_elastic_.hessian().setZero();
    program_elastic_.hessian().topLeftCorner(n, n) = cost_;
    program_elastic_.hessian()(n, n) = kElasticity * cost_.diagonal().maxCoeff();
    program_elastic_.gradient().head(n) = slope_;
    program_elastic_.gradient()[n] = 0.;
    for (int r = 0; r < count; ++r) {
      elastic_row_.head(n) = rows_.col(r);
      elastic_row_[n] = meanings_[std::size_t(r)].kind == Meaning::Kind::pair ? 1. : 0.;
      program_elastic_.addRow(elastic_row_, bounds_[r]);
    }
    if (program_elastic_.solve()) {
      change_ = program_elastic_.x().head(n);
    } else {  // rounding: stand still, as far as accelerations allow
      change_.setZero();
    }
  }
  change_ = change_.cwiseMax(low_).cwiseMin(high_);
  for (int r = 0; r < count; ++r) {
    const double by = bounds_[r] - rows_.col(r).dot(change_);
    if (is_elastic_ && by > kGivesWay) gave_way_.push_back({meanings_[std::size_t(r)], by});
  }
}

const VectorXd& DiffIk::step(double dt, bool apply) {
  if (!(dt > 0.)) throw ValueError(cat("DiffIk: dt is ", dt, "; expected a number > 0 (s)"));
  if (config_.program() != program_) prepare();
  const State& state = config_.state();
  q_ = config_.getJointState();
  meanings_.clear(), gave_way_.clear();
  addCosts(q_);
  addIntervals(q_, dt);
  addDampers(state, dt);
  solve();
  velocity_ = change_ / dt;
  if (apply) config_.setJointState(q_ + change_);
  return velocity_;
}

std::string DiffIk::text(const Meaning& meaning) const {
  if (meaning.kind == Meaning::Kind::pair) {
    const auto [a, b] = pairs_->pairs[std::size_t(meaning.index)];
    const auto name = [&](int place) {
      return cat("'", program_->frame_name[std::size_t(pairs_->frames[std::size_t(place)])], "'");
    };
    return cat(name(a), " and ", name(b), " at ", meaning.value, " m");
  }
  return cat(meaning.kind == Meaning::Kind::upper ? "upper" : "lower", " limit of '",
             config_.getJointNames()[std::size_t(meaning.index)], "'");
}

std::vector<std::string> DiffIk::active() const {
  const ActiveSet& program = is_elastic_ ? program_elastic_ : program_rigid_;
  std::vector<std::string> words;
  for (int i = 0; i < program.activeCount(); ++i)
    if (program.active(i) < int(meanings_.size())) words.push_back(text(meanings_[std::size_t(program.active(i))]));
  return words;
}

std::string DiffIk::message() const {
  std::vector<std::string> words;
  for (const GaveWay& row : gave_way_) words.push_back(cat(text(row.meaning), " by ", row.by));
  return words.empty() ? "" : cat("gave way: ", join(words));
}

}  // namespace kinegraph
