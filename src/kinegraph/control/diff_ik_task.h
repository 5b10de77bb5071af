#pragma once

#include <string>
#include <vector>

#include "kinegraph/control/chatter_damping.h"
#include "kinegraph/control/diff_ik.h"
#include "kinegraph/features/residual.h"

namespace kinegraph {

/// A task or an equality, with its residual at the present step.
struct DiffIk::Task {
  FeatureSource feature;
  std::vector<std::string> frames;
  double weight, gain;
  VectorXd target;
  int priority;                    ///< kEquality for an equality
  std::vector<Residual> residual;  ///< one
  VectorXd y;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> J;
  VectorXd left = {};         ///< what the last step left of it, by its linear model
  decltype(J) J_before = {};  ///< at the step before
  TaskCurvature curvature = {};

  void findLeft(const VectorXd& change) {
    left.noalias() = J * change;
    left += gain * y;
  }

  void makeRoom(int dofs) {
    const int rows = residual[0].rows();
    y.setZero(rows), left.setZero(rows), J.setZero(rows, dofs), J_before.setZero(rows, dofs);
  }
};

}  // namespace kinegraph
