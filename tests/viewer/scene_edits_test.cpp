#include "kinegraph/viewer/scene_edits.h"

#include <gtest/gtest.h>

#include "kinegraph/common/random.h"
#include "kinegraph/kinematics/kinematic_model.h"
#include "kinegraph/scene/tree/scene_tree.h"
#include "kinegraph/viewer/scene_items.h"

using namespace kinegraph;

namespace {

constexpr double kExact = 1e-12;

/// A box on the floor, and an arm of two joints with limits that carries a camera.
Config scene() {
  Config config;
  config.addText(R"(
box: { pose: [1 0 0], shape: box, size: [.1 .1 .1] }
base: { pose: [0 0 .5] }
one (base): { joint: hingeZ, limits: [-1 2] }
reach (one): { pose: [1 0 0] }
two (reach): { joint: transX, limits: [0 .5], q: .25 }
camera (two): { pose: [0 0 .1] }
)");
  return config;
}

struct SceneEditsTest : ::testing::Test {
  Config config = scene();
  SceneEdits edits;

  void show(int structure = 1) { edits.setScene(config.scene()->snapshot(), structure); }
  std::vector<double> numbers(const Vector3d& p) const { return {p.x(), p.y(), p.z(), 1., 0., 0., 0.}; }
  int id(const char* name) const { return config.getFrame(name).id(); }
};

/// Compares a new reader with one that has read the scene before every edit.
void expectSameAsAnew(const Config& config, SceneItems& known) {
  SceneItems anew;
  anew.read(config);
  known.read(config);
  ASSERT_EQ(known.items().size(), anew.items().size());
  for (std::size_t i = 0; i < anew.items().size(); ++i) {
    const ViewItem &a = known.items()[i], &b = anew.items()[i];
    EXPECT_EQ(std::tie(a.name, a.parent, a.details, a.geometry, a.collides, a.color),
              std::tie(b.name, b.parent, b.details, b.geometry, b.collides, b.color))
        << "frame " << i;
  }
}

}  // namespace

TEST_F(SceneEditsTest, AJointIsShownAtOnceAndAppliedOnRequest) {
  show();
  const auto edited = edits.apply(SetJointCommand{1, 0, .5});
  ASSERT_TRUE(edited);
  EXPECT_EQ(edited->q, Eigen::Vector2d(.5, .25));
  EXPECT_NEAR(edited->poses[std::size_t(id("one"))].q.z(), std::sin(.25), kExact);
  EXPECT_EQ(config.getJointState()[0], 0.);
  EXPECT_TRUE(edits.hasAny());
  EXPECT_TRUE(edits.takeInto(config));
  EXPECT_EQ(config.getJointState(), Eigen::Vector2d(.5, .25));
  EXPECT_FALSE(edits.takeInto(config));
}

TEST_F(SceneEditsTest, JointsStayWithinTheirLimits) {
  show();
  EXPECT_EQ(edits.apply(SetJointCommand{1, 0, 100.})->q[0], 2.);
  EXPECT_EQ(edits.apply(SetJointCommand{1, 1, -100.})->q[1], 0.);
  for (int i = 0; i < 50; ++i) {
    const VectorXd q = edits.apply(RandomJointsCommand{1})->q;
    EXPECT_TRUE(-1. <= q[0] && q[0] <= 2. && 0. <= q[1] && q[1] <= .5) << q.transpose();
  }
}

TEST_F(SceneEditsTest, ResetIsHome) {
  const VectorXd home = config.model()->home;
  config.setJointState(Eigen::Vector2d(1.5, .1));
  show();
  EXPECT_EQ(edits.apply(ResetJointsCommand{1})->q, home);
}

TEST_F(SceneEditsTest, OnlyChangesOfUsersAreApplied) {
  show();
  edits.apply(SetJointCommand{1, 0, .5});
  config.setJointState(Eigen::Vector2d(-.5, .4));
  edits.takeInto(config);
  EXPECT_EQ(config.getJointState(), Eigen::Vector2d(.5, .4));
}

