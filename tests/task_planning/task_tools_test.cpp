#include "kinegraph/task_planning/task_tools.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/task_planning/task_scenes.h"

namespace kinegraph {
namespace {

TEST(TaskTools, TheCenterOfABodyIsThatOfItsPartsMasses) {
  Config C = stickAndBox(.3);
  Frame stick = C.getFrame("stick"), hook = C.getFrame("hook");
  EXPECT_TRUE(isCentered(centerOfBody(C.getFrame("box"))));
  stick.setMass(.1);
  EXPECT_LT(centerOfBody(stick).norm(), 1e-12) << "a part without a mass weighs nothing where another one has one";
  hook.setMass(.05);
  EXPECT_LT((centerOfBody(stick) - Vector3d(.085, .235, 0.) / 3.).norm(), 1e-9);
  EXPECT_FALSE(isCentered(centerOfBody(stick)));
}

TEST(TaskTools, HeavyObjectsTurnInTheHandFarFromTheirCenter) {
  Config C = stickAndBox(.3);
  Frame stick = C.getFrame("stick");
  EXPECT_TRUE(std::isinf(leverOf(stick))) << "without a mass";
  stick.setMass(1.);
  EXPECT_NEAR(leverOf(stick), .3 / 9.81, 1e-12);
  C.getFrame("hook").setMass(1.);
  EXPECT_NEAR(leverOf(stick), .15 / 9.81, 1e-12);
  stick.editAttributes().set({"lever", {}, {}, {.01, {}}, {}});
  EXPECT_EQ(leverOf(stick), .01);
  const Vector3d center = stick.getPose().transform() * centerOfBody(stick);
  C.addFrame("fingers").setPosition(center + Vector3d(.02, .03, .04));
  EXPECT_NEAR(leverIn(C.getFrame("fingers"), stick), .03, 1e-9) << "across the axis of the fingers, and level";
}

TEST(TaskTools, WithoutMassesSurfacesWeigh) {
  Config C = stickAndBox(.3);
  const auto surface = [](double a, double b, double c) { return 2. * (a * b + b * c + c * a); };
  const double stick = surface(.03, .5, .03), hook = surface(.14, .03, .03);
  const Vector3d expected = hook / (hook + stick) * Vector3d(.085, .235, 0.);
  EXPECT_LT((centerOfBody(C.getFrame("stick")) - expected).norm(), 2e-3) << "edges are rounded";
}

TEST(TaskTools, AToolLiesFlatOnItsWideSide) {
  Config C = stickAndBox(.3);
  EXPECT_EQ(flatAxis(C.getFrame("hook"), C.getFrame("stick")), 2);
  C.getFrame("hook").setRelativeQuaternion(Quaterniond(Eigen::AngleAxisd(.5 * M_PI, Vector3d::UnitX())));
  EXPECT_EQ(flatAxis(C.getFrame("hook"), C.getFrame("stick")), 1);
}

TEST(TaskTools, WhatIsWideOrSlippyIsPulledHigher) {
  Config C = stickAndBox(.3);
  const Frame box = C.getFrame("box");
  const Frame table = C.getFrame("table");
  EXPECT_DOUBLE_EQ(tippingHeight(box, table, .06), .03) << "friction is 1 where nothing is said";
  const auto setFriction = [&](const char* name, double friction) {
    Node node;
    node.key = "friction";
    node.value.data = friction;
    C.getFrame(name).editAttributes().set(node);
  };
  setFriction("table", 0.);
  EXPECT_DOUBLE_EQ(tippingHeight(box, table, .06), .06) << "the mean of the two";
  setFriction("box", 0.);
  EXPECT_TRUE(std::isinf(tippingHeight(box, table, .06)));
}

TEST(TaskTools, WhatHangsOverTooFarIsNotSupported) {
  Config C = stickAndBox(.3);
  Frame stick = C.getFrame("stick");
  const Frame box = C.getFrame("box");
  EXPECT_TRUE(isSupported(stick, C.getFrame("table")));
  EXPECT_TRUE(isSupported(box, C.getFrame("table")));
  const Vector3d on_box = box.getPosition() + Vector3d(0., 0., .045);
  stick.setPosition(on_box);
  EXPECT_FALSE(isSupported(stick, box)) << "its middle is above the box, what it weighs is not";
  stick.setPosition(on_box - centerOfBody(stick));
  EXPECT_TRUE(isSupported(stick, box));
  C.getFrame("hook").setMass(1.);
  EXPECT_FALSE(isSupported(stick, box)) << "the weight is at the hook";
}

}  // namespace
}  // namespace kinegraph
