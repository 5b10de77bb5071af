#include "kinegraph/viewer/config_viewer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/kinematics/kinematic_model.h"
#include "kinegraph/viewer/scene_items.h"

namespace kinegraph {

namespace {

constexpr int kRate = 50;  // slices per second

/// Returns the basis of a uniform cubic B-spline in one segment, u in [0, 1).
Vector4d cubicBasis(double u) {
  const double v = 1. - u;
  return Vector4d(v * v * v, 3. * u * u * u - 6. * u * u + 4., 3. * v * v * v - 6. * v * v + 4., u * u * u) / 6.;
}

}  // namespace

VectorXd randomJointState(const Config& config, Rng& rng) {
  const auto program = config.model();
  VectorXd q = config.getJointState();
  for (int i = 0; i < q.size(); ++i) {
    const bool limited = std::isfinite(program->lower[i]);
    q[i] = limited ? rng.uniform(program->lower[i], program->upper[i]) : q[i] + rng.uniform(-.5, .5);
  }
  for (const KinematicModel::DofRange& range : program->unit_norms) q.segment(range.first, range.count).normalize();
  return q;
}

ShownMotion motionAlong(const Config& config, const MatrixXd& path, double seconds) {
  if (path.cols() != config.getJointDimension()) {
    throw ValueError(cat("motion: the path has ", path.cols(), " columns; the configuration has ",
                         config.getJointDimension(), " dofs"));
  }
  ShownMotion motion;
  motion.seconds = seconds;
  motion.q = path;
  Config moved(config);
  for (Eigen::Index t = 0; t < path.rows(); ++t) {
    moved.setJointState(path.row(t));
    motion.poses.push_back(posesOf(moved));
  }
  return motion;
}

ShownMotion jointSweep(const Config& config) {
  const VectorXd q0 = config.getJointState();
  const MatrixXd limits = config.getJointLimits();
  const std::vector<std::string> names = config.getJointNames();
  MatrixXd path = q0.transpose().replicate(q0.size() * kRate, 1);
  std::vector<std::string> texts;
  Eigen::Index row = 0;
  for (Eigen::Index i = q0.size() - 1; i >= 0; --i) {
    const bool limited = limits.col(i).allFinite();
    const double lower = limited ? limits(0, i) : q0[i] - .5, upper = limited ? limits(1, i) : q0[i] + .5;
    const double middle = (lower + upper) / 2, reach = std::max((upper - lower) / 2, 1e-9);
    const double begin = std::acos(std::clamp((q0[i] - middle) / reach, -1., 1.));
    for (int k = 0; k < kRate; ++k) {
      path(row++, i) = middle + reach * std::cos(begin + 2. * std::numbers::pi * k / kRate);
      texts.push_back(
          cat(names[std::size_t(i)], limited ? cat("  [", limits(0, i), ", ", limits(1, i), "]") : "  without limits"));
    }
  }
  ShownMotion motion = motionAlong(config, path, double(q0.size()));
  motion.start = ShownMotion::Start::play;
  motion.texts = std::move(texts);
  return motion;
}

ShownMotion randomSpline(const Config& config, int points, Rng& rng) {
  if (points < 1 || points > 1000) throw ValueError(cat("animateSpline: T is ", points, "; expected 1 to 1000"));
  const VectorXd q0 = config.getJointState();
  std::vector<VectorXd> control(3, q0);
  for (int i = 0; i < points; ++i) control.push_back(randomJointState(config, rng));
  control.insert(control.end(), 3, q0);
  const int slices = (points + 1) * kRate, segments = int(control.size()) - 3;
  MatrixXd path(slices + 1, q0.size());
  for (int t = 0; t <= slices; ++t) {
    const double time = double(t) / slices * segments;
    const int segment = std::min(int(time), segments - 1);
    const Vector4d basis = cubicBasis(time - segment);
    path.row(t).setZero();
    for (int k = 0; k < 4; ++k) path.row(t) += basis[k] * control[std::size_t(segment + k)].transpose();
  }
  ShownMotion motion = motionAlong(config, path, points + 1.);
  motion.start = ShownMotion::Start::play;
  return motion;
}

}  // namespace kinegraph
