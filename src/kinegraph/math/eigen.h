#pragma once

// Eigen, and a check that the program and the library use it alike. All headers include Eigen through this one.
#include "kinegraph/common/compiler_check.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <kinegraph/build_check.h>

namespace kinegraph {

/// Rows of a Jacobian in row-major order, as a view that features write or add to.
using JacobianRows =
    Eigen::Ref<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>, 0, Eigen::OuterStride<>>;

}  // namespace kinegraph