TEST_F(SceneEditsTest, AMovedFrameTakesThoseBelowItAlong) {
  show();
  const auto edited = edits.apply(MoveFrameCommand{1, id("base"), numbers({2, 3, 4})});
  ASSERT_TRUE(edited);
  EXPECT_NEAR((edited->poses[std::size_t(id("camera"))].p - Vector3d(3.25, 3, 4.1)).norm(), 0., kExact);
  edits.takeInto(config);
  EXPECT_NEAR((config.getFrame("camera").getPose().p - Vector3d(3.25, 3, 4.1)).norm(), 0., kExact);
}

TEST_F(SceneEditsTest, AFrameOnAJointTakesTheNearestPoseWithinItsLimits) {
  show();
  EXPECT_NEAR(edits.apply(MoveFrameCommand{1, id("two"), numbers({1.375, 9, .5})})->q[1], .375, kExact);
  EXPECT_NEAR(edits.apply(MoveFrameCommand{1, id("two"), numbers({7, 0, .5})})->q[1], .5, kExact);
  edits.takeInto(config);
  EXPECT_EQ(config.getJointState()[1], .5);
}

TEST_F(SceneEditsTest, InvalidCommandsChangeNothing) {
  EXPECT_FALSE(edits.apply(SetJointCommand{0, 0, .5}));  // nothing is shown yet
  show();
  EXPECT_FALSE(edits.apply(SetJointCommand{2, 0, .5}));  // of another structure
  for (const int joint : {-1, 2, 1 << 30}) EXPECT_FALSE(edits.apply(SetJointCommand{1, joint, .5}));
  for (const int frame : {-1, 6, 1 << 30}) EXPECT_FALSE(edits.apply(MoveFrameCommand{1, frame, numbers({1, 2, 3})}));
  EXPECT_FALSE(edits.apply(MoveFrameCommand{1, 0, {1, 2, 3}}));
  EXPECT_FALSE(edits.apply(MoveFrameCommand{1, 0, {1, 2, 3, 0, 0, 0, 0}}));
  EXPECT_FALSE(edits.apply(MoveFrameCommand{1, 0, {1e300, 2, 3, 1, 0, 0, 0}}));
  EXPECT_FALSE(edits.apply(KeyCommand{'a'}));
  EXPECT_FALSE(edits.hasAny());
}

TEST_F(SceneEditsTest, ChangesOfAnotherStructureAreDropped) {
  show();
  edits.apply(SetJointCommand{1, 0, .5});
  show(1);
  EXPECT_TRUE(edits.hasAny());
  show(2);
  EXPECT_FALSE(edits.takeInto(config));
}

TEST_F(SceneEditsTest, RandomCommandsKeepTheSceneWithinItsLimits) {
  show();
  Rng rng(0);
  for (int i = 0; i < 500; ++i) {
    const int which = int(rng.uniform(-2., 7.));
    edits.apply(SetJointCommand{1, which, rng.uniform(-5., 5.)});
    const auto edited = edits.apply(MoveFrameCommand{
        1, which, {rng.normal(), rng.normal(), rng.normal(), rng.normal(), rng.normal(), rng.normal(), rng.normal()}});
    if (edited) EXPECT_TRUE(-1. <= edited->q[0] && edited->q[0] <= 2. && 0. <= edited->q[1] && edited->q[1] <= .5);
  }
}

TEST(SceneItems, CountAStructureForEveryChangeOfFramesAndNoneForPoses) {
  Config config = scene();
  SceneItems items;
  items.read(config);
  const int first = items.structure();
  config.setJointState(Eigen::Vector2d(.1, .2));
  items.read(config);
  EXPECT_EQ(items.structure(), first);
  EXPECT_TRUE(items.isOf(config));
  config.addFrame("new");
  EXPECT_FALSE(items.isOf(config));
  items.read(config);
  EXPECT_EQ(items.structure(), first + 1);
  Config other(config);
  EXPECT_FALSE(items.isOf(other));
}

