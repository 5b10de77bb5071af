#pragma once

#include <initializer_list>
#include <utility>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// Factor of a residual: nothing (1), a number, one number per row of the feature, or a matrix that mixes rows.
/// Converts from `10.`, `{1., 1., .1}`, `Vector3d(1., 1., .1)`, or a matrix.
class Scale {
 public:
  Scale() = default;
  Scale(double number) : matrix_(MatrixXd::Constant(1, 1, number)) {}
  Scale(std::initializer_list<double> per_row)
      : matrix_(Eigen::Map<const VectorXd>(per_row.begin(), Eigen::Index(per_row.size()))) {}
  Scale(MatrixXd matrix) : matrix_(std::move(matrix)) {}
  template <class Derived>
  Scale(const Eigen::MatrixBase<Derived>& matrix) : matrix_(matrix) {}

  /// Empty, 1 x 1, a column, or rows x columns.
  const MatrixXd& matrix() const { return matrix_; }

 private:
  MatrixXd matrix_;
};

/// Target of a feature: nothing (0), a number for all rows, or one number per row.
class Target {
 public:
  Target() = default;
  Target(double number) : vector_(VectorXd::Constant(1, number)) {}
  Target(std::initializer_list<double> per_row)
      : vector_(Eigen::Map<const VectorXd>(per_row.begin(), Eigen::Index(per_row.size()))) {}
  Target(VectorXd vector) : vector_(std::move(vector)) {}
  template <class Derived>
  Target(const Eigen::MatrixBase<Derived>& vector) : vector_(vector) {}

  const VectorXd& vector() const { return vector_; }  ///< empty, 1 number, or one per row

 private:
  VectorXd vector_;
};

}  // namespace kinegraph
