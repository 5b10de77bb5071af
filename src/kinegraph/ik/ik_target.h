#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "kinegraph/features/feature_source.h"
#include "kinegraph/features/scale.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

/// A feature that is to have a value: |scale (y - target)| is at most the tolerance, in every row.
struct IkFeature {
  FeatureSource source;
  std::vector<std::string> frames;
  double tolerance = 1e-6;  ///< in the feature's units times the scale
  Scale scale{};
  bool at_most = false;  ///< scale (y - target) may be negative, too: y is at most the target
};

/// Where a frame is to be, in the world or as seen from another frame, or what a feature is to be. Several targets may
/// name the same frame.
struct IkTarget {
  enum class Kind {
    pose,       ///< position and rotation
    position,   ///< of the origin, m
    rotation,   ///< the position is free
    direction,  ///< an axis of the frame points along a direction; rotation about it is free
    gaze,       ///< an axis of the frame, from its origin on, points at a point
    feature,    ///< of any frames
  };
  std::string frame;  ///< none of a feature
  Kind kind = Kind::pose;
  Pose pose;                          ///< of pose, position, rotation; its position is the point of a gaze
  Vector3d axis = Vector3d::UnitZ();  ///< of direction and gaze: in the frame's coordinates
  Vector3d direction = Vector3d::UnitZ();
  std::string relative_to{};  ///< the frame whose coordinates pose and direction are in; none: the world
  std::string taken_from{};   ///< the frame whose present pose the numbers are, if they are: it must stay at them
  std::shared_ptr<const IkFeature> feature{};
  VectorXd value{};  ///< of a feature: its target; empty (0), 1 number for all rows, or one per row

  static IkTarget toPose(std::string frame, const Pose& X_WF) { return {std::move(frame), Kind::pose, X_WF}; }
  static IkTarget toPosition(std::string frame, const Vector3d& p_WF) {
    return {std::move(frame), Kind::position, Pose(p_WF, Quaterniond::Identity())};
  }
  static IkTarget toRotation(std::string frame, const Quaterniond& R_WF) {
    return {std::move(frame), Kind::rotation, Pose(Vector3d::Zero(), R_WF)};
  }
  static IkTarget toDirection(std::string frame, const Vector3d& axis, const Vector3d& direction) {
    return {std::move(frame), Kind::direction, Pose(), axis, direction};
  }

  /// Where another frame is at present. That it then stays there is checked: solveIk throws if the targets move it.
  static IkTarget toPose(std::string frame, const Frame& there) {
    return takenFrom(there, toPose(std::move(frame), there.getPose()));
  }
  static IkTarget toPosition(std::string frame, const Frame& there) {
    return takenFrom(there, toPosition(std::move(frame), there.getPose().p));
  }

  /// An axis of the frame, such as the z axis of a camera, points at a point ...
  static IkTarget toGaze(std::string frame, const Vector3d& point, const Vector3d& axis = Vector3d::UnitZ()) {
    return {std::move(frame), Kind::gaze, Pose(point, Quaterniond::Identity()), axis};
  }
  /// ... or at the origin of another frame, wherever that goes.
  static IkTarget toGaze(std::string frame, const Frame& at, const Vector3d& axis = Vector3d::UnitZ()) {
    return toGaze(std::move(frame), Vector3d(Vector3d::Zero()), axis).relativeTo(at.getName());
  }

  /// Any feature of order 0 equals a target.
  static IkTarget toFeature(const IkFeature& feature, const Target& target = {}) {
    IkTarget result;
    result.kind = Kind::feature;
    result.feature = std::make_shared<const IkFeature>(feature);
    result.value = target.vector();
    return result;
  }
  /// The common center of mass of frames, without any of all that moves, is at a point (m).
  static IkTarget toCenterOfMass(const Vector3d& point, std::vector<std::string> frames = {}, double tolerance = 1e-6) {
    return toFeature({centerOfMass(), std::move(frames), tolerance}, point);
  }
  /// That feature; its rows are those of a position.
  static FeatureSource centerOfMass();

  /// The same in the coordinates of another frame. Both may move.
  IkTarget relativeTo(std::string other) const {
    IkTarget result = *this;
    result.relative_to = std::move(other);
    return result;
  }

 private:
  static IkTarget takenFrom(const Frame& there, IkTarget target) {
    target.taken_from = there.getName();
    return target;
  }
};

}  // namespace kinegraph
