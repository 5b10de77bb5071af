#pragma once

#include "kinegraph/math/eigen.h"

namespace kinegraph {

/// Rows of a Jacobian in row-major order, as a view that features write or add to.
using JacobianRows =
    Eigen::Ref<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>, 0, Eigen::OuterStride<>>;

}  // namespace kinegraph
