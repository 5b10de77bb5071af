#pragma once

#include <string>
#include <utility>
#include <vector>

namespace kinegraph {

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
