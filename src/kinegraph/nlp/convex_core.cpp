#include "kinegraph/nlp/convex_core.h"

#include <array>

#include "kinegraph/nlp/evaluation_sizes.h"

namespace kinegraph::inline nlp_internal {

namespace {

using enum ObjectiveType;

constexpr int kCorners = 18;
constexpr double kRadius = .01, kReach = 1e-4;  // m
constexpr double kParabolaEnd = .2;             // end of the parabola, in units of kReach

/// Corners of an octahedron and midpoints of its edges; not normalized.
constexpr std::array<std::array<int, 3>, kCorners> kDirections = {{{-1, -1, 0},
                                                                   {1, -1, 0},
                                                                   {0, -1, 1},
                                                                   {0, -1, 0},
                                                                   {0, -1, -1},
                                                                   {-1, 0, 0},
                                                                   {0, 0, 1},
                                                                   {-1, 0, 1},
                                                                   {0, 0, -1},
                                                                   {-1, 0, -1},
                                                                   {-1, 1, 0},
                                                                   {1, 1, 0},
                                                                   {1, 0, -1},
                                                                   {1, 0, 0},
                                                                   {0, 1, -1},
                                                                   {0, 1, 0},
                                                                   {1, 0, 1},
                                                                   {0, 1, 1}}};

/// The attraction of neighbors at a distance l: y(l), y'(l) / l and y''(l).
struct Attraction {
  double value, slope_per_length, curvature;
};

Attraction attractionAt(double length) {
  constexpr double kSteep = .5 / (kParabolaEnd * (1. + kParabolaEnd) *
                                  (1. + kParabolaEnd));  // makes y and y' continuous at the end of the parabola
  const double s = length / kReach, t = 1. + s, per_square = 1. / (kReach * kReach);
  if (s < kParabolaEnd) return {kSteep * s * s, 2. * kSteep * per_square, 2. * kSteep * per_square};
  return {s / t - kParabolaEnd / (1. + kParabolaEnd) + kSteep * kParabolaEnd * kParabolaEnd, per_square / (s * t * t),
          -2. * per_square / (t * t * t)};
}

class MinimalConvexCore final : public Nlp {
 public:
  MinimalConvexCore() {
    const Vector3d half_axes(.08, .2, .3), center(0., 0., .5);
    std::array<Vector3d, kCorners> unit;
    for (int i = 0; i < kCorners; ++i) {
      unit[i] = Vector3d(kDirections[i][0], kDirections[i][1], kDirections[i][2]).normalized();
      corners_.col(i) = half_axes.cwiseProduct(unit[i]) + center;
      for (int j = 0; j < i; ++j) {
        if (unit[i].dot(unit[j]) > .4) edges_.push_back({i, j});
      }
    }
    types_.assign(1, f);
    types_.insert(types_.end(), kCorners, ineq);
    types_.insert(types_.end(), 3 * kCorners, sos);
    const Vector3d outer = half_axes.array() + kRadius;
    lower_ = (center - outer).replicate(kCorners, 1);
    upper_ = (center + outer).replicate(kCorners, 1);
  }

  Jacobian makeJacobian() const override {
    Jacobian J;
    J.columns = dimension();
    J.addRow({{0, dimension()}});
    for (int i = 0; i < kCorners; ++i) J.addRow({{3 * i, 3}});
    for (int k = 0; k < 3 * kCorners; ++k) J.addRow({{k, 1}});
    return J;
  }

  void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) override {
    prepareEvaluation(*this, x, phi, J);
    phi.setZero();
    VectorXd gradient = VectorXd::Zero(dimension());
    for (const auto& [a, b] : edges_) {
      const Vector3d offset = x.segment<3>(3 * a) - x.segment<3>(3 * b);
      const Attraction y = attractionAt(offset.norm());
      phi[0] += kSides * y.value;
      gradient.segment<3>(3 * a) += kSides * y.slope_per_length * offset;
      gradient.segment<3>(3 * b) -= kSides * y.slope_per_length * offset;
    }
    for (int i = 0; i < kCorners; ++i) phi[1 + i] = (corners_.col(i) - x.segment<3>(3 * i)).norm() - kRadius;
    if (!J) return;
    double* values = J->values.data();
    Eigen::Map<VectorXd>(values, dimension()) = gradient;
    Eigen::Map<VectorXd> normals(values + dimension(), 3 * kCorners);
    for (int i = 0; i < kCorners; ++i) {
      const Vector3d offset = x.segment<3>(3 * i) - corners_.col(i);
      const double length = offset.norm();
      normals.segment<3>(3 * i) = length > 1e-6 ? Vector3d(offset / length) : Vector3d(Vector3d::Zero());
    }
    Eigen::Map<VectorXd>(values + dimension() + 3 * kCorners, 3 * kCorners).setZero();
  }

  bool addCostHessian(const VectorXd& x, MatrixXd& H) override {
    for (const auto& [a, b] : edges_) {
      const Vector3d offset = x.segment<3>(3 * a) - x.segment<3>(3 * b);
      const double length = offset.norm();
      const Attraction y = attractionAt(length);
      Matrix3d block = y.slope_per_length * Matrix3d::Identity();
      if (length > 0.) block += (y.curvature - y.slope_per_length) / (length * length) * offset * offset.transpose();
      block *= kSides;
      H.block<3, 3>(3 * a, 3 * a) += block;
      H.block<3, 3>(3 * b, 3 * b) += block;
      H.block<3, 3>(3 * a, 3 * b) -= block;
      H.block<3, 3>(3 * b, 3 * a) -= block;
    }
    return true;
  }

  VectorXd initialPoint(Rng& rng) override {
    VectorXd x = Eigen::Map<const VectorXd>(corners_.data(), dimension());
    for (double& value : x) value += .01 * rng.normal();
    return x;
  }

  std::string report(int) const override { return "MinimalConvexCore: 18 balls in an ellipsoid"; }

 private:
  static constexpr double kSides = 2.;  ///< number of triangles that share an edge

  Eigen::Matrix<double, 3, kCorners> corners_;
  std::vector<std::pair<int, int>> edges_;
};

}  // namespace

std::shared_ptr<Nlp> makeMinimalConvexCore() { return std::make_shared<MinimalConvexCore>(); }

}  // namespace kinegraph::inline nlp_internal
