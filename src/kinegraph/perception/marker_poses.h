#pragma once

#include <optional>

#include "kinegraph/perception/calibrate_camera.h"

namespace kinegraph::inline perception_internal {

/// The pose of a marker with points in the plane z = 0 in the frame of the camera, from the homography of its points;
/// none for fewer than four points, or if they are on a line.
std::optional<RigidTransform> markerInCamera(const MatrixXd& points, const MatrixXd& pixels, const Vector4d& fxycxy);

struct LinearCalibration {
  RigidTransform camera, marker;
};

/// Solves A_k X B_k = M for the poses X of the camera and M of the marker, with B_k from markerInCamera. None if the
/// points are not in the plane z = 0, or for too few images.
std::optional<LinearCalibration> linearCalibration(const std::vector<RigidTransform>& arms, const MarkerImages& images);

}  // namespace kinegraph::inline perception_internal
