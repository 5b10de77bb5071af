#pragma once

#include <string>
#include <utility>
#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// Two shapes that come too close in the motion between two slices.
struct PathContact {
  int slice = 0;         ///< number of the motion's last slice
  double time = 0.;      ///< phase time at which they first come too close
  std::string a, b;      ///< names of their frames
  double distance = 0.;  ///< smallest distance until the slice, m; negative: penetration depth
  double deepest = 0.;   ///< phase time of the smallest distance

  std::string str() const;  ///< such as "'a' and 'b' overlap by 3.1 mm at phase time 0.52, between slices 7 and 8"
};

/// A contact force in a slice.
struct Interaction {
  int slice;
  std::string object, from;
  Vector3d point;  ///< m, in the world
  Vector3d force;  ///< N, on the object, in the world
};

/// Interpolation of waypoints.
struct WaypointOptions {
  int per_phase = 1;
  bool interpolate = false;  ///< cosine blend between waypoints; otherwise piecewise constant
  double towards_home = 0.;  ///< 0..1: pulls the middle of the blend towards home
};

/// Kind of attachment or contact of an object after a mode switch. The numbers are those of the Python enum `ry.SY`.
enum class SwitchMode : int {
  touch = 0,
  above = 1,
  inside = 2,
  oppose = 3,
  restingOn = 4,
  poseEq = 5,
  positionEq = 6,
  stableRelPose = 7,
  stablePose = 8,
  stable = 9,
  stableOn = 10,
  dynamic = 11,
  dynamicOn = 12,
  dynamicTrans = 13,
  quasiStatic = 14,
  quasiStaticOn = 15,
  downUp = 16,
  stableZero = 18,
  contact = 19,
  contactStick = 20,
  contactComplementary = 21,
  bounce = 22,
  push = 23,
  magic = 24,
  magicTrans = 25,
  pushAndPlace = 26,
  topBoxGrasp = 27,
  topBoxPlace = 28,
  dampMotion = 29,
  identical = 30,
  alignByInt = 31,
  makeFree = 32,
  forceBalance = 33,
  relPosY = 34,
  touchBoxNormalX = 35,
  touchBoxNormalY = 36,
  touchBoxNormalZ = 37,
  boxGraspX = 38,
  boxGraspY = 39,
  boxGraspZ = 40,
  lift = 41,
  stableYPhi = 42,
  stableOnX = 43,
  stableOnY = 44,
  end = 46,
};

const std::vector<std::pair<std::string, SwitchMode>>& switchModeNames();
std::string switchModeName(SwitchMode mode);

/// Returns true for modes that attach an object to another frame. The other modes are constraints and contacts.
bool isAttachment(SwitchMode mode);

/// Physical behavior of a contact that may move along both surfaces.
enum class ForceExchange {
  slide,          ///< the bodies touch; the force is along the normal
  stick,          ///< the bodies touch without sliding; at kOrder 0 the force is within the friction cone
  complementary,  ///< the bodies do not overlap; the force is along the normal, and zero unless they touch
  bounce,         ///< the bodies touch in the first slice and separate with 0.9 of the speed; requires kOrder 2
};

/// Parses slide, stick, complementary or bounce. Throws NameError for other names and suggests similar ones.
ForceExchange forceExchangeFromName(const std::string& name);

}  // namespace kinegraph
