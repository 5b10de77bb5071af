#include "kinegraph/control/diff_ik.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/features/distance.h"
#include "kinegraph/scene/motor_limits.h"

namespace kinegraph {

namespace {

constexpr double kNoBound = std::numeric_limits<double>::infinity();
constexpr double kElasticity = 1e8;  // cost of the square of what dampers give way, in units of the largest other cost
constexpr double kGivesWay = 1e-9;   // rad or m, from which on it is told
constexpr double kMissedEquality = 1e-6;  // the same of equalities, in units of the feature
constexpr double kSpanned = 1e-6;  // share of a row in the open directions, below which it counts as fixed already

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
  program_ = config_.model();
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
  active_rows_.reserve(std::size_t(rows));
  open_.resize(n, n), turned_.resize(n, n), reduced_cost_.resize(n, n), along_.resize(n);
  for (Task& task : tasks_) {
    task.residual.clear();
    task.residual.push_back(makeResidual(config_.state(), task.feature, task.frames, task.weight, task.target));
    task.y.resize(task.residual[0].rows()), task.J.resize(task.residual[0].rows(), n);
  }
}

int DiffIk::addTask(const FeatureSource& feature, const std::vector<std::string>& frames, double weight, double gain,
                    const VectorXd& target, int priority) {
  if (priority == kEquality) throw ValueError(cat("DiffIk: level is ", priority, "; that of equalities"));
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
    throw ValueError(
        cat("DiffIk: ", residual.name(), " is of order ", residual.order(), "; expected a feature of one q"));
  task.y.resize(residual.rows()), task.J.resize(residual.rows(), config_.getJointDimension());
  task.residual.push_back(std::move(residual));
  const auto place = std::lower_bound(priorities_.begin(), priorities_.end(), task.priority);
  if (place == priorities_.end() || *place != task.priority) priorities_.insert(place, task.priority);
  tasks_.push_back(std::move(task));
  gave_way_.reserve(std::size_t(rows_.cols()) + tasks_.size());
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

/// Of the tasks of a level; the posture's are those of the last one.
void DiffIk::addCosts(const VectorXd& q, int priority, bool is_last) {
  const double pull = is_last ? options_.posture * options_.posture : 0.;
  cost_.setZero();
  cost_.diagonal().setConstant(pull + options_.damping);
  slope_ = pull * (q - posture_);
  for (Task& task : tasks_) {
    if (task.priority != priority) continue;
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

/// The first level: exactly, where all rows can hold; else dampers share a slack, whose square costs more than all
/// else. False if rounding forbids either.
bool DiffIk::solveFirst() {
  const int n = int(slope_.size()), count = int(meanings_.size());
  program_rigid_.clear();
  program_rigid_.hessian() = cost_, program_rigid_.gradient() = slope_;
  for (int r = 0; r < count; ++r) program_rigid_.addRow(rows_.col(r), bounds_[r]);
  is_elastic_ = !program_rigid_.solve();
  if (!is_elastic_) {
    change_ = program_rigid_.x();
    noteActive(program_rigid_);
    return true;
  }
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
  if (!program_elastic_.solve()) return false;
  change_ = program_elastic_.x().head(n);
  noteActive(program_elastic_);
  return true;
}

/// A further level, in the directions that are open; the others are padded. The step so far keeps all rows.
void DiffIk::solveRemaining() {
  const int k = open_count_;
  const auto open = open_.leftCols(k);
  program_rigid_.clear();
  program_rigid_.hessian().setIdentity(), program_rigid_.gradient().setZero();
  turned_.leftCols(k).noalias() = cost_ * open;
  reduced_cost_.topLeftCorner(k, k).noalias() = open.transpose() * turned_.leftCols(k);
  program_rigid_.hessian().topLeftCorner(k, k) = reduced_cost_.topLeftCorner(k, k);
  slope_.noalias() += cost_ * change_;
  program_rigid_.gradient().head(k).noalias() = open.transpose() * slope_;
  along_.setZero();
  for (int r = 0; r < int(meanings_.size()); ++r) {
    along_.head(k).noalias() = open.transpose() * rows_.col(r);
    program_rigid_.addRow(along_, std::min(0., bounds_[r] - rows_.col(r).dot(change_)));
  }
  if (!program_rigid_.solve()) return;
  noteActive(program_rigid_);
  change_.noalias() += open * program_rigid_.x().head(k);
}

void DiffIk::noteActive(const ActiveSet& program) {
  for (int i = 0; i < program.activeCount(); ++i) {
    const int row = program.active(i);
    if (row < int(meanings_.size()) && std::ranges::find(active_rows_, row) == active_rows_.end())
      active_rows_.push_back(row);
  }
}

/// What the tasks of a level want is no longer open: a reflection turns each of their rows, as far as it is open, into
/// the last of the open directions.
void DiffIk::giveAway(int priority) {
  for (const Task& task : tasks_) {
    if (task.priority != priority) continue;
    for (int r = 0; r < task.J.rows() && open_count_ > 0; ++r) {
      const int k = open_count_;
      auto v = along_.head(k);
      v.noalias() = open_.leftCols(k).transpose() * task.J.row(r).transpose();
      const double length = v.norm();
      if (length <= kSpanned * task.J.row(r).norm()) continue;
      v[k - 1] += v[k - 1] < 0. ? -length : length;
      const double factor = 2. / v.squaredNorm();
      for (int i = 0; i < open_.rows(); ++i) {
        const double part = factor * open_.row(i).head(k).dot(v);
        open_.row(i).head(k) -= part * v.transpose();
      }
      --open_count_;
    }
  }
}

/// Level by level, each in what those before it leave open. The slack that the first one needed is that of all.
void DiffIk::solve() {
  const std::size_t priorities = std::max<std::size_t>(priorities_.size(), 1);
  active_rows_.clear();
  for (std::size_t i = 0; i < priorities; ++i) {
    const int priority = priorities_.empty() ? 0 : priorities_[i];
    addCosts(q_, priority, i + 1 == priorities);
    if (i == 0) {
      if (!solveFirst()) {  // stand still, as far as accelerations allow
        change_.setZero();
        break;
      }
      open_.setIdentity();
      open_count_ = int(open_.cols());
    } else {
      giveAway(priorities_[i - 1]);
      if (open_count_ > 0) solveRemaining();
    }
  }
  change_ = change_.cwiseMax(low_).cwiseMin(high_);
  for (int r = 0; r < int(meanings_.size()); ++r) {
    const double by = bounds_[r] - rows_.col(r).dot(change_);
    if (is_elastic_ && by > kGivesWay) gave_way_.push_back({meanings_[std::size_t(r)], by});
  }
  for (int t = 0; t < int(tasks_.size()); ++t) {
    Task& task = tasks_[std::size_t(t)];
    if (task.priority != kEquality) continue;
    task.y *= task.gain;
    task.y.noalias() += task.J * change_;
    const double by = task.y.lpNorm<Eigen::Infinity>();
    if (by > kMissedEquality) gave_way_.push_back({{Meaning::Kind::equality, t, 0.}, by});
  }
}

const VectorXd& DiffIk::step(double dt, bool apply) {
  if (!(dt > 0.)) throw ValueError(cat("DiffIk: dt is ", dt, "; expected a number > 0 (s)"));
  if (config_.model() != program_) prepare();
  const State& state = config_.state();
  q_ = state.q();
  meanings_.clear(), gave_way_.clear();
  addIntervals(q_, dt);
  addDampers(state, dt);
  solve();
  velocity_ = change_ / dt;
  q_ += change_;
  if (apply) config_.setJointState(q_);
  return velocity_;
}

std::string DiffIk::text(const Meaning& meaning) const {
  if (meaning.kind == Meaning::Kind::equality) {
    const Task& task = tasks_[std::size_t(meaning.index)];
    return cat("equality ", task.residual[0].name(), " of ", join(task.frames));
  }
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
  std::vector<std::string> words;
  for (int row : active_rows_) words.push_back(text(meanings_[std::size_t(row)]));
  return words;
}

std::string DiffIk::message() const {
  std::vector<std::string> words;
  for (const GaveWay& row : gave_way_) words.push_back(cat(text(row.meaning), " by ", row.by));
  return words.empty() ? "" : cat("gave way: ", join(words));
}

}  // namespace kinegraph
