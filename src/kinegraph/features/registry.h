#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace kinegraph {

class Feature;
struct KinematicModel;

/// Names of features. The numbers are those of the Python enum `ry.FS`.
enum class FeatureSymbol : int {
  position = 0,
  positionDiff = 1,
  positionRel = 2,
  quaternion = 3,
  quaternionDiff = 4,
  quaternionRel = 5,
  pose = 6,
  poseDiff = 7,
  poseRel = 8,
  vectorX = 9,
  vectorXDiff = 10,
  vectorXRel = 11,
  vectorY = 12,
  vectorYDiff = 13,
  vectorYRel = 14,
  vectorZ = 15,
  vectorZDiff = 16,
  vectorZRel = 17,
  scalarProductXX = 18,
  scalarProductXY = 19,
  scalarProductXZ = 20,
  scalarProductYX = 21,
  scalarProductYY = 22,
  scalarProductYZ = 23,
  scalarProductZZ = 24,
  gazeAt = 25,
  angularVel = 26,
  accumulatedCollisions = 27,
  jointLimits = 28,
  distance = 29,
  oppose = 30,
  qItself = 31,
  aboveBox = 33,
  insideBox = 34,
  pairCollision_negScalar = 35,
  pairCollision_vector = 36,
  pairCollision_normal = 37,
  pairCollision_p1 = 38,
  pairCollision_p2 = 39,
  standingAbove = 40,
  totalForce = 41,
  physics = 42,
  contactConstraints = 43,
  energy = 44,
  EqCenterOfMass = 45,
  transAccelerations = 46,
  transVelocities = 47,
  qQuaternionNorms = 48,
  opposeCentral = 49,
  linangVel = 50,
  AlignXWithDiff = 51,
  AlignYWithDiff = 52,
  scalarProductZX = 53,
  scalarProductZY = 54,
  pairCollisions = 55,
  negDistance = distance,  ///< aliases
  jointState = qItself,
};

/// Unit of a component of a feature.
enum class FeatureUnit {
  none,               ///< dimensionless number
  meter,              ///< a length
  radian,             ///< an angle
  joint,              ///< m or rad, depending on the joint of the component
  quaternion,         ///< component of a unit quaternion, or of the difference of two
  direction,          ///< component of a unit vector, or of the difference of two
  cosine,             ///< product of two unit vectors
  meter_per_second,   ///< a velocity
  radian_per_second,  ///< an angular velocity
  newton,             ///< a force
  newton_meter,       ///< a torque
  joule,              ///< an energy
};

/// Returns "m", "rad/s", ...; "-" for none.
const char* unitName(FeatureUnit unit);

/// The joints on which a feature depends.
enum class FeatureDofs {
  of_frames,  ///< joints that move its frames
  of_joints,  ///< joints of its frames; all joints if it has no frames
  of_scene,   ///< joints of all bodies that may collide, or all quaternions
};

/// An entry of the table of features, with everything that is known about a feature.
struct FeatureInfo {
  using Make = std::unique_ptr<Feature> (*)(const FeatureInfo& info, const std::vector<int>& frames,
                                            const KinematicModel& model);

  FeatureSymbol symbol;
  std::string name;
  const char* alias;           ///< another name; null if there is none
  const char* frames;          ///< roles of the frames, one word each
  int min_frames, max_frames;  ///< max -1 for any number
  const char* rows;            ///< number of components, or the quantity that determines it
  FeatureUnit unit;            ///< of the first three components, ...
  FeatureUnit later_unit;      ///< ... and of those after them
  int order;                   ///< order of its own time derivative
  bool second_derivatives;     ///< Feature::hasCurvature may be true, at least for some frames
  FeatureDofs dofs;
  const char* reported_as;  ///< name in reports
  const char* value;        ///< description for users
  Make make;                ///< null for unavailable features, whose `value` says why

  bool available() const { return make != nullptr; }
  FeatureUnit unitOf(int row) const { return row < 3 ? unit : later_unit; }
};

/// Returns the table in reading order. Each symbol occurs once.
const std::vector<FeatureInfo>& featureRegistry();

/// Throws NameError for a number that is not a symbol.
const FeatureInfo& featureInfo(FeatureSymbol symbol);

/// Returns all names with their symbols, including aliases (`negDistance`, `jointState`).
const std::vector<std::pair<std::string, FeatureSymbol>>& featureNames();

/// Throws NameError with similar names.
FeatureSymbol featureSymbolFromName(std::string_view name);

/// Returns the table of features as it is in docs/features.md.
std::string featureTable();

/// Makes the feature of a symbol for the frames with these ids. Throws ValueError for a wrong number of frames, and for
/// frames that lack a box or joint that the feature needs.
std::unique_ptr<Feature> makeFeature(FeatureSymbol symbol, const std::vector<int>& frames, const KinematicModel& model);

}  // namespace kinegraph
