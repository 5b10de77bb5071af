#include "kinegraph/planning/steering/joint_space.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline planning_internal {

namespace {

constexpr double kFullRotation = 2. * M_PI;

/// Flags the dofs that only rotate, so that whole rotations change nothing.
std::vector<char> onlyRotations(const KinematicModel& model) {
  std::vector<char> rotates(std::size_t(model.dofs), 1);
  for (const KinematicModel::Link& link : model.links) {
    int dof = link.dof;
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
      const MotionStep& step = model.steps[std::size_t(s)];
      const bool whole = step.rotates() && link.scale == std::round(link.scale);
      for (int i = 0; i < step.dofs(); ++i, ++dof) rotates[std::size_t(dof)] &= whole;
    }
  }
  return rotates;
}

/// Flags the dofs that move a frame.
std::vector<char> movingDofs(const KinematicModel& model) {
  std::vector<char> moving(std::size_t(model.dofs), 0);
  for (const KinematicModel::Link& link : model.links) {
    int dof = link.dof;
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
      const MotionStep& step = model.steps[std::size_t(s)];
      for (int i = 0; i < step.dofs(); ++i, ++dof) moving[std::size_t(dof)] |= step.moves();
    }
  }
  return moving;
}

}  // namespace

std::vector<std::string> dofNames(const KinematicModel& model) {
  std::vector<std::string> names(std::size_t(model.dofs));
  for (std::size_t frame = 0; frame < model.frame_dofs.size(); ++frame) {
    const KinematicModel::DofRange range = model.frame_dofs[frame];
    for (int i = 0; i < range.count; ++i) {
      std::string& name = names[std::size_t(range.first + i)];
      if (!name.empty()) continue;  // the frame is that of a mimic joint
      name = range.count == 1 ? model.frame_name[frame] : cat(model.frame_name[frame], ":", i);
    }
  }
  return names;
}

JointSpace::JointSpace(const KinematicModel& model)
    : lower_(model.lower),
      upper_(model.upper),
      sample_lower_(model.lower),
      sample_upper_(model.upper),
      kinds_(std::size_t(model.dofs), Kind::ranged),
      directions_(model.unit_norms),
      names_(dofNames(model)) {
  const std::vector<char> rotates = onlyRotations(model), moving = movingDofs(model);
  for (const KinematicModel::DofRange& range : directions_) {
    for (int i = 0; i < range.count; ++i) kinds_[std::size_t(range.first + i)] = Kind::direction;
    plain_ = false;
  }
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    const auto dof = Eigen::Index(i);
    if (kinds_[i] == Kind::direction) continue;
    if (!moving[i] || lower_[dof] == upper_[dof]) {
      kinds_[i] = Kind::fixed;
    } else if (!std::isfinite(lower_[dof]) && !std::isfinite(upper_[dof]) && rotates[i]) {
      kinds_[i] = Kind::endless;
      plain_ = false;
    } else if (!std::isfinite(lower_[dof]) || !std::isfinite(upper_[dof])) {
      without_range_.push_back(names_[i]);
    }
  }
}

void JointSpace::requireRanges(const char* who) const {
  if (without_range_.empty()) return;
  throw ValueError(cat(who, ": no limits are known for ", join(without_range_),
                       "; sampling needs limits, as in {limits: [-1, 1]}, or exclude these joints with selectJoints"));
}

VectorXd JointSpace::difference(const VectorXd& from, const VectorXd& to) const {
  VectorXd change = to - from;
  if (plain_) return change;
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    if (kinds_[i] == Kind::endless) change[Eigen::Index(i)] = std::remainder(change[Eigen::Index(i)], kFullRotation);
  }
  for (const KinematicModel::DofRange& range : directions_) {
    const auto a = from.segment(range.first, range.count), b = to.segment(range.first, range.count);
    if (a.dot(b) < 0.) change.segment(range.first, range.count) = -b - a;
  }
  return change;
}

