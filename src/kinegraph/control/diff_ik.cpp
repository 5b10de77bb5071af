#include "kinegraph/control/diff_ik.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinegraph/collision/near_pairs.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/control/chatter_damping.h"
#include "kinegraph/control/diff_ik_task.h"
#include "kinegraph/features/distance.h"
#include "kinegraph/features/make_residual.h"
#include "kinegraph/scene/dynamics.h"
#include "kinegraph/solvers/algebra/dual_active_set.h"

namespace kinegraph {

namespace {

constexpr double kNoBound = std::numeric_limits<double>::infinity();
constexpr double kReported = 1e-9;   // smallest relaxation that is reported, rad or m
constexpr double kLoosened = 1e-10;  // of all constraints after a contradiction, rad or m: rounding
constexpr double kLeastStep = 1e-8;  // cost of the squared step beside that of the squared violations
constexpr int kMaxRelaxations = 30;  // Newton steps toward the least violation, and bisections of each
constexpr double kStiffer[] = {0., 1e-10,
                               1e-7};       // damping relative to the largest cost, if rounding prevents a solution
constexpr double kReportedEquality = 1e-6;  // the same of equalities, in units of the feature
constexpr double kSpanned = 1e-6;           // a gradient with a smaller share in the free directions is fixed already
constexpr double kStuck = .5;               // a task is stuck if a step leaves more than this share of it

void checkLimits(const char* name, const VectorXd& limits, int dofs) {
  if (limits.size() != 0 && limits.size() != dofs)
    throw ValueError(cat("DiffIk: ", name, " has ", limits.size(), " entries; the scene has ", dofs, " dofs"));
  if ((limits.array() > 0.).all()) return;
  throw ValueError(cat("DiffIk: ", name, " has entries that are not positive; expected numbers > 0"));
}

/// Returns the largest speed from which a joint can brake within `gap`, if it keeps that speed for `dt` first.
double brakingSpeed(double gap, double acceleration, double dt) {
  return acceleration * (std::sqrt(dt * dt + 2. * gap / acceleration) - dt);
}

}  // namespace

void DiffIkOptions::validate(int dofs) const {
  checkLimits("velocity", velocity, dofs);
  checkLimits("acceleration", acceleration, dofs);
  const auto check = [](const char* name, double value, double largest) {
    if (!(value > 0. && value <= largest))
      throw ValueError(
          cat("DiffIk: ", name, " is ", value, "; expected a number > 0", largest == 1. ? ", at most 1" : ""));
  };
  constexpr double kLargest = std::numeric_limits<double>::max();
  if (!(posture >= 0. && posture <= kLargest))
    throw ValueError(cat("DiffIk: posture is ", posture, "; expected a finite number >= 0"));
  check("damping", damping, kLargest);
  check("collision_gain", collision_gain, 1.);
  check("influence_distance", influence_distance, kLargest);
  if (!std::isfinite(margin)) throw ValueError(cat("DiffIk: margin is ", margin, "; expected a finite number (m)"));
}

DiffIk::~DiffIk() = default;
DiffIk::DiffIk(DiffIk&&) noexcept = default;
DiffIk& DiffIk::operator=(DiffIk&&) noexcept = default;

DiffIk::DiffIk(Config& config, const DiffIkOptions& options)
    : config_(config.scene()),
      options_(options),
      posture_(config.getJointState()),
      program_(std::make_unique<DualActiveSet>(kDependence)) {
  options_.validate(config_.getJointDimension());
  prepare();
}

/// Sets all members that depend on the structure of the scene.
void DiffIk::prepare() {
  model_ = config_.model();
  const int n = config_.getJointDimension();
  if (posture_.size() != n) posture_ = config_.getJointState();
  options_.validate(n);
  limits_ = config_.getJointLimits();
  velocity_limit_ = options_.velocity.size() ? options_.velocity : getVelocityLimits(config_);
  acceleration_limit_ = options_.acceleration.size() ? options_.acceleration : VectorXd::Constant(n, kNoBound);
  velocity_.setZero(n), change_.setZero(n), low_.resize(n), high_.resize(n);
  if (!chatter_) chatter_ = std::make_unique<ChatterDamping>();
  chatter_->reset(n);
  gradient_row_.resize(n), cost_.resize(n, n), slope_.resize(n), direction_.resize(n);
  std::vector<std::pair<int, int>> moving;
  if (options_.collisions)
    for (const auto& [a, b] : model_->collidable())
      if (model_->movesApart(a, b)) moving.emplace_back(a, b);
  pairs_ = std::make_unique<BodyPairs>(*model_, moving);
  bodies_ = std::make_unique<PlacedBodies>(*pairs_);
  const int rows = 2 * n + int(moving.size());
  normals_.resize(n, rows), bounds_.resize(rows), sources_.reserve(std::size_t(rows)),
      relaxed_.reserve(std::size_t(rows));
  slack_.setZero(rows), excess_.resize(rows), rate_.resize(rows);
  program_->resize(n, rows);
  active_.reserve(std::size_t(rows));
  free_.resize(n, n), product_.resize(n, n), reduced_cost_.resize(n, n), along_.resize(n);
  for (Task& task : tasks_) {
    task.residual.clear();
    task.residual.push_back(makeResidual(config_.state(), task.feature, task.frames, task.weight, task.target));
    task.makeRoom(n);
  }
}

int DiffIk::addTask(const FeatureSource& feature, const std::vector<std::string>& frames, double weight, double gain,
                    const VectorXd& target, int priority) {
  if (!(weight >= 0.)) throw ValueError(cat("DiffIk: weight is ", weight, "; expected a number >= 0"));
  if (priority == kEquality)
    throw ValueError(cat("DiffIk: priority is ", priority, ", which is reserved for equalities"));
  return add({feature, frames, weight, gain, target, priority, {}, {}, {}});
}

int DiffIk::addEquality(const FeatureSource& feature, const std::vector<std::string>& frames, double gain,
                        const VectorXd& target) {
  return add({feature, frames, 1., gain, target, kEquality, {}, {}, {}});
}

int DiffIk::add(Task task) {
  if (!(task.gain > 0. && task.gain <= 1.))
    throw ValueError(cat("DiffIk: gain is ", task.gain, "; expected a number in (0, 1]"));
  Residual residual = makeResidual(config_.state(), task.feature, task.frames, task.weight, task.target);
  if (residual.order() > 0)
    throw ValueError(cat("DiffIk: ", residual.name(), " is of order ", residual.order(),
                         "; expected a feature of one configuration"));
  task.residual.push_back(std::move(residual));
  task.makeRoom(config_.getJointDimension());
  const auto place = std::lower_bound(priorities_.begin(), priorities_.end(), task.priority);
  if (place == priorities_.end() || *place != task.priority) priorities_.insert(place, task.priority);
  tasks_.push_back(std::move(task));
  relaxed_.reserve(std::size_t(normals_.cols()) + tasks_.size());
  return int(tasks_.size()) - 1;
}

void DiffIk::setTarget(int task, const VectorXd& target) {
  if (task < 0 || task >= int(tasks_.size()))
    throw ValueError(cat("DiffIk: there is no task ", task, "; the number of tasks is ", tasks_.size()));
  tasks_[std::size_t(task)].residual[0].setTarget(target);
  tasks_[std::size_t(task)].target = target;
}

void DiffIk::setPosture(const VectorXd& q) {
  if (q.size() != config_.getJointDimension())
    throw ValueError(
        cat("DiffIk: the posture has ", q.size(), " entries; the scene has ", config_.getJointDimension(), " dofs"));
  if (!q.allFinite()) throw ValueError("DiffIk: the posture has entries that are not finite");
  posture_ = q;
}

/// Computes the quadratic cost of the tasks of a priority; the last one also has the cost of the posture.
void DiffIk::addCosts(const VectorXd& q, int priority, bool is_last) {
  const double weight = is_last ? options_.posture * options_.posture : 0.;
  double curvature = 0.;
  cost_.setZero();
  cost_.diagonal().setConstant(weight + options_.damping);
  slope_ = weight * (q - posture_);
  for (Task& task : tasks_) {
    if (task.priority != priority) continue;
    task.J_before.swap(task.J);
    task.J.setZero();
    eval(config_, task.residual[0], task.y, task.J);
    // At most that of a hinge, which turns J: what else moves the scene is no curvature.
    const double moved = chatter_->moved();
    if (moved > 0.) task.curvature.bend = std::min((task.J - task.J_before).norm() / moved, task.J.norm());
    curvature += task.curvature.of(task.y);
    cost_.noalias() += task.J.transpose() * task.J;
    slope_.noalias() += task.gain * task.J.transpose() * task.y;
  }
  cost_.diagonal() += curvature * chatter_->damping();
}

/// Learns which tasks the step does not attain, and which joints it moves back.
void DiffIk::learnChatter() {
  for (Task& task : tasks_) {
    task.findLeft(change_);
    task.curvature.is_stuck = task.left.norm() > kStuck * task.gain * task.y.norm();
  }
  chatter_->add(change_);
}

/// Adds one interval per joint for all of its limits. If they contradict each other, the acceleration limits hold, and
/// the interval is as close as possible to the limits of position and velocity.
void DiffIk::addIntervals(const VectorXd& q, double dt) {
  for (int j = 0; j < q.size(); ++j) {
    const double fastest = velocity_limit_[j], change = acceleration_limit_[j] * dt;
    const auto toLimit = [&](double gap) {
      if (gap < 0.) return std::max(gap / dt, -fastest);
      const double braking =
          std::isfinite(change) && std::isfinite(gap) ? brakingSpeed(gap, change / dt, dt) : kNoBound;
      return std::min({fastest, gap / dt, braking});
    };
    double low = -toLimit(q[j] - limits_(0, j)), high = toLimit(limits_(1, j) - q[j]);
    const double from = velocity_[j] - change, to = velocity_[j] + change;
    const double missed = std::max({0., from - high, low - to});
    if (missed * dt > kReported)
      relaxed_.push_back({{from > high ? Source::Kind::upper : Source::Kind::lower, j, 0.}, missed * dt});
    low = std::clamp(low, from, to), high = std::clamp(high, from, to);
    low_[j] = low * dt, high_[j] = high * dt;
    const auto add = [&](double sign, double bound, Source::Kind kind) {
      if (!std::isfinite(bound)) return;
      const Eigen::Index i = Eigen::Index(sources_.size());
      normals_.col(i).setZero();
      normals_(j, i) = sign, bounds_[i] = sign * bound;
      sources_.push_back({kind, j, 0.});
    };
    add(1., low_[j], Source::Kind::lower);
    add(-1., high_[j], Source::Kind::upper);
  }
}

/// Adds a damper for each pair within the influence distance. If accelerations are limited, the pair also keeps the
/// speed from which joints can brake with half of their acceleration. The other half is left to other pairs and to
/// gradients that change along the motion.
void DiffIk::addDampers(const State& state, double dt) {
  const bool must_brake = acceleration_limit_.allFinite();
  if (pairs_->pairs.empty()) return;
  bodies_->place(state);
  bodies_->forMaybeNear(options_.influence_distance, [&](int pair) {
    const Proximity near = bodies_->proximity(pair);
    if (near.distance >= options_.influence_distance) return;
    const auto [a, b] = pairs_->pairs[std::size_t(pair)];
    gradient_row_.setZero();
    JacobianRows row(gradient_row_);
    addDistanceGradient(state, pairs_->frames[std::size_t(a)], pairs_->frames[std::size_t(b)], near, 1., row);
    const Eigen::Index i = Eigen::Index(sources_.size());
    normals_.col(i) = gradient_row_.transpose();
    const double gap = near.distance - options_.margin;
    double approach = options_.collision_gain * gap;
    const double deceleration = must_brake ? .5 * gradient_row_.cwiseAbs() * acceleration_limit_ : 0.;
    if (gap > 0. && deceleration > 0.) approach = std::min(approach, brakingSpeed(gap, deceleration, dt) * dt);
    bounds_[i] = -approach;
    sources_.push_back({Source::Kind::pair, pair, near.distance});
  });
}

/// Solves the program of the first priority. If its constraints contradict each other, the dampers are relaxed by the
/// least violation first.
void DiffIk::solveFirst() {
  slack_.setZero();
  if (solveWithDamping(0.)) return;
  findLeastViolation();
  const double largest = cost_.diagonal().maxCoeff();
  for (const double share : kStiffer)
    if (solveWithDamping(share * largest)) return;
  // Only rounding leads here: change_ is the step of the least violation.
}

/// Solves the program of the first priority with an additional cost of the squared step. If there is no solution,
/// change_ is as before.
bool DiffIk::solveWithDamping(double damping) {
  program_->clear();
  program_->hessian() = cost_, program_->gradient() = slope_;
  program_->hessian().diagonal().array() += damping;
  for (int i = 0; i < int(sources_.size()); ++i) program_->addInequality(normals_.col(i), bounds_[i] - slack_[i]);
  if (program_->solve() != QuadraticStatus::solved) return false;
  change_ = program_->x();
  collectActive(*program_);
  return true;
}

/// Sets change_ to the step within the intervals with the least sum of squared violations of dampers, and slack_ to
/// these violations. The sum is piecewise quadratic and convex: a Newton step solves the program of the violated
/// dampers, and bisection finds the minimum along it. A small cost of the squared step keeps joints still that hardly
/// change a distance.
void DiffIk::findLeastViolation() {
  const int count = int(sources_.size());
  const auto isPair = [&](int i) { return sources_[std::size_t(i)].kind == Source::Kind::pair; };
  change_ = VectorXd::Zero(change_.size()).cwiseMax(low_).cwiseMin(high_);
  for (int round = 0; round < kMaxRelaxations; ++round) {
    program_->clear();
    program_->hessian().setIdentity(), program_->hessian() *= kLeastStep, program_->gradient().setZero();
    for (int i = 0; i < count; ++i) {
      const auto normal = normals_.col(i);
      excess_[i] = isPair(i) ? bounds_[i] - normal.dot(change_) : 0.;
      if (!isPair(i)) program_->addInequality(normal, bounds_[i]);
      if (excess_[i] <= 0.) continue;
      program_->hessian().noalias() += normal * normal.transpose();
      program_->gradient() -= bounds_[i] * normal;
    }
    if (program_->solve() != QuadraticStatus::solved) break;
    direction_ = program_->x().cwiseMax(low_).cwiseMin(high_) - change_;
    for (int i = 0; i < count; ++i) rate_[i] = isPair(i) ? normals_.col(i).dot(direction_) : 0.;
    const auto slopeAt = [&](double t) {  // of half the sum
      double slope = kLeastStep * (change_ + t * direction_).dot(direction_);
      for (int i = 0; i < count; ++i) slope -= std::max(0., excess_[i] - t * rate_[i]) * rate_[i];
      return slope;
    };
    double low = 0., high = 1.;
    if (slopeAt(1.) <= 0.) low = 1.;
    for (int k = 0; low < 1. && k < kMaxRelaxations; ++k) {
      const double middle = .5 * (low + high);
      (slopeAt(middle) < 0. ? low : high) = middle;
    }
    change_ += low * direction_;
    if (low * direction_.lpNorm<Eigen::Infinity>() <= kLoosened) break;
  }
  for (int i = 0; i < count; ++i)
    slack_[i] = kLoosened + (isPair(i) ? std::max(0., bounds_[i] - normals_.col(i).dot(change_)) : 0.);
}

/// Solves the program of a further priority in the free directions; the other variables are padding. The step so far
/// fulfills all constraints.
void DiffIk::solveRemaining() {
  const int k = free_count_;
  const auto free = free_.leftCols(k);
  program_->clear();
  program_->hessian().setIdentity(), program_->gradient().setZero();
  product_.leftCols(k).noalias() = cost_ * free;
  reduced_cost_.topLeftCorner(k, k).noalias() = free.transpose() * product_.leftCols(k);
  program_->hessian().topLeftCorner(k, k) = reduced_cost_.topLeftCorner(k, k);
  slope_.noalias() += cost_ * change_;
  program_->gradient().head(k).noalias() = free.transpose() * slope_;
  along_.setZero();
  for (int i = 0; i < int(sources_.size()); ++i) {
    along_.head(k).noalias() = free.transpose() * normals_.col(i);
    program_->addInequality(along_, std::min(0., bounds_[i] - slack_[i] - normals_.col(i).dot(change_)));
  }
  if (program_->solve() != QuadraticStatus::solved) return;
  collectActive(*program_);
  change_.noalias() += free * program_->x().head(k);
}

void DiffIk::collectActive(const DualActiveSet& program) {
  for (int i = 0; i < program.activeCount(); ++i) {
    const int constraint = program.active(i);
    if (constraint < int(sources_.size()) && std::ranges::find(active_, constraint) == active_.end())
      active_.push_back(constraint);
  }
}

/// Removes the gradients of the tasks of a priority from the free directions. For each gradient, a Householder
/// reflection makes its projection on the free directions the last of them.
void DiffIk::removeDirections(int priority) {
  for (const Task& task : tasks_) {
    if (task.priority != priority) continue;
    for (int r = 0; r < task.J.rows() && free_count_ > 0; ++r) {
      const int k = free_count_;
      auto v = along_.head(k);
      v.noalias() = free_.leftCols(k).transpose() * task.J.row(r).transpose();
      const double length = v.norm();
      if (length <= kSpanned * task.J.row(r).norm()) continue;
      v[k - 1] += v[k - 1] < 0. ? -length : length;
      const double factor = 2. / v.squaredNorm();
      for (int i = 0; i < free_.rows(); ++i) {
        const double part = factor * free_.row(i).head(k).dot(v);
        free_.row(i).head(k) -= part * v.transpose();
      }
      --free_count_;
    }
  }
}

/// Solves one program per priority, each in the directions that the ones before leave free. All share the slacks of
/// the first one.
void DiffIk::solve() {
  const std::size_t priorities = std::max<std::size_t>(priorities_.size(), 1);
  active_.clear();
  for (std::size_t i = 0; i < priorities; ++i) {
    const int priority = priorities_.empty() ? 0 : priorities_[i];
    addCosts(q_, priority, i + 1 == priorities);
    if (i == 0) {
      if (q_.size() > 0) solveFirst();
      free_.setIdentity();
      free_count_ = int(free_.cols());
    } else {
      removeDirections(priorities_[i - 1]);
      if (free_count_ > 0) solveRemaining();
    }
  }
  change_ = change_.cwiseMax(low_).cwiseMin(high_);
  for (int i = 0; i < int(sources_.size()); ++i) {
    const double by = bounds_[i] - normals_.col(i).dot(change_);
    if (by > kReported) relaxed_.push_back({sources_[std::size_t(i)], by});
  }
  for (int t = 0; t < int(tasks_.size()); ++t) {
    Task& task = tasks_[std::size_t(t)];
    if (task.priority != kEquality) continue;
    task.findLeft(change_);
    const double by = task.left.lpNorm<Eigen::Infinity>();
    if (by > kReportedEquality) relaxed_.push_back({{Source::Kind::equality, t, 0.}, by});
  }
}

void DiffIk::reset() {
  velocity_.setZero();
  chatter_->reset(int(velocity_.size()));
}

const VectorXd& DiffIk::step(double dt, bool apply) {
  if (!(dt > 0. && std::isfinite(dt)))
    throw ValueError(cat("DiffIk: dt is ", dt, "; expected a finite number > 0 (s)"));
  if (config_.model() != model_) prepare();
  const State& state = config_.state();
  q_ = state.q();
  sources_.clear(), relaxed_.clear();
  addIntervals(q_, dt);
  addDampers(state, dt);
  solve();
  learnChatter();
  velocity_ = change_ / dt;
  q_ += change_;
  if (apply) config_.setJointState(q_);
  return velocity_;
}

std::string DiffIk::describe(const Source& source) const {
  if (source.kind == Source::Kind::equality) {
    const Task& task = tasks_[std::size_t(source.index)];
    return cat("equality ", task.residual[0].name(), " of ", join(task.frames));
  }
  if (source.kind == Source::Kind::pair) {
    const auto [a, b] = pairs_->pairs[std::size_t(source.index)];
    const auto name = [&](int place) {
      return cat("'", model_->frame_name[std::size_t(pairs_->frames[std::size_t(place)])], "'");
    };
    return cat(name(a), " and ", name(b), " at ", source.value, " m");
  }
  return cat(source.kind == Source::Kind::upper ? "upper" : "lower", " limit of '",
             config_.getJointNames()[std::size_t(source.index)], "'");
}

std::vector<std::string> DiffIk::active() const {
  std::vector<std::string> names;
  for (int constraint : active_) names.push_back(describe(sources_[std::size_t(constraint)]));
  return names;
}

std::string DiffIk::message() const {
  std::vector<std::string> parts;
  for (const Relaxed& relaxed : relaxed_) parts.push_back(cat(describe(relaxed.source), " by ", relaxed.by));
  return parts.empty() ? "" : cat("constraints relaxed: ", join(parts));
}

}  // namespace kinegraph
