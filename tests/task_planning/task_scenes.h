#pragma once

#include <string>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// A table, and a hand that slides above it, whose limits are its reach.
inline Config handAboveATable(const std::string& limits = "[-.9 -.9 0 .9 .9 1]", const std::string& q = "[0 0 .5]") {
  Config C;
  C.addFrame("base").setPosition({0., 0., .6});
  C.addFrame("table", "base", "shape: ssBox, size: [2 2 .1 .02], contact: 1, rel: [0 0 -.05], logical: { is_place }");
  C.addFrame(
      "hand", "base",
      "shape: marker, size: [.03], joint: trans3, limits: " + limits + ", q: " + q + ", logical: { is_gripper }");
  return C;
}

/// With cubes that are places, too.
inline Config cubesOnATable(int count) {
  Config C = handAboveATable();
  for (int i = 0; i < count; ++i) {
    Frame cube = C.addFrame("b" + std::to_string(i), "table", "logical: { is_object, is_place }");
    cube.setRelativePosition({-.5 + .4 * i, .2 * i, .1}).setJoint(JointType::rigid);
    cube.setShape(ShapeType::ssBox, {.1, .1, .1, .004}).setContact(1);
  }
  return C;
}

/// A hand that cannot leave y <= .1, a stick with a hook at its far end, and a box behind that.
inline Config stickAndBox(double y) {
  Config C = handAboveATable("[-.9 -.9 0 .9 .1 1]", "[0 -.3 .5]");
  C.addFrame("stick", "table", "joint: rigid, logical: { is_object }").setRelativePosition({-.2, -.3, .065});
  C.getFrame("stick").setShape(ShapeType::ssBox, {.03, .5, .03, .004}).setContact(1);
  C.addFrame("hook", "stick", "logical: { is_hook }").setRelativePosition({.085, .235, 0.});
  C.getFrame("hook").setShape(ShapeType::ssBox, {.14, .03, .03, .004}).setContact(1);
  C.addFrame("box", "table", "joint: rigid, logical: { is_object }").setRelativePosition({.1, y, .08});
  C.getFrame("box").setShape(ShapeType::ssBox, {.06, .06, .06, .004}).setContact(1);
  return C;
}

/// A hand with fingers that turns about x, and a drawer with a post as a handle, in a case that is closed all around.
inline Config drawerAndCup() {
  Config C;
  C.addFrame("base").setPosition({0., 0., .6});
  C.addFrame("table", "base", "shape: ssBox, size: [2 2 .1 .02], contact: 1, rel: [0 0 -.05], logical: { is_place }");
  C.addFrame("carriage", "base", "joint: trans3, limits: [-.9 -.9 0 .9 .9 1], q: [0 -.4 .5]");
  C.addFrame("gripper", "carriage",
             "shape: marker, size: [.03], joint: hingeX, limits: [-1.66 1.66], logical: { is_gripper }, opening: .09");
  C.addFrame("palm", "gripper", "shape: ssBox, size: [.06 .06 .04 .004], contact: 1, rel: [0 0 .08]");
  C.addFrame("left", "base", "shape: ssBox, size: [.02 .4 .22 .004], contact: 1, rel: [-.19 .5 .11]");
  C.addFrame("right", "base", "shape: ssBox, size: [.02 .4 .22 .004], contact: 1, rel: [.19 .5 .11]");
  C.addFrame("back", "base", "shape: ssBox, size: [.4 .02 .22 .004], contact: 1, rel: [0 .71 .11]");
  C.addFrame("roof", "base", "shape: ssBox, size: [.4 .4 .02 .004], contact: 1, rel: [0 .5 .23]");
  C.addFrame("rail", "base", "rel: [0 .3 0]");
  C.addFrame("drawer", "rail", "joint: transY, limits: [-.3 0], q: [0], logical: { is_drawer }");
  C.addFrame("floor", "drawer",
             "shape: ssBox, size: [.32 .34 .02 .004], contact: 1, rel: [0 .18 .02], logical: { is_place }");
  C.addFrame("front", "drawer", "shape: ssBox, size: [.34 .02 .16 .004], contact: 1, rel: [0 -.01 .09]");
  C.addFrame("handle", "drawer",
             "shape: ssBox, size: [.02 .02 .1 .004], contact: 1, rel: [0 -.06 .1], logical: { is_handle }");
  C.addFrame("cup", "table", "joint: rigid, shape: ssBox, size: [.06 .06 .1 .004], contact: 1, logical: { is_object }");
  C.getFrame("cup").setRelativePosition({-.3, -.5, .1});
  return C;
}

}  // namespace kinegraph
