#pragma once

#include <functional>
#include <span>
#include <vector>

#include "kinegraph/collision/edge_checkers.h"
#include "kinegraph/common/cancellation.h"
#include "kinegraph/features/residual.h"
#include "kinegraph/geometry/distance/proximity.h"

namespace kinegraph {

/// One configuration per row: its joint vector, or what is computed from it.
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// How the functions below share their work. The results do not depend on it.
struct BatchOptions {
  int threads = 1;                      ///< the calling one included
  CancellationToken cancellation = {};  ///< called on the calling thread every few configurations; may throw to stop
  int lanes = 0;                        ///< configurations side by side: one of laneWidths(), 0 for the widest
  EdgeCheckers* checkers = nullptr;     ///< what areValid and areMotionsFree keep for the next call; none: nothing
};

// What follows evaluates many configurations of a scene, the rows of Q (N x dofs), and needs no memory per
// configuration. `scene` is any State of it; its own q does not matter. All throw ValueError if Q has another number of
// columns or numbers that are not finite, naming the row.

/// Value y (N x rows) of a residual of one configuration, and where given its Jacobian J ((N rows) x dofs): that of
/// configuration i starts at row i * rows.
void evalBatch(const State& scene, const Residual& residual, const Eigen::Ref<const RowMatrix>& Q,
               Eigen::Ref<RowMatrix> y, JacobianRows* J, const BatchOptions& options = {});

/// Geometric Jacobians of frames ((N 6f) x dofs): per configuration and frame the rows of its origin's velocity, m/s,
/// and of its angular velocity, rad/s, in world coordinates.
void frameJacobians(const State& scene, const std::vector<int>& frames, const Eigen::Ref<const RowMatrix>& Q,
                    JacobianRows J, const BatchOptions& options = {});

/// World poses of frames: N x 7f, per frame x y z qw qx qy qz with qw >= 0.
void framePoses(const State& scene, const std::vector<int>& frames, const Eigen::Ref<const RowMatrix>& Q,
                Eigen::Ref<RowMatrix> poses, const BatchOptions& options = {});

/// Signed distances of all collidable pairs, in their order: N x pairs, m, negative where they penetrate.
void pairDistances(const State& scene, const Eigen::Ref<const RowMatrix>& Q, Eigen::Ref<RowMatrix> distances,
                   const BatchOptions& options = {});

/// Where the nearest points of p pairs of a configuration are written.
struct NearestRow {
  double* distances;  ///< p, m
  double* points;     ///< p x 2 x 3: on the surfaces of both frames of the pair, world coordinates, m
  double* normals;    ///< p x 3: unit, from the second to the first

  void write(int pair, const Proximity& near) const;
};

/// Distances of all collidable pairs, in their order, with nearest points. Each configuration's numbers follow the last
/// one's; `first` says where the first one's are.
void nearestPoints(const State& scene, const Eigen::Ref<const RowMatrix>& Q, const NearestRow& first,
                   const BatchOptions& options = {});

/// Per configuration: are all dofs within their limits (to kLimitTolerance, 1e-5 rad or m), and all pairs that joints move
/// apart at least `margin` (m) apart?
void areValid(const State& scene, const Eigen::Ref<const RowMatrix>& Q, double margin, std::span<bool> valid,
              const BatchOptions& options = {});

/// Per straight motion, from a row of `from` to that row of `to`: are all dofs within their limits, as in areValid, and
/// do all pairs that joints move apart keep `margin` (m) apart, at all times of it? `tolerance` (m, > 0) as in
/// MotionChecker.
void areMotionsFree(const State& scene, const Eigen::Ref<const RowMatrix>& from, const Eigen::Ref<const RowMatrix>& to,
                    double margin, double tolerance, std::span<bool> free, const BatchOptions& options = {});

}  // namespace kinegraph
