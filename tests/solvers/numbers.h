#pragma once

#include <initializer_list>
#include <limits>

#include "kinegraph/common/random.h"
#include "kinegraph/math/pose.h"

namespace kinegraph {

constexpr double kInf = std::numeric_limits<double>::infinity();

inline VectorXd vec(std::initializer_list<double> values) {
  return Eigen::Map<const VectorXd>(values.begin(), Eigen::Index(values.size()));
}

/// Normally distributed.
inline MatrixXd randomMatrix(int rows, int columns, Rng& rng) {
  MatrixXd M(rows, columns);
  for (double& value : M.reshaped()) value = rng.normal();
  return M;
}

}  // namespace kinegraph