double JointSpace::squaredDistanceOfKinds(const double* a, const double* b) const {
  double square = 0.;
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    if (kinds_[i] == Kind::direction) continue;
    double change = b[i] - a[i];
    if (kinds_[i] == Kind::endless && std::abs(change) > M_PI) change = std::remainder(change, kFullRotation);
    square += change * change;
  }
  for (const KinematicModel::DofRange& range : directions_) {
    double less = 0., more = 0.;
    for (int i = range.first; i < range.first + range.count; ++i) {
      less += (b[i] - a[i]) * (b[i] - a[i]);
      more += (b[i] + a[i]) * (b[i] + a[i]);
    }
    square += 4. * std::min(less, more);  // |change of q| is half of the angle
  }
  return square;
}

void JointSpace::sampleUnlimitedWithin(const VectorXd& lower, const VectorXd& upper) {
  for (Eigen::Index dof = 0; dof < lower_.size(); ++dof) {
    if (kinds_[std::size_t(dof)] != Kind::ranged) continue;
    if (!std::isfinite(lower_[dof])) sample_lower_[dof] = lower[dof];
    if (!std::isfinite(upper_[dof])) sample_upper_[dof] = upper[dof];
  }
  without_range_.clear();
}

void JointSpace::sampleWithin(const VectorXd& lower, const VectorXd& upper) {
  sample_lower_ = lower_.cwiseMax(lower);
  sample_upper_ = upper_.cwiseMin(upper);
}

VectorXd JointSpace::sample(Rng& rng, const VectorXd& like) const {
  VectorXd q = like;
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    const auto dof = Eigen::Index(i);
    if (kinds_[i] == Kind::ranged) q[dof] = rng.uniform(sample_lower_[dof], sample_upper_[dof]);
    if (kinds_[i] == Kind::endless) q[dof] = rng.uniform(-M_PI, M_PI);
    if (kinds_[i] == Kind::direction) q[dof] = rng.normal();
  }
  normalize(q);
  return q;
}

void JointSpace::normalize(VectorXd& q) const {
  if (plain_) return;
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    if (kinds_[i] == Kind::endless) q[Eigen::Index(i)] = std::remainder(q[Eigen::Index(i)], kFullRotation);
  }
  for (const KinematicModel::DofRange& range : directions_) {
    auto part = q.segment(range.first, range.count);
    const double norm = part.norm();
    if (norm > 1e-9) {
      part /= norm;
    } else {
      part.setZero();
      part[0] = 1.;
    }
  }
}

void JointSpace::clamp(VectorXd& q) const {
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    const auto dof = Eigen::Index(i);
    if (kinds_[i] == Kind::ranged || kinds_[i] == Kind::fixed) q[dof] = std::clamp(q[dof], lower_[dof], upper_[dof]);
  }
}

std::string JointSpace::beyondLimits(const VectorXd& q, double tolerance) const {
  int worst = -1;
  double most = tolerance;
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    const auto dof = Eigen::Index(i);
    if (kinds_[i] == Kind::direction || kinds_[i] == Kind::endless) continue;
    const double beyond = std::max(lower_[dof] - q[dof], q[dof] - upper_[dof]);
    if (beyond <= most) continue;
    most = beyond;
    worst = int(i);
  }
  if (worst < 0) return "";
  return cat(names_[std::size_t(worst)], " is at ", q[worst], ", ", most, " beyond its limits ", lower_[worst], " to ",
             upper_[worst]);
}

MatrixXd JointSpace::unroll(const std::vector<VectorXd>& points) const {
  MatrixXd path(Eigen::Index(points.size()), dofs());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto row = Eigen::Index(k);
    if (k == 0) {
      path.row(row) = points[k].transpose();
      continue;
    }
    const VectorXd before = path.row(row - 1).transpose();
    path.row(row) = (before + difference(before, points[k])).transpose();
  }
  return path;
}

double pathLength(const JointSpace& space, const MatrixXd& path) {
  double length = 0.;
  for (Eigen::Index k = 1; k < path.rows(); ++k)
    length += space.distance(path.row(k - 1).transpose(), path.row(k).transpose());
  return length;
}

}  // namespace kinegraph::inline planning_internal
