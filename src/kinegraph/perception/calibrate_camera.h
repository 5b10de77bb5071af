#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// Images of known points, such as the corners of a marker, taken at several configurations.
struct MarkerImages {
  MatrixXd points;                     ///< (n, 3): points of the marker in the frame of the marker, m; n >= 4
  Vector4d fxycxy = Vector4d::Zero();  ///< fx fy cx cy in pixels
  MatrixXd q;                          ///< (K, dofs): configurations of the scene; K >= 3
  std::vector<MatrixXd> pixels;  ///< K times (n, 2): column and row of each point. The middle of the first pixel is
                                 ///< (.5, .5). A row of NaN: not seen
};

struct CalibrateOptions {
  double pixel_noise = .1;    ///< standard deviation of a coordinate of a point in an image, pixels
  double joint_noise = 3e-4;  ///< standard deviation of a joint angle (rad) or slide (m), independent in each image

  /// Throws ValueError for numbers that are not positive.
  void validate() const;
};

/// The poses of a camera and a marker, relative to the frames that they are attached to.
struct CameraCalibration {
  Pose camera, marker;
  MatrixXd covariance;  ///< 6 x 6, of the camera: (x y z in m, rotation vector in rad), in the axes of its parent
  MatrixXd marker_covariance;                        ///< the same of the marker
  MatrixXd free_directions = MatrixXd::Zero(0, 12);  ///< rows: unit displacements (camera, marker) that the images do
                                                     ///< not determine, in the axes of the parents
  double pixel_error = 0.;                           ///< root mean square of the distances in the images, pixels
  std::vector<std::string> warnings;

  std::string str() const;
};

/// Finds the poses of a camera and a marker relative to their parents, and moves both frames there.
///
/// One of them is carried by the robot, the other one is fixed: a camera on the hand and a marker on the table, or a
/// camera beside the robot and a marker in the hand. Their present poses do not matter if the points lie in a plane;
/// otherwise they are the start. With the configurations q_k and the pose A_k of the camera's parent in that of the
/// marker's,
///
///     minimize  sum_k | project(X^-1 A_k^-1 M p_i) - pixel_ki |^2_{S_k},   S_k = sigma_p^2 I + sigma_q^2 J_k J_k^T
///
/// over the poses X and M. J_k is the derivative of the pixels by the joints, so that the covariance includes errors of
/// the joints; it is enlarged if the pixels fit worse than the noise. The start is linear in the images' homographies.
/// Source: Shah, Solving the robot-world/hand-eye calibration problem using the Kronecker product, 2013.
///
/// Warns if the images do not determine the poses to 5 mm and 1 degree, and if the points fit badly. Throws
/// FrameNotFound, and ValueError for arrays of wrong sizes, lengths that look like millimeters, and if no joint moves
/// the camera relative to the marker; the scene is then unchanged.
CameraCalibration calibrateCamera(Config& config, const std::string& camera, const std::string& marker,
                                  const MarkerImages& images, const CalibrateOptions& options = {});

}  // namespace kinegraph
