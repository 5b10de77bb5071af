#pragma once

#include <memory>
#include <string>
#include <string_view>
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

/// What the registry knows of a symbol.
struct FeatureInfo {
  FeatureSymbol symbol;
  std::string name;
  int min_frames, max_frames;  ///< max -1: any number
  bool available;              ///< false: makeFeature explains why not
};

/// All names, aliases included (`negDistance`, `jointState`).
const std::vector<FeatureInfo>& featureRegistry();
const FeatureInfo& featureInfo(FeatureSymbol symbol);

/// Throws NameError with the nearest names.
FeatureSymbol featureSymbolFromName(std::string_view name);

/// The feature of that symbol for the frames with these ids. Throws ValueError for a wrong number of frames, saying how
/// many the symbol takes, and for frames that lack what it needs (a box, a joint).
std::unique_ptr<Feature> makeFeature(FeatureSymbol symbol, const std::vector<int>& frames, const Program& program);

}  // namespace kinegraph
