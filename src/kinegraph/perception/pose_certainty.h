#pragma once

#include "kinegraph/perception/pose_fit.h"

namespace kinegraph::inline perception_internal {

/// How well images determine a pose; both as in SeenFrame.
struct PoseCertainty {
  MatrixXd covariance;       ///< 6 x 6
  MatrixXd free_directions;  ///< n x 6
};

/// Computes the certainty of a fitted pose. The covariance has two parts: pixel noise, correlated over neighboring
/// pixels, and an error of the depth common to all pixels of a view. Rotations by 10 degrees about the main axes of the
/// shape are tested. An axis is free if few pixels (50, or 5 %) change their distances by more than 3 mm, or by 4 % of
/// the radius of a small shape. `points` are every `thinning`-th of those measured.
PoseCertainty poseCertainty(const VisibleShape& shape, const PoseFreedom& freedom,
                            const std::vector<ObservedPoint>& points, int thinning,
                            const std::vector<ObservedView>& views, const RigidTransform& X);

}  // namespace kinegraph::inline perception_internal
