#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinegraph/features/feature.h"

namespace kinegraph {

/// Features by name. The numbers are those of the Python enum `ry.FS`.
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
  negDistance = distance,  ///< other names
  jointState = qItself,
};

/// What a row of a feature is measured in.
enum class FeatureUnit {
  none,               ///< a number without unit
  meter,              ///< a length
  radian,             ///< an angle
  joint,              ///< m or rad, as the joint of that row
  quaternion,         ///< an entry of a unit quaternion, or of the difference of two
  direction,          ///< an entry of a unit vector, or of the difference of two
  cosine,             ///< the product of two unit vectors
  meter_per_second,   ///< a velocity
  radian_per_second,  ///< an angular velocity
  newton,             ///< a force
  newton_meter,       ///< a torque
  joule,              ///< an energy
};

/// "m", "rad/s", ...; "-" for none.
const char* unitName(FeatureUnit unit);

/// Which joints a feature looks at.
enum class FeatureDofs {
  of_frames,  ///< those that move its frames
  of_joints,  ///< those that its frames have; without frames all
  of_scene,   ///< those of all bodies that may collide, or all quaternions
};

/// A row of the table of features: all that is said of a feature in one place.
struct FeatureInfo {
  using Make = std::unique_ptr<Feature> (*)(const FeatureInfo& info, const std::vector<int>& frames,
                                            const KinematicModel& model);

  FeatureSymbol symbol;
  std::string name;
  const char* alias;           ///< another name; null: there is none
  const char* frames;          ///< what they are, one word each
  int min_frames, max_frames;  ///< max -1: any number
  const char* rows;            ///< their number, or what it depends on
  FeatureUnit unit;            ///< of the first three rows, ...
  FeatureUnit later_unit;      ///< ... and of those after them
  int order;                   ///< of the time derivative that it is by itself
  bool second_derivatives;     ///< does it tell them (Feature::hasCurvature), for some frames at least?
  FeatureDofs dofs;
  const char* reported_as;  ///< what reports call it
  const char* value;        ///< in words, for people
  Make make;                ///< null: it is not available, and `value` says what is

  bool available() const { return make != nullptr; }
  FeatureUnit unitOf(int row) const { return row < 3 ? unit : later_unit; }
};

/// In the order in which people read them. No symbol is there twice.
const std::vector<FeatureInfo>& featureRegistry();

/// Throws NameError for a number that is no symbol.
const FeatureInfo& featureInfo(FeatureSymbol symbol);

/// All names with their symbols, aliases included (`negDistance`, `jointState`).
const std::vector<std::pair<std::string, FeatureSymbol>>& featureNames();

/// Throws NameError with the nearest names.
FeatureSymbol featureSymbolFromName(std::string_view name);

/// The table of features as docs/motion.md has it.
std::string featureTable();

/// The feature of that symbol for the frames with these ids. Throws ValueError for a wrong number of frames, saying how
/// many the symbol takes, and for frames that lack what it needs (a box, a joint).
std::unique_ptr<Feature> makeFeature(FeatureSymbol symbol, const std::vector<int>& frames, const KinematicModel& model);

}  // namespace kinegraph
