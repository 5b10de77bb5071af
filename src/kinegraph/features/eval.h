#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/features/feature_source.h"
#include "kinegraph/math/eigen.h"
#include "kinegraph/scene/config.h"

namespace kinegraph::inline collision_internal {
class EdgeCheckers;
}

namespace kinegraph::inline features_internal {
class Residual;
}

namespace kinegraph::inline geometry_internal {
struct Proximity;
}

namespace kinegraph::inline kinematics_internal {
class State;
}

namespace kinegraph {

/// A feature's value and its Jacobian with respect to the configuration's q.
struct Evaluation {
  VectorXd y;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> J;
};

/// Evaluates a feature at the present q. Throws ValueError for features that need several configurations.
Evaluation eval(const Config& config, const FeatureSource& feature, const std::vector<std::string>& frames,
                const Scale& scale = {}, const Target& target = {}, int order = -1);

/// One configuration per row: its joint vector, or values computed from it.
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Options of the functions below. They do not affect the results.
struct BatchOptions {
  int threads = 1;                      ///< including the calling thread
  CancellationToken cancellation = {};  ///< polled on the calling thread every few configurations; may throw to stop
  int lanes = 0;                     ///< configurations processed side by side: one of laneWidths(), 0 for the widest
  EdgeCheckers* checkers = nullptr;  ///< checkers that areValid and areMotionsFree reuse between calls; null: none
};

// The functions below evaluate many configurations of a scene, the rows of Q (N x dofs), without memory per
// configuration. `scene` is any State of it; its q does not matter. All throw ValueError if Q has another number of
// columns, or if a row has numbers that are not finite; the message names the row.

/// Computes the value y (N x rows) of a residual of one configuration, and optionally its Jacobian J ((N rows) x dofs).
/// The Jacobian of configuration i starts at row i * rows.
void evalBatch(const State& scene, const Residual& residual, const Eigen::Ref<const RowMatrix>& Q,
               Eigen::Ref<RowMatrix> y, JacobianRows* J, const BatchOptions& options = {});

/// Computes geometric Jacobians of frames ((N 6f) x dofs). For each configuration and frame they have three rows for
/// the velocity of its origin, m/s, and three for its angular velocity, rad/s, in world coordinates.
void frameJacobians(const State& scene, const std::vector<int>& frames, const Eigen::Ref<const RowMatrix>& Q,
                    JacobianRows J, const BatchOptions& options = {});

/// Computes world poses of frames: N x 7f, per frame x y z qw qx qy qz with qw >= 0.
void framePoses(const State& scene, const std::vector<int>& frames, const Eigen::Ref<const RowMatrix>& Q,
                Eigen::Ref<RowMatrix> poses, const BatchOptions& options = {});

/// Computes signed distances of all collidable pairs, in their order: N x pairs, m, negative in penetration.
void pairDistances(const State& scene, const Eigen::Ref<const RowMatrix>& Q, Eigen::Ref<RowMatrix> distances,
                   const BatchOptions& options = {});

/// Output arrays for the nearest points of p pairs of a configuration.
struct NearestPointArrays {
  double* distances;  ///< p, m
  double* points;     ///< p x 2 x 3: on the surfaces of both frames of the pair, world coordinates, m
  double* normals;    ///< p x 3: unit vectors from the second frame to the first

  void write(int pair, const Proximity& near) const;
};

/// Computes distances of all collidable pairs, in their order, with nearest points. `first` points to the arrays of the
/// first configuration; those of the others follow.
void nearestPoints(const State& scene, const Eigen::Ref<const RowMatrix>& Q, const NearestPointArrays& first,
                   const BatchOptions& options = {});

/// Checks per configuration that all dofs are within their limits (up to kLimitTolerance, 1e-5 rad or m), and that all
/// pairs that joints move relative to each other are at least `margin` (m) apart.
void areValid(const State& scene, const Eigen::Ref<const RowMatrix>& Q, double margin, std::span<bool> valid,
              const BatchOptions& options = {});

/// Checks linear motions from the rows of `from` to the same rows of `to`: their ends are within the limits, as in
/// areValid, and all pairs that joints move relative to each other stay `margin` (m) apart continuously. `tolerance`
/// (m, > 0) as in MotionChecker.
void areMotionsFree(const State& scene, const Eigen::Ref<const RowMatrix>& from, const Eigen::Ref<const RowMatrix>& to,
                    double margin, double tolerance, std::span<bool> free, const BatchOptions& options = {});

}  // namespace kinegraph
