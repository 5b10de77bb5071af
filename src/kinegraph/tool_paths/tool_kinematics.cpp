#include "kinegraph/tool_paths/tool_kinematics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/kinematics/kinematic_model.h"
#include "kinegraph/kinematics/state.h"

namespace kinegraph::inline tool_paths_internal {

namespace {

constexpr double kTurn = 2. * std::numbers::pi;
constexpr double kWide = kTurn - 1e-2;  // rad between limits: files round
constexpr double kDamping = 1e-10;      // of J J^T
constexpr double kLongestStep = .3;     // rad or m
constexpr double kMet = 1e-10;          // m or rad: no further step
constexpr double kGood = 1e-7;          // m or rad
constexpr double kNearLimit = 1e-6;     // rad or m inside
constexpr double kLargestPull = .05;    // rad
constexpr double kConeTo = .97;         // of the allowed lean, to which a larger one is moved

using Rows6 = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;
using Square6 = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
using Jacobian6 = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, 6, Eigen::Dynamic>;

constexpr int kSeries = 6;  // Taylor coefficients 0 to 5
using Series = std::array<double, kSeries>;

Series product(const Series& a, const Series& b) {
  Series c{};
  for (int i = 0; i < kSeries; ++i)
    for (int j = 0; i + j < kSeries; ++j) c[std::size_t(i + j)] += a[std::size_t(i)] * b[std::size_t(j)];
  return c;
}

/// exp of a series without constant term.
Series exponential(const Series& a) {
  Series e{};
  e[0] = 1.;
  for (int k = 1; k < kSeries; ++k) {
    for (int j = 1; j <= k; ++j) e[std::size_t(k)] += j * a[std::size_t(j)] * e[std::size_t(k - j)];
    e[std::size_t(k)] /= k;
  }
  return e;
}

}  // namespace

ToolKinematics::ToolKinematics(const Config& config, const ToolPath& path)
    : state_(config.state()),
      tool_(frameId(state_.model(), path.frame(), "ToolPath")),
      reference_(path.relativeTo().empty() ? -1 : frameId(state_.model(), path.relativeTo(), "ToolPath")),
      free_axis_(path.freeAxis()),
      cone_(path.cone()),
      prefer_(path.preferred()),
      moving_(std::size_t(state_.dofs()), 0),
      wide_(std::size_t(state_.dofs()), 0),
      J_(6, state_.dofs()),
      J_reference_(6, state_.dofs()) {
  if (path.range())
    middle_ = .5 * (path.range()->first + path.range()->second),
    half_range_ = .5 * (path.range()->second - path.range()->first);
  const KinematicModel& model = state_.model();
  int common = state_.link(tool_), other = reference_ < 0 ? 0 : state_.link(reference_);
  while (common != other) (common > other ? common : other) = model.links[std::size_t(std::max(common, other))].parent;
  if (reference_ >= 0) listChain(state_.link(reference_), common, true);
  const std::size_t tool_first = chain_.size();
  listChain(state_.link(tool_), common, false);
  std::reverse(chain_.begin() + std::ptrdiff_t(tool_first), chain_.end());
  tool_offset_ = state_.parameters().frame_offset[std::size_t(tool_)].p.norm();
  if (reference_ >= 0) tool_offset_ += state_.parameters().frame_offset[std::size_t(reference_)].p.norm();
  if (chain_.empty())
    throw ValueError(cat("planToolPath: no active joint moves '", path.frame(), "' relative to ",
                         reference_ < 0 ? "the world" : cat("'", path.relativeTo(), "'")));
  for (const ChainStep& step : chain_) {
    moving_[std::size_t(step.dof)] = 1;
    if (step.rotates && model.upper[step.dof] - model.lower[step.dof] > kWide) wide_[std::size_t(step.dof)] = 1;
  }
}

void ToolKinematics::listChain(int link, int until, bool of_reference) {
  const KinematicModel& model = state_.model();
  for (; link != until; link = model.links[std::size_t(link)].parent) {
    const KinematicModel::Link& joint = model.links[std::size_t(link)];
    double offset = Eigen::Map<const Vector3d>(state_.parameters().link[std::size_t(link)].p).norm();
    int dof = joint.dof + joint.steps;
    for (int s = joint.first_step + joint.steps - 1; s >= joint.first_step; --s) {
      const MotionStep& step = model.steps[std::size_t(s)];
      if (step.orients())
        throw ValueError(
            cat("planToolPath: the joint of '", model.frame_name[std::size_t(joint.frame)],
                "' has a quaternion or circle; expected hinges and slides between the tool and its frame"));
      dof -= step.dofs();
      if (!step.moves()) continue;
      const bool first = s == joint.first_step;
      chain_.push_back({dof, std::abs(joint.scale), first ? offset : 0., step.rotates(), of_reference});
    }
  }
}

int ToolKinematics::movingDofs() const { return int(std::count(moving_.begin(), moving_.end(), 1)); }

RigidTransform ToolKinematics::pose(const VectorXd& q) {
  state_.setJoints(q.data());
  const RigidTransform X = state_.pose(tool_);
  return reference_ < 0 ? X : state_.pose(reference_).inverse() * X;
}

ToolMiss ToolKinematics::miss(const VectorXd& q, const ToolTarget& target) {
  const RigidTransform X = pose(q);
  return {X.p - target.p, X.R.col(0) - target.x, X.R.col(2) - target.z};
}

Vector3d ToolKinematics::velocity(const VectorXd& q, const VectorXd& dq) {
  state_.setJoints(q.data());
  const Vector3d p = state_.position(tool_);
  Vector3d v = Vector3d::Zero();
  const auto add = [&](int frame, double sign) {
    state_.forTwists(frame, [&](int dof, const State::Twist& twist) {
      v += sign * dq[dof] * (twist.linear + twist.angular.cross(p));
    });
  };
  add(tool_, 1.);
  if (reference_ >= 0) add(reference_, -1.);
  return v;
}

double ToolKinematics::lean(const VectorXd& q, const ToolTarget& target) {
  const Vector3d a = pose(q).R.col(free_axis_), b = target.axis(free_axis_);
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

double ToolKinematics::twist(const RigidTransform& X, const ToolTarget& target) const {
  const Vector3d a = X.R.col(free_axis_), b = target.axis(free_axis_);
  const int side = (free_axis_ + 1) % 3;
  const Vector3d u = Quaterniond::FromTwoVectors(b, a) * target.axis(side), w = X.R.col(side);
  return std::atan2(a.dot(u.cross(w)), u.dot(w));
}

double ToolKinematics::beyondRange(double twist) const {
  return std::abs(std::remainder(twist - middle_, kTurn)) - half_range_;
}

double ToolKinematics::twistRate(const VectorXd& rates, double target_rate, double lean) const {
  // d twist = (w_tool - w_target) . (a + b) / (1 + a . b) for axes a and b; |a + b| / (1 + a . b) = 1 / cos(lean / 2).
  double rate = target_rate;
  for (const ChainStep& step : chain_)
    if (step.rotates) rate += step.scale * rates[step.dof];
  return rate / std::cos(.5 * lean);
}

double ToolKinematics::side(const Pose& start) const {
  const int axis = free_axis_ < 0 ? 2 : free_axis_;
  if (state_.link(tool_) == 0) return (start.q * Vector3d::Unit(axis)).dot(start.p) < -1e-9 ? -1. : 1.;
  const RigidTransform X(state_.parameters().frame_offset[std::size_t(tool_)]);
  return X.R.col(axis).dot(X.p) > 1e-9 ? -1. : 1.;
}

VectorXd ToolKinematics::difference(const VectorXd& from, const VectorXd& to) const {
  VectorXd d = to - from;
  for (int j = 0; j < dofs(); ++j)
    if (isWide(j)) d[j] -= kTurn * std::round(d[j] / kTurn);
  return d;
}

VectorXd ToolKinematics::centering(const VectorXd& q, double gain) const {
  VectorXd pull = VectorXd::Zero(dofs());
  for (int j = 0; j < dofs(); ++j) {
    if (!moving_[std::size_t(j)] || isWide(j) || !hasLimits(j)) continue;
    const double half = .5 * (model().upper[j] - model().lower[j]);
    const double u = (q[j] - .5 * (model().upper[j] + model().lower[j])) / half;
    pull[j] = -gain * half * u * u * u;
  }
  return pull;
}

VectorXd ToolKinematics::preferring(const VectorXd& q, const ToolTarget& target, double gain) {
  VectorXd pull = VectorXd::Zero(dofs());
  if (!prefer_) return pull;
  const RigidTransform X = pose(q);
  const Vector3d a = X.R.col(free_axis_), b = target.axis(free_axis_);
  const Vector3d W_axis = (reference_ < 0 ? Matrix3d(Matrix3d::Identity()) : Matrix3d(state_.pose(reference_).R)) *
                          ((a + b) / (1. + a.dot(b)));
  state_.jacobian(tool_, state_.position(tool_), J_);
  if (reference_ >= 0) {
    state_.jacobian(reference_, state_.position(tool_), J_reference_);
    J_ -= J_reference_;
  }
  const VectorXd slope = J_.bottomRows(3).transpose() * W_axis;
  if (slope.squaredNorm() < 1e-6) return pull;
  const double off = std::remainder(twist(X, target) - *prefer_, kTurn);
  return -std::clamp(gain * off, -kLargestPull, kLargestPull) / slope.squaredNorm() * slope;
}

ToolKinematics::Projection ToolKinematics::project(VectorXd& q, const ToolTarget& target, ToolRows rows, int steps,
                                                   const VectorXd& pull, double share) {
  const VectorXd &lower = model().lower, &upper = model().upper;
  const int n = dofs();
  Projection result;
  std::vector<char> held(std::size_t(n), 0);
  Rows6 e;
  Jacobian6 J;
  double before = 1e9;
  for (int iteration = 0;; ++iteration) {
    state_.setJoints(q.data());
    const RigidTransform W = state_.pose(tool_), R = reference_ < 0 ? RigidTransform() : state_.pose(reference_);
    const RigidTransform X = reference_ < 0 ? W : R.inverse() * W;
    const Vector3d p = X.p - target.p;
    int count = 3;
    Eigen::Matrix<double, 3, 3, Eigen::RowMajor> to_rows;  // angular velocity to the rows after the position
    Vector3d turned = Vector3d::Zero();
    if (rows == ToolRows::pose) {
      turned = .5 * (target.x.cross(Vector3d(X.R.col(0))) + target.axis(1).cross(Vector3d(X.R.col(1))) +
                     target.z.cross(Vector3d(X.R.col(2))));
      if (X.R.col(0).dot(target.x) + X.R.col(1).dot(target.axis(1)) + X.R.col(2).dot(target.z) < 0.)
        turned *= 1. / std::max(.3, turned.norm());  // more than a quarter turn
      to_rows.setIdentity();
      count = 6;
    } else if (free_axis_ >= 0) {
      const Vector3d a = X.R.col(free_axis_), b = target.axis(free_axis_);
      const Vector3d n_ab = b.cross(a);
      const double sine = n_ab.norm(), angle = std::atan2(sine, a.dot(b));
      if (rows == ToolRows::axis) {
        count = 5;
        const Vector3d helper = std::abs(b[0]) < .7 ? Vector3d::UnitX() : Vector3d::UnitY();
        const Vector3d t1 = b.cross(helper).normalized(), t2 = b.cross(t1);
        const Vector3d w = sine > 1e-12 ? Vector3d(n_ab * (angle / sine)) : Vector3d::Zero();
        turned << t1.dot(w), t2.dot(w), 0.;
        to_rows.row(0) = t1.transpose(), to_rows.row(1) = t2.transpose();
      } else if (angle > share * cone_) {
        turned[0] = angle - share * kConeTo * cone_;
        to_rows.row(0) = (n_ab / std::max(sine, 1e-12)).transpose();
        count = 4;
      }
      if (hasRange()) {
        const double off = std::remainder(twist(X, target) - middle_, kTurn);
        if (std::abs(off) > share * half_range_) {
          turned[count - 3] = off - std::copysign(share * kConeTo * half_range_, off);
          to_rows.row(count - 3) = ((a + b) / (1. + a.dot(b))).transpose();
          ++count;
        }
      }
    }
    e.resize(count);
    e.head(3) = p;
    for (int k = 3; k < count; ++k) e[k] = turned[k - 3];
    result.error = e.cwiseAbs().maxCoeff();
    result.met = result.error < kGood;
    const bool pulled = iteration == 0 && pull.size() > 0;
    if ((result.error < kMet && !pulled) || iteration >= steps) return result;
    if (iteration > 3 && result.met && result.error > .5 * before) return result;
    before = result.error;
    state_.jacobian(tool_, W.p, J_);
    if (reference_ >= 0) {
      state_.jacobian(reference_, W.p, J_reference_);
      J_ -= J_reference_;
    }
    J.resize(count, n);
    J.topRows(3) = R.R.transpose() * J_.topRows(3);
    if (count > 3) J.bottomRows(count - 3) = to_rows.topRows(count - 3) * (R.R.transpose() * J_.bottomRows(3));
    for (int j = 0; j < n; ++j)
      if (held[std::size_t(j)]) J.col(j).setZero();
    Square6 A = J * J.transpose();
    A.diagonal().array() += kDamping + 1e-4 * std::min(1., e.squaredNorm()) * 1e-2;
    Rows6 right = -e;
    if (pulled) right -= J * pull;
    VectorXd step = J.transpose() * A.ldlt().solve(right);
    if (pulled) step += pull;
    const double longest = step.cwiseAbs().maxCoeff();
    if (longest > kLongestStep) step *= kLongestStep / longest;
    q += step;
    for (int j = 0; j < n; ++j) {
      if (isWide(j) || !moving_[std::size_t(j)]) continue;
      if (q[j] > upper[j] - kNearLimit || q[j] < lower[j] + kNearLimit) {
        q[j] = std::clamp(q[j], lower[j] + kNearLimit, upper[j] - kNearLimit);
        // A held dof gets another chance every few steps.
        held[std::size_t(j)] = iteration % 4 != 3;
        result.blocked = j;
      } else {
        held[std::size_t(j)] = 0;
      }
    }
  }
}

ToolKinematics::Remainder ToolKinematics::fifthCoefficient(const MatrixXd& coefficients,
                                                           const VectorXd& largest) const {
  const auto seriesOf = [&](const ChainStep& step, double constant) {
    Series a{};
    a[0] = constant;
    for (int k = 0; k < 3; ++k) a[std::size_t(k) + 1] = step.scale * coefficients(step.dof, k);
    return a;
  };
  Series angle{}, position{}, all{};
  Series reference{};  // all rotations of the reference frame act on all links
  for (const ChainStep& step : chain_)
    if (step.of_reference && step.rotates)
      for (int k = 1; k < kSeries; ++k) reference[std::size_t(k)] += seriesOf(step, 0.)[std::size_t(k)];
  angle = reference;
  const auto addLink = [&](const Series& length, const Series& rotation) {
    const Series moved = product(length, exponential(rotation));
    for (int k = 0; k < kSeries; ++k) position[std::size_t(k)] += moved[std::size_t(k)];
  };
  for (const ChainStep& step : chain_) {
    Series length{};
    length[0] = step.offset;
    addLink(length, angle);
    if (!step.rotates) addLink(seriesOf(step, step.scale * largest[step.dof]), angle);
    if (step.rotates && !step.of_reference)
      for (int k = 1; k < kSeries; ++k) angle[std::size_t(k)] += seriesOf(step, 0.)[std::size_t(k)];
  }
  Series length{};
  length[0] = tool_offset_;
  addLink(length, angle);
  all = exponential(angle);
  return {position[kSeries - 1], all[kSeries - 1]};
}

}  // namespace kinegraph::inline tool_paths_internal
