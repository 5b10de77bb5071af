#pragma once

#include <string>
#include <vector>

#include "kinegraph/features/batch.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

// Questions about joint vectors of a scene; its own q does not matter. All throw ValueError if they have another number
// of dofs, or numbers that are not finite.

/// Returns whether q, (n,), is within the limits (up to 1e-5 rad or m) and all pairs that joints move relative to each
/// other are at least `margin` (m) apart.
bool isValid(const Config& C, const VectorXd& q, double margin = 0.);

/// The same for each row of Q, (N, n).
std::vector<bool> isValid(const Config& C, const RowMatrix& Q, double margin = 0., int threads = 1);

/// Returns whether the linear motion between two joint vectors, (n,), is within the limits and continuously
/// collision-free. Pairs that come within margin + tolerance (m) may count as contacts.
bool isMotionFree(const Config& C, const VectorXd& start, const VectorXd& end, double margin = 0.,
                  double tolerance = 1e-5);

/// The same for each row of `start` and `end`, (N, n).
std::vector<bool> isMotionFree(const Config& C, const RowMatrix& start, const RowMatrix& end, double margin = 0.,
                               double tolerance = 1e-5, int threads = 1);

/// Returns world poses of frames, (N, 7 F): per frame x y z qw qx qy qz. Throws FrameNotFound.
RowMatrix getFramePoses(const Config& C, const RowMatrix& Q, const std::vector<std::string>& frames, int threads = 1);

/// Returns signed distances of all pairs of getCollidablePairs, (N, pairs), m; negative in penetration.
RowMatrix getDistances(const Config& C, const RowMatrix& Q, int threads = 1);

}  // namespace kinegraph
