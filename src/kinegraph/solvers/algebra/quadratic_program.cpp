#include "kinegraph/solvers/algebra/quadratic_program.h"

#include <Eigen/Cholesky>
#include <Eigen/Jacobi>
#include <cmath>
#include <limits>
#include <vector>

namespace kinegraph {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The active set, with the factors N^T = R^T J1^T of its normals in the metric of H, where J J^T = H^-1.
class DualActiveSet {
 public:
  explicit DualActiveSet(const QuadraticProgram& program)
      : p_(program),
        n_(int(program.g.size())),
        m_(int(program.b.size())),
        R_(MatrixXd::Zero(n_, n_)),
        is_active_(m_, false) {}

  QuadraticSolution solve() {
    const Eigen::LLT<MatrixXd> factor(p_.H);
    if (factor.info() != Eigen::Success) return {VectorXd::Zero(n_), VectorXd::Zero(m_), QuadraticStatus::notConvex};
    J_ = factor.matrixU().solve(MatrixXd::Identity(n_, n_));
    x_ = -factor.solve(p_.g);
    norms_ = p_.A.rowwise().norm();
    QuadraticStatus status = QuadraticStatus::solved;
    for (int row = 0; row < p_.equalities && status == QuadraticStatus::solved; ++row) status = takeEquality(row);
    for (int count = 0; status == QuadraticStatus::solved; ++count) {
      const int row = mostViolated();
      if (row < 0) break;
      status = count > 20 * (n_ + m_) ? QuadraticStatus::stalled : takeInequality(row);
    }
    VectorXd multipliers = VectorXd::Zero(m_);
    for (std::size_t k = 0; k < active_.size(); ++k) multipliers[active_[k]] = u_[k];
    return {x_, multipliers, status};
  }

 private:
  double excess(int row) const { return p_.A.row(row).dot(x_) + p_.b[row]; }

  /// Below this a row counts as fulfilled: what rounding leaves of its terms.
  double roundingOf(int row) const {
    return 1e-13 * (norms_[row] * x_.lpNorm<Eigen::Infinity>() + std::abs(p_.b[row])) + 1e-14 * norms_[row];
  }

  int mostViolated() const {
    int worst = -1;
    double largest = 0.;
    for (int row = p_.equalities; row < m_; ++row) {
      if (is_active_[row] || norms_[row] == 0.) continue;
      const double e = excess(row);
      if (e <= roundingOf(row) || e / norms_[row] <= largest) continue;
      largest = e / norms_[row];
      worst = row;
    }
    return worst;
  }

  /// How x (z) and the multipliers (r) move for each unit of the multiplier of `row`.
  void directions(int row) {
    const int q = int(active_.size());
    d_ = J_.transpose() * p_.A.row(row).transpose();
    z_ = -J_.rightCols(n_ - q) * d_.tail(n_ - q);
    r_ = -R_.topLeftCorner(q, q).triangularView<Eigen::Upper>().solve(d_.head(q));
  }

  /// The change of the row's value along z, which is not positive; 0 if the row depends on the active ones.
  double slopeOf() const {
    const double slope = d_.tail(n_ - int(active_.size())).squaredNorm();
    return slope <= 1e-20 * d_.squaredNorm() ? 0. : -slope;
  }

  QuadraticStatus takeEquality(int row) {
    directions(row);
    const double e = excess(row), slope = slopeOf();
    if (slope == 0.)
      return std::abs(e) <= 1e-9 * (1. + std::abs(p_.b[row])) ? QuadraticStatus::solved : QuadraticStatus::infeasible;
    move(-e / slope);
    append(row, -e / slope);
    return QuadraticStatus::solved;
  }

  QuadraticStatus takeInequality(int row) {
    double multiplier = 0.;
    for (;;) {
      directions(row);
      double room = kInfinity;  // until an active inequality's multiplier is zero
      int blocking = -1;
      for (int k = 0; k < int(active_.size()); ++k) {
        if (active_[k] < p_.equalities || r_[k] >= 0. || -u_[k] / r_[k] >= room) continue;
        room = std::max(0., -u_[k] / r_[k]);
        blocking = k;
      }
      const double slope = slopeOf(), wanted = slope < 0. ? excess(row) / -slope : kInfinity;
      const double step = std::min(room, wanted);
      if (step == kInfinity) return QuadraticStatus::infeasible;
      if (wanted == kInfinity) z_.setZero();
      move(step);
      multiplier += step;
      if (wanted <= room) {
        append(row, multiplier);
        return QuadraticStatus::solved;
      }
      remove(blocking);
    }
  }

  void move(double step) {
    x_ += step * z_;
    for (std::size_t k = 0; k < u_.size(); ++k) u_[k] += step * r_[k];
  }

  void append(int row, double multiplier) {
    const int q = int(active_.size());
    for (int i = n_ - 1; i > q; --i) {
      Eigen::JacobiRotation<double> rotation;
      rotation.makeGivens(d_[i - 1], d_[i]);
      d_.applyOnTheLeft(i - 1, i, rotation.adjoint());
      J_.applyOnTheRight(i - 1, i, rotation);
    }
    R_.col(q).head(q + 1) = d_.head(q + 1);
    active_.push_back(row);
    u_.push_back(multiplier);
    is_active_[row] = true;
  }

  void remove(int k) {
    const int q = int(active_.size());
    is_active_[active_[k]] = false;
    active_.erase(active_.begin() + k);
    u_.erase(u_.begin() + k);
    for (int j = k; j + 1 < q; ++j) {
      R_.col(j).head(j + 2) = R_.col(j + 1).head(j + 2);
      Eigen::JacobiRotation<double> rotation;
      rotation.makeGivens(R_(j, j), R_(j + 1, j));
      R_.col(j).applyOnTheLeft(j, j + 1, rotation.adjoint());
      for (int l = j + 2; l < q; ++l) R_.col(l).applyOnTheLeft(j, j + 1, rotation.adjoint());
      J_.applyOnTheRight(j, j + 1, rotation);
    }
    R_.col(q - 1).setZero();
  }

  const QuadraticProgram& p_;
  int n_, m_;
  MatrixXd R_, J_;
  VectorXd x_, norms_, d_, z_, r_;
  std::vector<int> active_;
  std::vector<double> u_;  ///< multipliers of the active rows
  std::vector<bool> is_active_;
};

}  // namespace

QuadraticSolution solve(const QuadraticProgram& program) { return DualActiveSet(program).solve(); }

}  // namespace kinegraph
