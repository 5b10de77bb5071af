#pragma once

#include <string>
#include <vector>

#include "kinegraph/features/eval.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

// Questions about joint vectors of a scene; its own q does not matter. All throw ValueError if they have another number
// of dofs, or numbers that are not finite.

/// Returns which rows of Q, (N, n), are valid: within the limits (up to 1e-5 rad or m), and with all pairs that joints
/// move relative to each other at least `margin` (m) apart.
std::vector<bool> isValid(const Config& C, const RowMatrix& Q, double margin = 0., int threads = 1);

/// The same for one joint vector, (n,).
template <class Vector>
requires(Vector::ColsAtCompileTime == 1) bool isValid(const Config& C, const Eigen::MatrixBase<Vector>& q,
                                                      double margin = 0.) {
  return isValid(C, RowMatrix(q.transpose()), margin, 1)[0];
}

/// Returns which linear motions from the rows of `start` to those of `end`, (N, n), are within the limits and
/// continuously collision-free. Pairs that come within margin + tolerance (m) may count as contacts.
std::vector<bool> isMotionFree(const Config& C, const RowMatrix& start, const RowMatrix& end, double margin = 0.,
                               double tolerance = 1e-5, int threads = 1);

/// The same for one motion between joint vectors, (n,).
template <class Start, class End>
requires(Start::ColsAtCompileTime == 1 &&
         End::ColsAtCompileTime == 1) bool isMotionFree(const Config& C, const Eigen::MatrixBase<Start>& start,
                                                        const Eigen::MatrixBase<End>& end, double margin = 0.,
                                                        double tolerance = 1e-5) {
  return isMotionFree(C, RowMatrix(start.transpose()), RowMatrix(end.transpose()), margin, tolerance, 1)[0];
}

/// Returns world poses of frames, (N, 7 F): per frame x y z qw qx qy qz. Throws FrameNotFound.
RowMatrix getFramePoses(const Config& C, const RowMatrix& Q, const std::vector<std::string>& frames, int threads = 1);

/// Returns signed distances of all pairs of getCollidablePairs, (N, pairs), m; negative in penetration.
RowMatrix getDistances(const Config& C, const RowMatrix& Q, int threads = 1);

}  // namespace kinegraph
