#pragma once

#include <string>

namespace kinegraph {

struct Joints {
  const char* first;
  const char* second;
};

/// Objectives of all types.
constexpr Joints kTwoJoints[] = {
    {"joint: hingeX", "joint: hingeY"},        {"joint: hingeZ, joint_scale: 1.7", "joint: hinge, axis: [1 2 -1]"},
    {"joint: transX", "joint: transZ"},        {"joint: transXYPhi", "joint: hingeX"},
    {"joint: phiTransXY", "joint: transYPhi"}, {"joint: universal", "joint: trans3"},
    {"joint: quatBall", "joint: hingeY"},      {"joint: hingeZ", "joint: free"},
    {"joint: circleZ", "joint: XBall"},        {"joint: hingeX", "joint: hingeY, mimic: upper, joint_scale: -.6"},
};

/// An arm of two joints with a finger, another one of a joint that carries a box, and a ball in between.
inline std::string twoArms(const std::string& first, const std::string& second) {
  return "world: {}\n"
         "upper(world): { pre: \"t(.1 .1 0) d(70 1 .2 .5)\", " +
         first +
         ", shape: capsule, size: [.2 .05], contact: 1 }\n"
         "lower(upper): { pre: \"t(.15 0 .2) d(-50 .4 1 .3)\", " +
         second +
         " }\n"
         "finger(lower): { Q: \"t(.05 .02 .15) d(35 1 .6 .2)\", shape: capsule, size: [.2 .03], contact: 1 }\n"
         "other(world): { pre: \"t(.2 .25 .05) d(-40 .2 .3 1)\", " +
         second +
         " }\n"
         "box(other): { Q: \"t(-.05 .06 .02) d(20 .5 1 .1)\", shape: ssBox, size: [.15 .12 .1 .02], contact: 1 }\n"
         "ball: { X: \"t(.35 -.05 .3)\", shape: sphere, size: [.06], contact: 1 }\n";
}

}  // namespace kinegraph
