#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "kinegraph/common/option_table.h"
#include "kinegraph/features/feature_source.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

/// Settings of solveIk; ikOptionTable() documents each one.
struct IkOptions {
  double position_tolerance = 1e-6;
  double rotation_tolerance = 1e-6;
  int attempts = 100;
  int steps = 25;
  bool best = false;
  bool collisions = true;
  double margin = 0.;
  double max_start_penetration = .005;
  double start_weight = 0.;
  double home_weight = 0.;
  std::uint64_t seed = 0;

  /// Throws ValueError that names the first invalid field.
  void validate() const;
};

/// Name, unit, description and range of each field, for messages, bindings and documents.
const OptionTable<IkOptions>& ikOptionTable();

/// A feature with a desired value: |scale (y - target)| is at most the tolerance in every component.
struct IkFeature {
  FeatureSource source;
  std::vector<std::string> frames;
  double tolerance = 1e-6;  ///< in the feature's units times the scale
  Scale scale{};
  bool at_most = false;  ///< only an upper bound: scale (y - target) may be negative
};

/// Desired pose, position, rotation or direction of a frame, in the world or relative to another frame, or desired
/// value of a feature. Several targets may name the same frame.
struct IkTarget {
  enum class Kind {
    pose,       ///< position and rotation
    position,   ///< of the origin, m
    rotation,   ///< rotation only
    direction,  ///< an axis of the frame is parallel to a direction; the rotation about it is free
    gaze,       ///< an axis of the frame, which starts at its origin, points at a point
    feature,    ///< value of a feature of any frames
  };
  std::string frame;  ///< empty for features
  Kind kind = Kind::pose;
  Pose pose;                          ///< for pose, position and rotation; its position is the point of a gaze
  Vector3d axis = Vector3d::UnitZ();  ///< for direction and gaze: in the frame's coordinates
  Vector3d direction = Vector3d::UnitZ();
  std::string relative_to{};  ///< frame in whose coordinates pose and direction are given; empty for the world
  std::string taken_from{};   ///< frame whose present pose the numbers repeat, if any; it must stay there
  std::shared_ptr<const IkFeature> feature{};
  VectorXd value{};  ///< for features: empty (0), one number for all components, or one per component

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

  /// Targets the present pose or position of another frame. solveIk throws if the targets move that frame.
  static IkTarget toPose(std::string frame, const Frame& there) {
    return takenFrom(there, toPose(std::move(frame), there.getPose()));
  }
  static IkTarget toPosition(std::string frame, const Frame& there) {
    return takenFrom(there, toPosition(std::move(frame), there.getPose().p));
  }

  /// Points an axis of the frame, such as the z axis of a camera, at a fixed point.
  static IkTarget toGaze(std::string frame, const Vector3d& point, const Vector3d& axis = Vector3d::UnitZ()) {
    return {std::move(frame), Kind::gaze, Pose(point, Quaterniond::Identity()), axis};
  }
  /// Points an axis of the frame at the origin of another frame, which may move.
  static IkTarget toGaze(std::string frame, const Frame& at, const Vector3d& axis = Vector3d::UnitZ()) {
    return toGaze(std::move(frame), Vector3d(Vector3d::Zero()), axis).relativeTo(at.getName());
  }

  /// Requires that a feature of order 0 equals a target.
  static IkTarget toFeature(const IkFeature& feature, const Target& target = {}) {
    IkTarget result;
    result.kind = Kind::feature;
    result.feature = std::make_shared<const IkFeature>(feature);
    result.value = target.vector();
    return result;
  }
  /// Requires that the common center of mass of frames is at a point (m). Without frames it is that of everything that
  /// moves.
  static IkTarget toCenterOfMass(const Vector3d& point, std::vector<std::string> frames = {}, double tolerance = 1e-6) {
    return toFeature({centerOfMass(), std::move(frames), tolerance}, point);
  }
  /// The feature of toCenterOfMass; its components are those of a position.
  static FeatureSource centerOfMass();

  /// Returns the same target in the coordinates of another frame. Both frames may move.
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
