#include "kinegraph/tool_paths/plan_tool_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {
namespace {

/// Three hinges in the plane, and more frames; the tool is 1.1 m from the base at most.
Config planarArm(const std::string& more = {}) {
  Config C;
  C.addText(std::string(R"(
base: {}
j1 (base): { joint: hingeZ, limits: [-3 3] }
l1 (j1): { shape: capsule, size: [.3 .03], Q: [.25 0 0 .7071068 0 .7071068 0], contact: 1 }
j2 (j1): { joint: hingeZ, pre: [.5 0 0], limits: [-3 3] }
j3 (j2): { joint: hingeZ, pre: [.5 0 0], limits: [-3 3] }
tool (j3): { shape: sphere, size: [.01], Q: [.1 0 0], contact: -1 }
)") + more);
  VectorXd q = VectorXd::Zero(C.getJointDimension());
  q.head<3>() << .3, .8, -1.1;
  C.setJointState(q);
  return C;
}

Vector3d toolAt(Config& C, const VectorXd& q) {
  C.setJointState(q);
  return C.getFrame("tool").getPosition();
}

TEST(PlanToolPath, FollowsALineAtConstantSpeedWithinTheProvenDeviation) {
  Config C = planarArm();
  const ToolPath path = ToolPath("tool").start(Vector3d(.6, -.2, 0.)).line(Vector3d(.6, .2, 0.));
  const ToolPathPlan plan =
      planToolPath(C, {path}, {.speed = .1, .acceleration = VectorXd{{6.}}, .jerk = VectorXd{{120.}}});
  ASSERT_TRUE(plan.feasible()) << plan.message;
  EXPECT_LE(plan.position_deviation, 2e-5);
  EXPECT_NEAR(plan.duration(), 4. + .1, .05);  // and the ramps
  for (int k = 0; k <= 4000; ++k) {
    const double t = plan.duration() * k / 4000.;
    const Vector3d p = toolAt(C, plan.eval(t).q);
    EXPECT_LE(std::abs(p[0] - .6), plan.position_deviation);
    EXPECT_LE(std::abs(p[1] + .2 - plan.way(t).place), 1e-4);
    EXPECT_LE(plan.speed(t), .1 * (1. + 1e-9));
    if (t > .15 && t < plan.duration() - .15) EXPECT_GT(plan.speed(t), .0995);
  }
}

/// The planar arm turns its last link about the free axis within a range; samples must keep it, too.
TEST(PlanToolPath, TheFreeRotationKeepsItsRangeAndThePreferredAngle) {
  Config C = planarArm();
  const Pose start(Vector3d(.6, -.2, 0.), Quaterniond::Identity());
  const auto plan = [&](std::optional<std::pair<double, double>> range, std::optional<double> prefer) {
    return planToolPath(C, {ToolPath("tool").start(start).line(Vector3d(.6, .2, 0.)).free(2, range, prefer)});
  };
  const auto angles = [&](const ToolPathPlan& motion) {
    double least = 10., most = -10.;
    for (int k = 0; k <= 2000; ++k) {
      const double angle = motion.eval(motion.duration() * k / 2000.).q.sum();
      least = std::min(least, std::remainder(angle, 6.283185307179586)),
      most = std::max(most, std::remainder(angle, 6.283185307179586));
    }
    return std::pair(least, most);
  };
  const ToolPathPlan in_range = plan(std::pair(.3, .5), {});
  ASSERT_TRUE(in_range.feasible()) << in_range.message;
  EXPECT_GE(angles(in_range).first, .3);
  EXPECT_LE(angles(in_range).second, .5);
  const ToolPathPlan preferred = plan({}, -.7);
  ASSERT_TRUE(preferred.feasible()) << preferred.message;
  EXPECT_NEAR(angles(preferred).first, -.7, 1e-2);
  EXPECT_NEAR(angles(preferred).second, -.7, 1e-2);
  EXPECT_THROW(ToolPath("tool").free(2, std::pair(.5, .3)), ValueError);
  EXPECT_THROW(ToolPath("tool").free(2, std::pair(.3, .5), .6), ValueError);
}

TEST(PlanToolPath, PartsOfAPathHaveTheirOwnSpeed) {
  Config C = planarArm();
  const ToolPath path = ToolPath("tool")
                            .start(Vector3d(.6, -.2, 0.))
                            .speed(.05)
                            .line(Vector3d(.6, 0., 0.))
                            .speed(.2)
                            .line(Vector3d(.6, .2, 0.));
  const ToolPathPlan plan = planToolPath(C, {path}, {.acceleration = VectorXd{{6.}}, .jerk = VectorXd{{120.}}});
  ASSERT_TRUE(plan.feasible()) << plan.message;
  EXPECT_NEAR(plan.duration(), 4. + 1. + .1, .1);
  for (int k = 0; k <= 4000; ++k) {
    const double t = plan.duration() * k / 4000., place = plan.way(t).place, speed = plan.speed(t);
    if (place < .2 - 1e-6) EXPECT_LE(speed, .05 * 1.001) << place;
    EXPECT_LE(speed, .2 * 1.001);
    if (place > .01 && place < .19) EXPECT_GT(speed, .04975) << place;
    if (place > .24 && place < .36) EXPECT_GT(speed, .199) << place;
  }
}

TEST(PlanToolPath, ApproachesOnTheSideOfTheArmForBothDirectionsOfTheAxis) {
  for (const bool outwards : {true, false}) {
    Config C;
    C.addText(std::string(R"(
base: {}
x (base): { joint: transX, limits: [-1 1], ctrl_limits: [1 1 1] }
y (x): { joint: transY, limits: [-1 1], ctrl_limits: [1 1 1] }
quill (y): { joint: transZ, limits: [-1 1], ctrl_limits: [1 1 1] }
)") + (outwards ? "tool (quill): { Q: \"t(0 0 -.2) d(180 1 0 0)\" }\n" : "tool (quill): { Q: [0 0 -.2] }\n"));
    const ToolPathPlan plan = planToolPath(C, {ToolPath("tool").line(Vector3d(.2, 0., -.2))}, {.approach = .1});
    ASSERT_TRUE(plan.feasible()) << plan.message;
    C.setJointState(plan.eval(0.).q);
    EXPECT_NEAR(C.getFrame("tool").getPosition()[2], -.1, 1e-4);  // from above, where the quill is
  }
}

/// A clamp that is fixed to the part is no part of the part.
TEST(PlanToolPath, FramesThatMayTouchDoNotIncludeWhatIsFixedToThem) {
  Config C;
  C.addText(R"(
base: {}
x (base): { joint: transX, limits: [-1 1], ctrl_limits: [1 1 1] }
part (base): { shape: box, size: [2 1 .1], Q: [0 0 -.05], contact: 1 }
clamp (part): { shape: box, size: [.1 1 .1], Q: [.4 0 .1], contact: 1 }
tool (x): { shape: sphere, size: [.02], contact: 1 }
)");
  const ToolPath path = ToolPath("tool").line(Vector3d(.8, 0., 0.));
  EXPECT_EQ(planToolPath(C, {path}).status, ToolPathStatus::in_collision);  // the sphere is in the part
  const ToolPathPlan plan = planToolPath(C, {path}, {.touching = {"part"}});
  EXPECT_EQ(plan.status, ToolPathStatus::in_collision);
  EXPECT_NEAR(plan.where.place, .33, 1e-3);
  EXPECT_EQ(plan.frames, (std::vector<std::string>{"clamp", "tool"}));
  EXPECT_TRUE(planToolPath(C, {path}, {.touching = {"part", "clamp"}}).feasible());
}

/// The elbow of planarArm is at acos((d^2 - .5) / .5) for a wrist at a distance d from the base. On the line x = .6
/// with a constant rotation, d^2 = .25 + y^2, and the angle has its extreme in the middle.
TEST(PlanToolPath, JointLimitsHoldBetweenTheKnotsOfTheCurve) {
  const double extreme = std::acos(-.5);
  const ToolPath path =
      ToolPath("tool").start(Pose(Vector3d(.6, -.2, 0.), Quaterniond::Identity())).line(Vector3d(.6, .2, 0.));
  for (const double room : {1e-4, -.01}) {
    Config C = planarArm(cat("Edit j2: { limits: [", -extreme - room, ", ", extreme + room, "] }"));
    const ToolPathPlan plan = planToolPath(C, {path}, {.speed = .1});
    if (room < 0.) {
      EXPECT_EQ(plan.status, ToolPathStatus::out_of_reach);
      EXPECT_NEAR(plan.where.place, .2 - std::sqrt(.25 + .5 * std::cos(extreme + room)), .01);
      continue;
    }
    ASSERT_TRUE(plan.feasible()) << plan.message;
    double largest = 0.;
    for (int k = 0; k <= 20000; ++k)
      largest = std::max(largest, std::abs(plan.eval(plan.duration() * k / 20000.).q[1]));
    EXPECT_LE(largest, extreme + room);
    EXPECT_NEAR(largest, extreme, 1e-4);
  }
}

TEST(PlanToolPath, SaysByHowMuchAPathIsOutOfReach) {
  const auto messageOf = [](const ToolPath& path) { return planToolPath(planarArm(), {path}).message; };
  const auto lineAt = [](double x) { return ToolPath("tool").start(Vector3d(x, 0., 0.)).line(Vector3d(x, .1, 0.)); };
  const auto messageAt = [&](double x) { return messageOf(lineAt(x).free()); };
  EXPECT_NE(messageOf(lineAt(1.6)).find("the nearest misses its position by 0.50"), std::string::npos)
      << messageOf(lineAt(1.6));
  EXPECT_NE(messageAt(1.6).find("no configuration reaches the path; the nearest misses its position by 0.5"),
            std::string::npos)
      << messageAt(1.6);
  EXPECT_NE(messageAt(600.).find("did you mean meters? 600 mm are 0.6 m"), std::string::npos) << messageAt(600.);
  EXPECT_EQ(messageAt(1.6).find("did you mean meters"), std::string::npos);
}

TEST(PlanToolPath, NamesThePlaceBeyondReach) {
  Config C = planarArm();
  const ToolPathPlan plan =
      planToolPath(C, {ToolPath("tool").start(Vector3d(.6, 0., 0.)).line(Vector3d(1.4, 0., 0.)).free()});
  EXPECT_EQ(plan.status, ToolPathStatus::out_of_reach) << plan.message;
  EXPECT_EQ(plan.where.path, 0);
  EXPECT_NEAR(plan.where.place, .5, 5e-3);  // 1.1 m from the base
  EXPECT_GT(plan.reached.rows(), 10);
  EXPECT_THROW(plan.eval(0.), ValueError);
}

TEST(PlanToolPath, NamesThePairInTheWay) {
  Config C = planarArm();
  Frame box = C.addFrame("block");
  box.setShape(ShapeType::box, {.1, .1, .1}).setPosition({.6, .1, 0.});
  box.setContact(1);
  const ToolPathPlan plan =
      planToolPath(C, {ToolPath("tool").start(Vector3d(.6, -.2, 0.)).line(Vector3d(.6, .2, 0.)).free()});
  EXPECT_EQ(plan.status, ToolPathStatus::in_collision) << plan.message;
  EXPECT_NEAR(plan.where.place, .24, 2e-3);  // the sphere of .01 m touches the face at y = .05
  ASSERT_EQ(plan.frames.size(), 2u);
  EXPECT_TRUE((plan.frames[0] == "tool") != (plan.frames[1] == "tool"));
  EXPECT_TRUE((plan.frames[0] == "block") != (plan.frames[1] == "block"));
}

TEST(PlanToolPath, ToolsMayTouchNamedFrames) {
  Config C = planarArm();
  Frame box = C.addFrame("block");
  box.setShape(ShapeType::box, {.02, .6, .1}).setPosition({.625, 0., 0.});  // the sphere is 5 mm inside
  box.setContact(1);
  const ToolPath path = ToolPath("tool").start(Vector3d(.61, -.1, 0.)).line(Vector3d(.61, .1, 0.)).free();
  EXPECT_EQ(planToolPath(C, {path}).status, ToolPathStatus::in_collision);
  EXPECT_TRUE(planToolPath(C, {path}, {.touching = {"block"}}).feasible());
}

TEST(PlanToolPath, SlowsDownWhereAJointAllowsNoMore) {
  Config C = planarArm();
  const ToolPath path = ToolPath("tool").start(Vector3d(.6, -.2, 0.)).line(Vector3d(.6, .2, 0.));
  const ToolPathPlan plan =
      planToolPath(C, {path}, {.speed = .5, .velocity = VectorXd{{.4}}, .acceleration = VectorXd{{8.}}});
  ASSERT_TRUE(plan.feasible()) << plan.message;
  double fastest = 0.;
  for (int k = 0; k <= 2000; ++k)
    fastest = std::max(fastest, plan.eval(plan.duration() * k / 2000.).velocity.cwiseAbs().maxCoeff());
  EXPECT_LE(fastest, .4 * (1. + 1e-9));
  EXPECT_GT(fastest, .399);
  ASSERT_FALSE(plan.slow.empty());
  bool by_velocity = false;
  for (const SlowStretch& slow : plan.slow) by_velocity = by_velocity || slow.cause.find("velocity of '") == 0;
  EXPECT_TRUE(by_velocity);
}

TEST(PlanToolPath, EqualArgumentsGiveEqualBits) {
  Config C = planarArm();
  const ToolPath path = ToolPath("tool").start(Vector3d(.5, -.2, 0.)).line(Vector3d(.7, .2, 0.)).free();
  const ToolPathPlan a = planToolPath(C, {path}), b = planToolPath(C, {path});
  ASSERT_TRUE(a.feasible()) << a.message;
  EXPECT_EQ(a.duration(), b.duration());
  EXPECT_EQ(a.eval(.3).q, b.eval(.3).q);
}

TEST(PlanToolPath, FollowsAPartThatAJointMoves) {
  Config C = planarArm(R"(
turntable (base): { joint: hingeZ, pre: [.7 0 0], limits: [-3 3] }
part (turntable): { Q: [.1 0 0] }
)");
  const ToolPath path = ToolPath("tool", "part").start(Vector3d(0., -.05, 0.)).line(Vector3d(0., .05, 0.)).free();
  const ToolPathPlan plan = planToolPath(C, {path}, {.speed = .05});
  ASSERT_TRUE(plan.feasible()) << plan.message;
  for (int k = 0; k <= 500; ++k) {
    C.setJointState(plan.eval(plan.duration() * k / 500.).q);
    const Pose X = C.getFrame("part").getPose().inverse() * C.getFrame("tool").getPose();
    EXPECT_LE(std::abs(X.p[0]), 2e-5);
    EXPECT_LE(std::abs(X.p[1]), .05 + 2e-5);
  }
}

TEST(PlanToolPath, ApproachesAPartInTheHandFromOutside) {
  Config C = planarArm(R"(
part (j3): { shape: box, size: [.1 .1 .1], Q: [.1 0 0], contact: -1 }
wheel (base): { shape: sphere, size: [.03], Q: [.65 .25 0] }
)");
  for (const double angle : {0., 3.141592653589793}) {  // the axis of the fixed tool leads out of the part, or into it
    const Pose start{Vector3d(.051, -.01, 0.), Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitZ()))};
    const ToolPath path = ToolPath("wheel", "part").start(start).line(Vector3d(.051, .01, 0.)).free(0);
    const ToolPathPlan plan = planToolPath(C, {path}, {.approach = .02});
    ASSERT_TRUE(plan.feasible()) << plan.message;
    C.setJointState(plan.eval(0.).q);
    const Pose X = C.getFrame("part").getPose().inverse() * C.getFrame("wheel").getPose();
    EXPECT_NEAR(X.p[0], .071, 3e-5);
  }
}

TEST(PlanToolPath, RejectsInvalidArguments) {
  Config C = planarArm();
  const ToolPath path = ToolPath("tool").line(Vector3d(.6, 0., 0.));
  EXPECT_THROW(planToolPath(C, {}), ValueError);
  EXPECT_THROW(planToolPath(C, {path}, {.speed = 0.}), ValueError);
  EXPECT_THROW(planToolPath(C, {path}, {.tolerance = 1e-7}), ValueError);
  EXPECT_THROW(planToolPath(C, {path}, {.rotation_tolerance = 1e-6}), ValueError);
  EXPECT_THROW(planToolPath(C, {path}, {.velocity = VectorXd{{1., 1.}}}), ValueError);
  EXPECT_THROW(planToolPath(C, {path}, {.touching = {"nobody"}}), FrameNotFound);
  EXPECT_THROW(planToolPath(C, {ToolPath("too").line(Vector3d(.6, 0., 0.))}), FrameNotFound);
  EXPECT_THROW(planToolPath(C, {ToolPath("base").line(Vector3d(.6, 0., 0.))}), ValueError);
}

}  // namespace
}  // namespace kinegraph
