#pragma once

#include <memory>
#include <vector>

#include "kinegraph/features/feature.h"

namespace kinegraph::inline features_internal {

/// The residual of a feature y for an optimizer:  scale * (d^k y / dt^k - target).
///
/// The derivative is a backward difference over consecutive configurations. The sign of a quaternion is the one nearer
/// to the target, or to the next configuration. Copies share the feature and have a workspace of their own, so that
/// each thread can evaluate one.
class Residual {
 public:
  /// `scale`: empty (1), 1 x 1, a column (one number per row), or m x rows, which gives m rows. `target`: empty, 1
  /// number (for all rows), or one per row. `order`: the order of the derivative; -1 is that of the feature itself.
  /// `name` is for messages. Throws ValueError for sizes that do not fit, and for an order below the feature's own.
  Residual(std::shared_ptr<const Feature> feature, MatrixXd scale, VectorXd target, int order, std::string name);

  int rows() const { return rows_; }

  /// Returns the number of configurations that eval needs, minus one.
  int order() const { return feature_->order() + differences_; }

  /// Returns true if the Jacobian is the same in all configurations.
  bool isLinear() const { return feature_->isLinear() && feature_->quaternionRow() < 0; }

  /// Divides by sqrt(tau) instead of tau in the outermost difference, so that sums of squares approximate time
  /// integrals.
  void setTimeIntegral(bool on) { time_integral_ = on; }

  void setScale(MatrixXd scale);
  void setTarget(VectorXd target);

  const std::string& name() const { return name_; }
  const MatrixXd& scale() const { return scale_; }
  const VectorXd& target() const { return target_; }

  /// Returns true if eval reports zero rows of the Jacobian.
  bool reportsZeroRows() const { return flat_value_.has_value(); }

  /// Computes value and Jacobian at order() + 1 configurations, oldest first, `tau` seconds apart. `y` has rows()
  /// entries. `J` may be null; otherwise it has rows() rows and a block of columns per configuration, and comes filled
  /// with zeros. If reportsZeroRows() and `zero_row` is not null, it sets `zero_row` to true for rows of the Jacobian
  /// that stay zero.
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J,
            char* zero_row = nullptr);

  /// Returns true if addCurvature is available. This may depend on the model of the state, but not on its joints.
  bool hasCurvature(const State& state) const { return order() == 0 && feature_->hasCurvature(state); }

  /// Adds sum_i weights_i d^2 y_i / dq^2 to the lower triangle of H, for rows() weights.
  void addCurvature(const State& state, std::span<const double> weights, Eigen::Ref<MatrixXd> H);

  const Feature& feature() const { return *feature_; }

  /// Returns true if the scale is a matrix, so that rows() may differ from that of the feature.
  bool mixesRows() const { return scale_.size() > 1 && !scales_rows_; }

  /// Completes an evaluation of order 0, from the feature's own value and Jacobian: in place if mixesRows() is false,
  /// ...
  void finish(Eigen::Ref<VectorXd> y, JacobianRows* J) const;
  /// ... otherwise from `raw` ones, which it modifies; J comes filled with zeros.
  void mix(Eigen::Ref<VectorXd> raw, JacobianRows* raw_jacobian, Eigen::Ref<VectorXd> y, JacobianRows* J) const;

 private:
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  void evalDifference(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J);
  void alignSign(Eigen::Ref<VectorXd> y, JacobianRows* J) const;
  void subtractTarget(Eigen::Ref<VectorXd> y) const;
  void scaleRows(Eigen::Ref<VectorXd> y, JacobianRows* J) const;
  void evalRaw(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J,
               char* zero_row);

  std::shared_ptr<const Feature> feature_;
  std::string name_;
  MatrixXd scale_;
  VectorXd target_;
  int differences_ = 0, rows_ = 0;
  std::optional<double> flat_value_;  ///< the feature's flat value, if each of its rows is a row here
  bool time_integral_ = false, scales_rows_ = false;
  std::vector<VectorXd> values_;  ///< workspace: the feature's value at each configuration
  std::vector<RowMajor> jacobians_;
  VectorXd raw_;  ///< workspace: value before multiplication by a matrix scale
  RowMajor raw_jacobian_;
};

}  // namespace kinegraph::inline features_internal
