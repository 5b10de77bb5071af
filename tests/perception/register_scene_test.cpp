#include "kinegraph/perception/register_scene.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/perception/visible_shape.h"
#include "kinegraph/rendering/camera_renderer.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {
namespace {

constexpr double kDegree = 3.14159265358979 / 180.;

/// A table with a box, a standing cylinder and a mug of boxes, and a camera that looks down at them.
Config tableScene() {
  Config C;
  C.addText(R"(
    table: { shape: ssBox, size: [1.2, 1.2, .1, .005], pose: [0, 0, .6], contact: 1 }
    box: { shape: ssBox, size: [.06, .1, .08, .002], pose: [.12, .05, .69], contact: 1 }
    can: { shape: cylinder, size: [.12, .03], pose: [-.12, .05, .71], contact: 1 }
    cam: { pose: [0, -.6, 1.2], focalLength: 1.25, width: 640, height: 480 }
  )");
  const Vector3d eye(0., -.6, 1.2), z = (Vector3d(0., .05, .65) - eye).normalized();
  const Vector3d x = z.cross(Vector3d::UnitZ()).normalized();
  Matrix3d R;
  R << x, z.cross(x), z;
  C.getFrame("cam").setPose(Pose(eye, Quaterniond(R)));
  return C;
}

DepthView look(Config& C, const std::string& camera = "cam") {
  CameraRenderer renderer;
  const Camera from = cameraOf(C.getFrame(camera));
  DepthView view;
  view.depth = renderer.render(*C.scene(), from, true).depth;
  view.width = from.width;
  view.height = from.height;
  view.fxycxy = from.fxycxy();
  view.pose = from.pose;
  return view;
}

/// Moves a frame by a step (m) and a rotation about z.
void displace(Config& C, const std::string& name, const Vector3d& step, double degrees) {
  Frame frame = C.getFrame(name);
  const Pose old = frame.getPose();
  const Quaterniond turn(Eigen::AngleAxisd(degrees * kDegree, Vector3d::UnitZ()));
  frame.setPose(Pose(old.p + step, turn * old.q));
}

RegisterOptions onTable() {
  RegisterOptions options;
  options.support = "table";
  return options;
}

TEST(VisibleShape, ABoxWithRoundedEdgesStandsOnItsSixFaces) {
  Config C;
  C.addText("box: { shape: ssBox, size: [.056, .045, .116, .003] }");
  const VisibleShape shape(C.getFrame("box"), {});
  ASSERT_EQ(shape.restingDirections().size(), 6u);
  for (const Vector3d& down : shape.restingDirections()) EXPECT_GT(down.cwiseAbs().maxCoeff(), .9999);
}

TEST(RegisterScene, ADisplacedBoxReturnsToItsPlace) {
  Config C = tableScene();
  const std::vector<DepthView> views{look(C)};
  const Pose truth = C.getFrame("box").getPose();
  displace(C, "box", {.03, -.02, .03}, 25.);
  const SeenScene seen = registerScene(C, views, {"box"}, onTable());
  const Pose found = C.getFrame("box").getPose();
  EXPECT_EQ(seen.frames.at("box").status, SeenStatus::seen) << seen.str();
  EXPECT_LT((found.p - truth.p).norm(), .0005);
  EXPECT_LT(found.q.angularDistance(truth.q), .2 * kDegree);
  EXPECT_TRUE(seen.warnings.empty()) << seen.str();
}

TEST(RegisterScene, ABoxInTheAirIsFoundInSixDirections) {
  Config C = tableScene();
  const Quaterniond tilt(Eigen::AngleAxisd(.5, Vector3d(1., 2., 3.).normalized()));
  C.getFrame("box").setPose(Pose(Vector3d(.1, .05, .8), tilt));
  const std::vector<DepthView> views{look(C)};
  const Quaterniond off(Eigen::AngleAxisd(.2, Vector3d(2., -1., 1.).normalized()));
  C.getFrame("box").setPose(Pose(Vector3d(.11, .03, .81), off * tilt));
  const SeenScene seen = registerScene(C, views, {"box"});
  EXPECT_EQ(seen.frames.at("box").status, SeenStatus::seen) << seen.str();
  EXPECT_LT((C.getFrame("box").getPosition() - Vector3d(.1, .05, .8)).norm(), .0015);
  EXPECT_LT(C.getFrame("box").getQuaternion().angularDistance(tilt), 1. * kDegree);
}

TEST(RegisterScene, TheRotationOfAStandingCylinderIsAFreeDirection) {
  Config C = tableScene();
  const std::vector<DepthView> views{look(C)};
  displace(C, "can", {.02, .02, 0.}, 0.);
  const SeenFrame can = registerScene(C, views, {"can"}, onTable()).frames.at("can");
  EXPECT_LT((can.pose.p - Vector3d(-.12, .05, .71)).norm(), .0005);
  ASSERT_EQ(can.free_directions.rows(), 1);
  EXPECT_NEAR(std::abs(can.free_directions(0, 5)), 1., 1e-3);
  EXPECT_GT(can.covariance(5, 5), 1.);
  EXPECT_LT(can.covariance(0, 0), 1e-4);
}

TEST(RegisterScene, AThingThatWasTakenAwayIsNotThereAndKeepsItsPose) {
  Config C = tableScene(), empty = tableScene();
  empty.delFrame("box");
  const std::vector<DepthView> views{look(empty)};
  const Pose before = C.getFrame("box").getPose();
  const SeenScene seen = registerScene(C, views, {"box", "can"}, onTable());
  EXPECT_EQ(seen.frames.at("box").status, SeenStatus::not_there) << seen.str();
  EXPECT_EQ(seen.frames.at("can").status, SeenStatus::seen) << seen.str();
  EXPECT_EQ(C.getFrame("box").getPose().numbers(), before.numbers());
}

TEST(RegisterScene, AHiddenThingIsOccludedByTheFrameBeforeIt) {
  Config C = tableScene();
  C.addFrame("wall").setShape(ShapeType::box, {.3, .02, .3}).setPosition({.12, -.1, .8});
  const std::vector<DepthView> views{look(C)};
  const SeenScene seen = registerScene(C, views, {"box"}, onTable());
  EXPECT_EQ(seen.frames.at("box").status, SeenStatus::occluded) << seen.str();
  EXPECT_EQ(seen.frames.at("box").by, "wall");
}

TEST(RegisterScene, AThingBesideTheImageIsNotInView) {
  Config C = tableScene();
  const std::vector<DepthView> views{look(C)};
  C.getFrame("box").setPosition({2., 2., .69});
  EXPECT_EQ(registerScene(C, views, {"box"}, onTable()).frames.at("box").status, SeenStatus::not_in_view);
}

TEST(RegisterScene, ADrawerMovesAlongItsJointOnly) {
  Config C = tableScene();
  C.addText(R"(
    cabinet: { pose: [0, .3, .75] }
    drawer (cabinet): { joint: transY, limits: [-.2, .2], q: -.05, shape: ssBox, size: [.2, .15, .08, .002] }
  )");
  const std::vector<DepthView> views{look(C)};
  C.getFrame("drawer").setJointState(VectorXd::Constant(1, -.01));
  const SeenScene seen = registerScene(C, views, {"drawer"}, onTable());
  EXPECT_EQ(seen.frames.at("drawer").status, SeenStatus::seen) << seen.str();
  EXPECT_NEAR(C.getFrame("drawer").getJointState()[0], -.05, .0005);
}

TEST(RegisterScene, TwoEqualBoxesSideBySideAreNotConfused) {
  Config C = tableScene();
  C.addFrame("box2").setShape(ShapeType::ssBox, {.06, .1, .08, .002}).setPosition({.19, .05, .69});
  const std::vector<DepthView> views{look(C)};
  displace(C, "box", {.02, .01, 0.}, 8.);
  displace(C, "box2", {.02, -.01, 0.}, -8.);
  const SeenScene seen = registerScene(C, views, {"box", "box2"}, onTable());
  EXPECT_LT((seen.frames.at("box").pose.p - Vector3d(.12, .05, .69)).norm(), .001) << seen.str();
  EXPECT_LT((seen.frames.at("box2").pose.p - Vector3d(.19, .05, .69)).norm(), .001) << seen.str();
}

TEST(RegisterScene, AThingOnAnotherOneIsFoundInTheSameCall) {
  Config C = tableScene();
  C.addText("top: { shape: box, size: [.04, .05, .05], contact: 1 }");
  const Pose below = C.getFrame("box").getPose();
  const Vector3d on_top = below.p + Vector3d(.005, 0., .5 * .08 + .025);
  C.getFrame("top").setPosition(on_top);
  const std::vector<DepthView> views{look(C)};
  displace(C, "top", {.01, -.01, 0.}, 0.);
  displace(C, "box", {.01, -.01, 0.}, 0.);
  const SeenScene seen = registerScene(C, views, {"box", "top"}, onTable());
  EXPECT_LT((C.getFrame("box").getPosition() - below.p).norm(), .001) << seen.str();
  EXPECT_LT((C.getFrame("top").getPosition() - on_top).norm(), .001) << seen.str();
}

TEST(RegisterScene, TheFarSideOfAThinWallDoesNotHoldThePose) {
  Config C = tableScene();
  C.addFrame("plate").setShape(ShapeType::ssBox, {.16, .004, .12, .0005}).setPosition({0., .2, .71});
  const std::vector<DepthView> views{look(C)};
  displace(C, "plate", {.004, .012, 0.}, 3.);
  const SeenScene seen = registerScene(C, views, {"plate"}, onTable());
  EXPECT_NEAR(seen.frames.at("plate").pose.p.y(), .2, .0005) << seen.str();
}

TEST(RegisterScene, EmptyAndFlippedViewsGiveWarnings) {
  Config C = tableScene();
  DepthView view = look(C);
  const Pose before = C.getFrame("box").getPose();
  DepthView flipped = view;
  flipped.pose.q = flipped.pose.q * Quaterniond(Eigen::AngleAxisd(2.5, Vector3d::UnitX()));
  const SeenScene turned = registerScene(C, std::vector{flipped}, {"box"}, onTable());
  ASSERT_EQ(turned.warnings.size(), 1u);
  EXPECT_NE(turned.warnings[0].find("Check the camera's pose"), std::string::npos) << turned.warnings[0];
  std::fill(view.depth.begin(), view.depth.end(), std::nanf(""));
  const SeenScene blind = registerScene(C, std::vector{view}, {"box"}, onTable());
  ASSERT_EQ(blind.warnings.size(), 1u);
  EXPECT_NE(blind.warnings[0].find("has no depth"), std::string::npos);
  EXPECT_EQ(blind.frames.at("box").status, SeenStatus::not_in_view);
  EXPECT_EQ(C.getFrame("box").getPose().numbers(), before.numbers());
}

TEST(RegisterScene, InvalidViewsAreErrorsThatNameTheCause) {
  Config C = tableScene();
  const DepthView view = look(C);
  const auto messageOf = [&](const DepthView& bad) -> std::string {
    try {
      registerScene(C, std::vector{bad}, {"box"});
    } catch (const ValueError& error) {
      return error.what();
    }
    return "";
  };
  DepthView bad = view;
  for (float& d : bad.depth) d *= 1000.f;
  EXPECT_NE(messageOf(bad).find("millimeters"), std::string::npos);
  bad = view;
  bad.fxycxy *= 2.;
  EXPECT_NE(messageOf(bad).find("does not fit an image of 640 x 480"), std::string::npos);
  bad = view;
  bad.depth.pop_back();
  EXPECT_NE(messageOf(bad).find("height x width"), std::string::npos);
  EXPECT_THROW(registerScene(C, std::vector{view}, {"cam"}), ValueError);
  EXPECT_THROW(registerScene(C, std::vector{view}, {"bax"}), FrameNotFound);
  EXPECT_THROW(registerScene(C, std::vector{view}, {"box", "box"}), ValueError);
}

/// A box on the table, of the size of "box" unless another one is given.
void addBox(Config& C, const std::string& name, double x, double y, std::vector<double> size = {.06, .1, .08, .002}) {
  const double height = .65 + .5 * size[2];
  C.addFrame(name).setShape(ShapeType::ssBox, std::move(size)).setPosition({x, y, height});
}

RegisterOptions within(double radius) {
  RegisterOptions options = onTable();
  options.search_radius = radius;
  return options;
}

TEST(RegisterScene, EqualThingsThatMayBeExchangedAreNamed) {
  Config C = tableScene();
  for (const char* name : {"box", "can"}) C.delFrame(name);
  addBox(C, "a", 0., .05);
  addBox(C, "b", .12, .05);
  const std::vector<DepthView> views{look(C)};
  displace(C, "a", {.05, -.05, 0.}, 0.);
  displace(C, "b", {-.05, .05, 0.}, 0.);
  const SeenScene seen = registerScene(C, views, {"a", "b"}, within(.1));
  EXPECT_NEAR(seen.frames.at("a").pose.p.x(), 0., .001) << seen.str();
  EXPECT_NEAR(seen.frames.at("b").pose.p.x(), .12, .001) << seen.str();
  EXPECT_EQ(seen.frames.at("a").may_be, std::vector<std::string>{"b"});
  EXPECT_EQ(seen.frames.at("b").may_be, std::vector<std::string>{"a"});
  ASSERT_EQ(seen.warnings.size(), 1u) << seen.str();
  EXPECT_NE(seen.warnings[0].find("look alike and may be exchanged"), std::string::npos) << seen.warnings[0];
}

TEST(RegisterScene, EqualThingsGetThePlacesThatDemandTheLeastMovements) {
  Config C = tableScene();
  for (const char* name : {"box", "can"}) C.delFrame(name);
  addBox(C, "a", 0., .05);
  addBox(C, "b", .12, .05, {.1, .06, .08, .002});  // the same box with other axes
  displace(C, "b", {0., 0., 0.}, 90.);
  const std::vector<DepthView> views{look(C)};
  displace(C, "a", {.07, 0., 0.}, 0.);  // now closer to the place of b than to its own
  displace(C, "b", {.07, 0., 0.}, 0.);
  const SeenScene seen = registerScene(C, views, {"a", "b"}, within(.1));
  EXPECT_NEAR(seen.frames.at("a").pose.p.x(), 0., .001) << seen.str();
  EXPECT_NEAR(seen.frames.at("b").pose.p.x(), .12, .001) << seen.str();
  EXPECT_TRUE(seen.frames.at("a").may_be.empty()) << "b would have moved 19 cm";
}

TEST(RegisterScene, OneOfTwoEqualThingsThatIsSeenMayBeTheOther) {
  Config C = tableScene();
  for (const char* name : {"box", "can"}) C.delFrame(name);
  addBox(C, "a", .05, .05);
  const std::vector<DepthView> views{look(C)};
  C.getFrame("a").setPosition({0., .05, .69});
  addBox(C, "b", .12, .05);
  const SeenScene seen = registerScene(C, views, {"b", "a"}, within(.1));
  EXPECT_EQ(seen.frames.at("a").status, SeenStatus::seen) << seen.str();
  EXPECT_NE(seen.frames.at("b").status, SeenStatus::seen) << seen.str();
  EXPECT_EQ(seen.frames.at("a").may_be, std::vector<std::string>{"b"});
  EXPECT_EQ(seen.frames.at("b").may_be, std::vector<std::string>{"a"});
  EXPECT_EQ(seen.warnings.size(), 1u) << seen.str();
}

TEST(RegisterScene, AThingThatMovedMuchFartherThanTheSearchRadiusIsNotTakenForAnother) {
  Config C = tableScene();
  const Pose away = C.getFrame("box").getPose();
  C.getFrame("box").setPosition({.12, .05, -5.});
  const std::vector<DepthView> views{look(C)};
  C.getFrame("box").setPose(away);
  displace(C, "can", {.005, 0., 0.}, 0.);
  const SeenScene seen = registerScene(C, views, {"box", "can"}, within(1e-9));
  EXPECT_EQ(seen.frames.at("can").status, SeenStatus::seen) << seen.str();
  EXPECT_NE(seen.frames.at("box").status, SeenStatus::seen) << seen.str();
}

TEST(RegisterScene, AShapeWithoutASurfaceIsRefused) {
  Config C = tableScene();
  const std::vector<DepthView> views{look(C)};
  C.addFrame("dust").setShape(ShapeType::box, {1e-8, 1e-8, 1e-8}).setPosition({.1, 0., .66});
  try {
    registerScene(C, views, {"dust"}, onTable());
    FAIL() << "there is nothing to see";
  } catch (const ValueError& error) {
    EXPECT_NE(std::string(error.what()).find("'dust' has no surface"), std::string::npos) << error.what();
  }
}

TEST(RegisterScene, ThingsOfOtherSizesAndFarOnesAreNotExchanged) {
  Config C = tableScene();
  addBox(C, "far", -.3, .05);
  addBox(C, "tall", .02, .05, {.06, .1, .095, .002});
  const std::vector<DepthView> views{look(C)};
  const SeenScene seen = registerScene(C, views, {"box", "far", "tall", "can"}, within(.1));
  for (const auto& [name, frame] : seen.frames) EXPECT_TRUE(frame.may_be.empty()) << seen.str();
  EXPECT_TRUE(seen.warnings.empty()) << seen.str();
}

TEST(RegisterScene, ANearlySquareBoxIsNotTurnedByARightAngleSilently) {
  Config C = tableScene();
  addBox(C, "square", .0, .2, {.06, .0618, .09, .002});
  const std::vector<DepthView> views{look(C)};
  displace(C, "square", {.02, .01, 0.}, 25.);
  const SeenFrame near = registerScene(C, views, {"square"}, onTable()).frames.at("square");
  EXPECT_LT(near.pose.q.angularDistance(Quaterniond::Identity()), 1. * kDegree) << near.str();
  C.getFrame("square").setPosition({3., 3., 3.});
  RegisterOptions options = onTable();
  options.prior = Prior::anywhere;
  const SeenFrame found = registerScene(C, views, {"square"}, options).frames.at("square");
  ASSERT_EQ(found.status, SeenStatus::seen) << found.str();
  ASSERT_FALSE(found.alternatives.empty()) << found.str();
  const bool is_turned = std::any_of(found.alternatives.begin(), found.alternatives.end(), [&](const Pose& other) {
    return std::abs(other.q.angularDistance(found.pose.q) - 90. * kDegree) < 2. * kDegree;
  });
  EXPECT_TRUE(is_turned) << found.str();
}

TEST(RegisterScene, WithoutAPriorThingsAreFoundWhereverTheyRest) {
  Config C = tableScene();
  const Quaterniond fallen(Eigen::AngleAxisd(90. * kDegree, Vector3d::UnitX()));
  C.getFrame("box").setPose(Pose(Vector3d(.2, -.1, .7), fallen));
  C.getFrame("can").setPose(Pose(Vector3d(-.25, .15, .68), fallen));
  addBox(C, "flat", 0., .2, {.12, .08, .03, .002});
  const std::vector<std::string> names{"box", "can", "flat", "ball"};
  const std::vector<DepthView> views{look(C)};
  std::map<std::string, Pose> truth;
  for (const char* name : {"box", "can", "flat"}) {
    truth[name] = C.getFrame(name).getPose();
    C.getFrame(name).setPose(Pose(Vector3d(3., 3., 3.), Quaterniond::Identity()));
  }
  C.addFrame("ball").setShape(ShapeType::sphere, {.04}).setPosition({3., 4., 3.});  // is not on the table
  RegisterOptions options = onTable();
  options.prior = Prior::anywhere;
  const SeenScene seen = registerScene(C, views, names, options);
  for (const auto& [name, pose] : truth) {
    EXPECT_EQ(seen.frames.at(name).status, SeenStatus::seen) << seen.str();
    EXPECT_LT((seen.frames.at(name).pose.p - pose.p).norm(), .001) << seen.str();
  }
  EXPECT_EQ(seen.frames.at("ball").status, SeenStatus::not_found) << seen.str();
  EXPECT_EQ(C.getFrame("ball").getPosition(), Vector3d(3., 4., 3.));
  options.support = "";
  EXPECT_THROW(registerScene(C, views, names, options), ValueError);
  EXPECT_THROW(priorFromName("nowhere"), ValueError);
}

TEST(RegisterScene, ACameraUpsideDownLooksThroughTheSupport) {
  Config C = tableScene();
  DepthView view = look(C);
  view.pose.q = view.pose.q * Quaterniond(Eigen::AngleAxisd(180. * kDegree, Vector3d::UnitZ()));
  const SeenScene seen = registerScene(C, std::vector{view}, {"box"}, onTable());
  ASSERT_EQ(seen.warnings.size(), 1u) << seen.str();
  EXPECT_NE(seen.warnings[0].find("of the surface of 'table'"), std::string::npos) << seen.warnings[0];
  EXPECT_THROW(registerScene(C, std::vector{view}, {"table"}, onTable()), ValueError);
  for (float& d : view.depth) d *= .001f;
  EXPECT_THROW(registerScene(C, std::vector{view}, {"box"}, onTable()), ValueError);
}

TEST(RegisterScene, AShapeWithoutASurfaceIsNotVisible) {
  Config C = tableScene();
  C.addFrame("field").setShape(ShapeType::tensor, {.1, .1, .1});
  EXPECT_THROW(registerScene(C, std::vector{look(C)}, {"field"}, onTable()), ValueError);
}

TEST(RegisterScene, AnImageOfTwiceTheSizeOfItsIntrinsicsIsAnError) {
  Config C = tableScene();
  DepthView view = look(C);
  view.fxycxy *= .5;
  EXPECT_THROW(registerScene(C, std::vector{view}, {"box"}, onTable()), ValueError);
  view.fxycxy *= 4.;
  EXPECT_THROW(registerScene(C, std::vector{view}, {"box"}, onTable()), ValueError);
}

}  // namespace
}  // namespace kinegraph