TEST(SceneItems, DescribeJointsAndOtherAttributes) {
  Config config = scene();
  SceneItems items;
  items.read(config);
  ASSERT_EQ(items.joints().dofs.size(), 2u);
  EXPECT_EQ(items.joints().dofs[0], (ShownJoint{"one", config.getFrame("one").id(), "rad", -1., 2.}));
  EXPECT_EQ(items.joints().dofs[1].unit, "m");
  EXPECT_EQ(items.items()[0].details, "shape: box, size: [0.1 0.1 0.1]");
  config.getFrame("box").setColor({1., 0., 0.});
  items.read(config);
  EXPECT_EQ(items.items()[0].details, "shape: box, size: [0.1 0.1 0.1], color: [1 0 0]");
}

TEST(SceneItems, DescribeAnEditAndItsConsequences) {
  Config config = scene();
  SceneItems known;
  const auto look = [&] { expectSameAsAnew(config, known); };
  look();
  config.addFrame("a", "box").setShape(ShapeType::sphere, {.1});
  look();
  config.addFrame("b", "a");
  look();
  config.getFrame("a").setContact(1);
  look();
  config.getFrame("a").setMass(2.);
  look();
  config.getFrame("a").setMass(3.);
  look();
  config.getFrame("b").setJoint(JointType::hingeX);
  look();
  config.getFrame("b").setJoint(JointType::none);
  look();
  config.getFrame("b").setShape(ShapeType::box, {.1, .2, .3});
  config.getFrame("b").setColor({1., 0., 0.});
  look();
  config.getFrame("a").setName("c");
  look();
  config.getFrame("b").setParent(config.getFrame("box"));
  look();
  config.delFrame("c");
  look();
  config.addFrame("c");
  look();
}

TEST_F(SceneEditsTest, EditsAreUndoneAndDoneAgainInTurn) {
  show();
  const auto q = [&] { return edits.apply(WarningsCommand{1})->q; };
  edits.apply(SetJointCommand{1, 0, .5});
  edits.apply(SetJointCommand{1, 0, .75});  // the same drag
  edits.apply(SetJointCommand{1, 1, .125});
  EXPECT_TRUE(q().isApprox(Eigen::Vector2d(.75, .125)));
  EXPECT_TRUE(edits.apply(UndoCommand{1})->q.isApprox(Eigen::Vector2d(.75, .25)));
  EXPECT_TRUE(edits.apply(UndoCommand{1})->q.isApprox(Eigen::Vector2d(0., .25)));
  EXPECT_FALSE(edits.apply(UndoCommand{1}));
  EXPECT_TRUE(edits.apply(RedoCommand{1})->q.isApprox(Eigen::Vector2d(.75, .25)));
  edits.apply(ResetJointsCommand{1});
  EXPECT_FALSE(edits.apply(RedoCommand{1}));  // a new edit ends the old future
  EXPECT_TRUE(edits.apply(UndoCommand{1})->q.isApprox(Eigen::Vector2d(.75, .25)));
}

TEST_F(SceneEditsTest, AnUndoneMoveOfAFrameReachesTheProgramThatHadTakenTheMove) {
  show();
  edits.apply(MoveFrameCommand{1, id("box"), numbers({2., 3., 0.})});
  ASSERT_TRUE(edits.takeInto(config));
  EXPECT_NEAR(config.getFrame("box").getPosition()[1], 3., kExact);
  show();
  ASSERT_TRUE(edits.apply(UndoCommand{1}));
  ASSERT_TRUE(edits.takeInto(config));
  EXPECT_TRUE(config.getFrame("box").getPosition().isApprox(Vector3d(1., 0., 0.)));
  show(2);  // another structure
  EXPECT_FALSE(edits.apply(RedoCommand{2}));
}
