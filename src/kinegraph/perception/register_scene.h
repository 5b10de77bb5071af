#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// A depth image with the camera that took it. The camera looks along z of its frame, x to the right and y down. Pixel
/// (row, column) shows the point X = (column + .5 - cx) d / fx, Y = (row + .5 - cy) d / fy, Z = d.
struct DepthView {
  std::vector<float> depth;            ///< m, row by row; zero, negative and non-finite numbers: not measured
  int width = 0, height = 0;           ///< pixels
  Vector4d fxycxy = Vector4d::Zero();  ///< fx fy cx cy in pixels
  std::string camera = {};             ///< the camera's frame in the scene; empty: `pose`
  Pose pose = {};                      ///< of the camera in the world
  double noise = .0027;                ///< standard deviation of a pixel's depth over its depth squared, 1/m
  double bias = .0019;                 ///< the same for an error that all pixels of an object share, 1/m

  /// Throws ValueError for an image of another size, for a center outside of it, focal lengths that do not fit, depths
  /// whose median is not that of meters, and invalid poses. `where` names the view.
  void validate(const std::string& where) const;

  /// The camera's pose in the world; throws FrameNotFound for an unknown frame.
  Pose cameraPose(const Config& config) const;
};
/// Whether a frame was seen, and why not.
enum class SeenStatus {
  seen,         ///< the pose is measured, and the frame was moved to it
  occluded,     ///< something is in front of it
  not_in_view,  ///< it is outside of all images, or nothing was measured
  not_there,    ///< the cameras looked through its place
  not_found,    ///< it is nowhere in the images, or too little of it: only with Prior::anywhere
};

/// The enumerator's spelling: "not_there".
std::string seenStatusName(SeenStatus status);

/// How a frame was seen.
struct SeenFrame {
  SeenStatus status = SeenStatus::not_in_view;
  Pose pose;            ///< in the world; the last one unless the status is `seen`
  MatrixXd covariance;  ///< 6 x 6, of (x y z in m, rotation vector in rad) in world axes; empty unless seen
  MatrixXd free_directions = MatrixXd::Zero(0, 6);  ///< rows: unit displacements that the images do not determine, as
                                                    ///< in `covariance`
  std::vector<Pose> alternatives;                   ///< other poses that explain the images about as well
  double visible = 0.;  ///< the share of the surface, seen if it were alone, that the cameras measured
  double score = 0.;    ///< 1: all measurements at its surface agree; below 0: it is not there
  std::string by;       ///< occluded: the frame in front of it; "" for something unknown
  /// Other frames that look alike and may be the one seen here, while this one is at their place or not seen. Nothing
  /// but the distances from the last poses tells them apart.
  std::vector<std::string> may_be = {};

  std::string str() const;
};

/// A camera whose pose was estimated.
struct SeenCamera {
  Pose pose;            ///< relative to its parent; of a camera without a frame or a parent, in the world
  MatrixXd covariance;  ///< 6 x 6, of (x y z in m, rotation vector in rad) in the axes of the parent
};

/// The result of registerScene: what was found of each frame, and of cameras and joints if they were estimated.
struct SeenScene {
  std::map<std::string, SeenFrame> frames;
  std::vector<SeenCamera> cameras = {};  ///< one for each view
  std::vector<std::string> joints = {};  ///< names of the joints whose offsets were estimated
  VectorXd joint_offsets = {};           ///< what was added to their angles (rad) and lengths (m)
  MatrixXd joint_covariance = {};        ///< of the offsets
  std::vector<std::string> warnings = {};

  std::string str() const;
};

/// The knowledge of the places of things.
enum class Prior {
  last,      ///< they are within `search_radius` of their last poses
  anywhere,  ///< nothing: they rest anywhere on the support, on any stable face
};

/// Reads "last" or "anywhere". Throws ValueError for another name.
Prior priorFromName(const std::string& name);

/// Sensors that registerScene corrects along with the things.
enum class Estimate {
  camera,  ///< the poses of the cameras, relative to their parents
  joints,  ///< offsets of the active hinges and slides that are not of the frames looked for
};

/// Reads "camera" or "joints". Throws ValueError for another name.
Estimate estimateFromName(const std::string& name);

struct RegisterOptions {
  /// The frame on whose top the things rest, or on the level boxes below it, such as a tray on a table; "": they may be
  /// anywhere in the air. Frames with a joint of their own and frames in a hand never rest.
  std::string support = {};

  double search_radius = .05;  ///< how far a thing may have moved since its last pose, m

  /// With `anywhere`, `support` is required. Frames with a joint are looked for within its limits, frames in a hand
  /// near their last poses.
  Prior prior = Prior::last;

  /// Sensors whose errors are estimated from the points on all shapes of the scene, the robot's own and those of
  /// things. Expected are 2 cm and .03 rad for cameras, .01 rad and 5 mm for joints; what the images do not determine
  /// stays within these standard deviations.
  std::vector<Estimate> estimate = {};

  /// Throws ValueError for an invalid radius, and for `anywhere` without a support.
  void validate() const;
};

/// Moves frames to where depth images show them.
///
/// Each frame starts at its present pose. A robust fit minimizes the distances of measured points from the exact
/// surfaces that face the camera. A thing on a support has x, y and the rotation about z as variables, a frame with a
/// hinge or slide its dof, all others six directions. Measurements of the robot and other shapes of the scene are left
/// out, and a point belongs to one thing only. Of things that look alike, each is taken to be the one that had to move
/// least in sum; `may_be` and a warning name those that may be confused. Frames that are not seen keep their poses.
/// With `estimate`, cameras and joints of the scene are corrected as well. Deterministic.
///
/// Throws FrameNotFound, and ValueError for invalid views and frames without a visible shape; the scene is then
/// unchanged.
SeenScene registerScene(Config& config, std::span<const DepthView> views, const std::vector<std::string>& frames,
                        const RegisterOptions& options = {});

}  // namespace kinegraph
