#pragma once

#include <gtest/gtest.h>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// Same shape, and no entry differs by more than `tolerance`. For EXPECT_TRUE.
inline ::testing::AssertionResult near(const MatrixXd& given, const MatrixXd& expected, double tolerance) {
  const bool same_shape = given.rows() == expected.rows() && given.cols() == expected.cols();
  if (same_shape && ((given - expected).array().abs() <= tolerance).all()) return ::testing::AssertionSuccess();
  const Eigen::IOFormat plain(8, Eigen::DontAlignCols, ", ", "; ");
  return ::testing::AssertionFailure() << given.format(plain) << " instead of " << expected.format(plain);
}

}  // namespace kinegraph
