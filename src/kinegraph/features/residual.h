#pragma once

#include <memory>
#include <vector>

#include "kinegraph/features/feature.h"

namespace kinegraph {

/// What an optimizer sees of a feature y:  scale * (d^k y / dt^k - target).
///
/// The derivative is a backward difference over consecutive configurations. Where the sign of a quaternion carries no
/// meaning, the nearer one to the target, or to the next configuration, is taken. Copies share the feature and have a
/// workspace of their own, so that several threads can evaluate one each.
class Residual {
 public:
  /// `scale`: empty (1), 1 x 1, a column (one per row), or m x rows, which gives m rows. `target`: empty, 1 number (for
  /// all rows), or one per row. `order`: -1 takes that of the feature itself; else the highest derivative. `name` is
  /// for messages. Throws ValueError for sizes that do not fit, and for an order below the feature's own.
  Residual(std::shared_ptr<const Feature> feature, MatrixXd scale, VectorXd target, int order, std::string name);

  int rows() const { return rows_; }

  /// Number of configurations that eval takes, minus one.
  int order() const { return feature_->order() + differences_; }

  /// Is the Jacobian the same in all configurations?
  bool isLinear() const { return feature_->isLinear() && feature_->quaternionRow() < 0; }

  /// In the outermost difference, divides by sqrt(tau) in place of tau: sums of squares then approximate time
  /// integrals.
  void setTimeIntegral(bool on) { time_integral_ = on; }

  void setScale(MatrixXd scale);
  void setTarget(VectorXd target);

  const std::string& name() const { return name_; }
  const MatrixXd& scale() const { return scale_; }
  const VectorXd& target() const { return target_; }

  /// Does eval tell which rows of the Jacobian are zero?
  bool tellsZeroRows() const { return flat_value_.has_value(); }

  /// Value and Jacobian at order() + 1 configurations, oldest first, `tau` seconds apart. `y` has rows() entries; `J`,
  /// where given, rows() rows and a block of columns per configuration, and comes filled with zeros. Where
  /// tellsZeroRows(), it fills in `zero_row`, if that is given: has the row of the Jacobian been left zero?
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J,
            char* zero_row = nullptr);

  /// Can addCurvature tell the second derivatives? This may depend on the program of the state, not on its joints.
  bool hasCurvature(const State& state) const { return order() == 0 && feature_->hasCurvature(state); }

  /// Adds sum_i weights_i d^2 y_i / dq^2 to the lower triangle of H, for rows() weights.
  void addCurvature(const State& state, std::span<const double> weights, Eigen::Ref<MatrixXd> H);

  const Feature& feature() const { return *feature_; }

  /// Is the scale a matrix, so that rows() may differ from those of the feature?
  bool mixesRows() const { return scale_.size() > 1 && !scales_rows_; }

  /// For order 0, what eval makes of the feature's own value and Jacobian: in place where mixesRows() is false, with
  /// ...
  void finish(Eigen::Ref<VectorXd> y, JacobianRows* J) const;
  /// ... else from `raw` ones, which it changes; J comes filled with zeros.
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
  std::optional<double> flat_value_;  ///< of the feature, where each of its rows is one here
  bool time_integral_ = false, scales_rows_ = false;
  std::vector<VectorXd> values_;  ///< workspace: the feature at each configuration
  std::vector<RowMajor> jacobians_;
  VectorXd raw_;  ///< workspace: before a matrix scale
  RowMajor raw_jacobian_;
};

}  // namespace kinegraph
