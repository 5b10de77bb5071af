#include "kinegraph/komo/path/path_motion.h"

#include <gtest/gtest.h>

#include "kinegraph/komo/komo.h"
#include "kinegraph/solvers/nlp_solver.h"
#include "tests/komo/ball_and_wall.h"
#include "tests/support/expect_error.h"

namespace kinegraph {

namespace {

/// A ball that slides along x towards a wall of 3 cm.
Config slidingBallAndWall() {
  return kinegraph::ballAndWall("joint: transX, size: [.1]", "Q: [.6 0 0], size: [.03 1 1]");
}

MatrixXd column(std::initializer_list<double> numbers) {
  MatrixXd rows(Eigen::Index(numbers.size()), 1);
  std::copy(numbers.begin(), numbers.end(), rows.data());
  return rows;
}

/// A gripper that grasps a box at time 1 and places it at time 2; only the box would hit the wall.
Komo carriedBox() {
  Config scene;
  scene.addText(R"g(
    base: {}
    gripper (base): { pre: "t(0 0 .3)", joint: transX, shape: sphere, size: [.02], contact: 1 }
    box (base): { Q: [.2 0 .1], shape: box, size: [.1 .1 .1], contact: 1 }
    wall (base): { Q: [.6 0 .1], shape: box, size: [.01 1 .1], contact: 1 }
  )g");
  Komo komo(scene, 3, 4, 1);
  komo.addModeSwitch({1., 2.}, SwitchMode::stable, {"gripper", "box"}, false);
  komo.addModeSwitch({2., -1.}, SwitchMode::stable, {"base", "box"}, false);
  return komo;
}

/// Position of the gripper in the twelve slices; the box is .2 m below it, and stays where it was placed.
void move(Komo& komo, const std::vector<double>& positions) {
  const int gripper = komo.configuration(0).getFrame("gripper").id(), box = komo.configuration(0).getFrame("box").id();
  for (int slice = 0; slice < 12; ++slice) {
    VectorXd q = komo.path().state(slice).q();
    q[komo.path().dofsOf({gripper}, slice)[0]] = positions[std::size_t(slice)];
    if (slice >= 3) {
      const int first = komo.path().dofsOf({box}, slice)[0];
      q.segment<7>(first) << (slice < 7 ? 0. : positions[7]), 0., slice < 7 ? -.2 : .1, 1., 0., 0., 0.;
    }
    komo.path().setSlice(slice, q.data());
  }
}

}  // namespace

TEST(PathMotion, FindsAWallThatLiesBetweenSlices) {
  Komo komo(slidingBallAndWall(), 1, 4, 2);
  komo.setPath(column({.25, .45, .95, 1.}));
  EXPECT_TRUE(komo.configuration(1).getCollisions().empty());
  EXPECT_TRUE(komo.configuration(2).getCollisions().empty());
  const std::vector<PathContact> contacts = komo.checkMotion();
  ASSERT_EQ(contacts.size(), 1u);
  const PathContact& contact = contacts[0];
  EXPECT_EQ(contact.slice, 2);
  EXPECT_EQ(contact.a, "ball");
  EXPECT_EQ(contact.b, "wall");
  EXPECT_NEAR(contact.time, .5 + .25 * (.485 - .45) / .5, 1e-4) << "its surface is at the wall's";
  EXPECT_NEAR(contact.deepest, .5 + .25 * (.6 - .45) / .5, 1e-4) << "its center is at the wall's";
  EXPECT_NEAR(contact.distance, -.115, 1e-6);
  EXPECT_EQ(contact.str(), "'ball' and 'wall' overlap by 115 mm at phase time 0.575, between slices 1 and 2");
  EXPECT_FALSE(komo.isFree());
}

TEST(PathMotion, BeginsAtTheSliceBeforeTheStartUnlessThereIsNone) {
  Config scene = slidingBallAndWall();
  scene.setJointState(VectorXd::Constant(1, .9));
  for (const int order : {0, 1}) {
    Komo komo(scene, 1, 2, order);
    komo.setPath(column({.3, .2}));
    EXPECT_EQ(komo.isFree(), order == 0) << "from .9 to .3 goes through the wall";
  }
}

TEST(PathMotion, KeepsTheMarginThatIsAskedFor) {
  Komo komo(slidingBallAndWall(), 1, 2, 1);
  komo.setPath(column({.4, .45}));  // 35 mm from the wall
  EXPECT_TRUE(komo.isFree());
  EXPECT_TRUE(komo.isFree(.034));
  EXPECT_FALSE(komo.isFree(.036));
  EXPECT_NEAR(komo.checkMotion(.036).at(0).distance, .035, 1e-9);
  expectError<ValueError>([&] { komo.checkMotion(std::nan("")); }, {"margin is nan"});
  expectError<ValueError>([&] { komo.checkMotion(0., 0.); }, {"tolerance is 0"});
  expectError([] { Komo().checkMotion(); }, {"checkMotion needs a configuration and a timing"});
}

TEST(PathMotion, CarriesWhatIsAttachedAlong) {
  Komo komo = carriedBox();
  //          reach out ............  carry ................  go away
  move(komo, {.1, .15, .2, .2, .25, .3, .35, .4, .5, .6, .7, .8});
  EXPECT_TRUE(komo.isFree()) << "the box lies at .4, and the gripper passes above the wall";
  move(komo, {.1, .15, .2, .2, .3, .5, .7, .8, .7, .6, .5, .4});
  const std::vector<PathContact> contacts = komo.checkMotion();
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(contacts[0].slice, 6);
  EXPECT_EQ(contacts[0].a, "box");
  EXPECT_EQ(contacts[0].b, "wall");
  EXPECT_NEAR(contacts[0].time, 1.5 + .25 * (.545 - .5) / .2, 1e-4);
}

TEST(PathMotion, SwitchesAsTheSliceIsReached) {
  Komo komo = carriedBox();
  move(komo, {.1, .15, .1, .2, .2, .2, .2, .4, .4, .4, .4, .4});
  const SliceMotion reach = motionInto(komo.path(), 3), lay = motionInto(komo.path(), 7);
  EXPECT_EQ(reach.model, komo.path().state(2).sharedModel()) << "the box lies until the gripper is there";
  EXPECT_EQ(lay.model, komo.path().state(6).sharedModel()) << "the box is carried until it lies";
  EXPECT_EQ(reach.to.size(), 1);
  EXPECT_EQ(reach.to[0], .2);
  EXPECT_EQ(lay.to.size(), 8);
  EXPECT_EQ(lay.to.tail(7), lay.from.tail(7)) << "the joint that ends keeps its values";
  EXPECT_EQ(sameDofs(komo.path(), 7), (std::vector<int>{0, -1, -1, -1, -1, -1, -1, -1}));
}

namespace {

SolverResult solveAcross(Komo& komo, const std::vector<double>& times = {},
                         const std::vector<std::string>& frames = {}) {
  komo.addControlObjective({}, 2, 1.);
  komo.addObjective(times, FeatureSymbol::accumulatedCollisions, frames, ObjectiveType::eq, 10.);
  komo.addObjective({1.}, FeatureSymbol::qItself, {}, ObjectiveType::eq, {}, VectorXd::Constant(1, 1.));
  return komo.solve();
}

}  // namespace

TEST(PathMotion, IsJudgedAfterASolve) {
  Komo komo(slidingBallAndWall(), 1, 4, 2);
  const SolverResult result = solveAcross(komo);
  EXPECT_TRUE(result.feasible) << "no slice is in the wall";
  ASSERT_TRUE(result.free().has_value());
  EXPECT_FALSE(*result.free());
  EXPECT_NE(result.summary().find(
                "the solution is invalid between slices: 'ball' and 'wall' overlap by 115 mm at phase time"),
            std::string::npos)
      << result.summary();
  EXPECT_EQ(result.message.find("free"), std::string::npos);
  EXPECT_FALSE(komo.isFree());
}

TEST(PathMotion, IsJudgedAsItWasWhenItWasSolved) {
  Config scene = slidingBallAndWall();
  Komo komo(scene, 1, 4, 2);
  const SolverResult result = solveAcross(komo);
  scene.getFrame("wall").setPosition({0., 0., 9.});
  komo.updateRootObjects(scene);
  EXPECT_TRUE(komo.isFree());
  EXPECT_FALSE(*result.free());
}

TEST(PathMotion, IsJudgedWhereCollisionsOfAllShapesAreForbidden) {
  Komo late(slidingBallAndWall(), 1, 4, 2);
  EXPECT_TRUE(solveAcross(late, {1.}).free() == std::nullopt) << "in one slice only, no motion";
  Komo waypoints(slidingBallAndWall(), 4, 1, 2);
  EXPECT_TRUE(solveAcross(waypoints).free() == std::nullopt) << "one slice per phase";
  Komo named(slidingBallAndWall(), 1, 4, 2);
  EXPECT_EQ(solveAcross(named, {}, {"ball"}).free(), false) << "shapes of named frames count, too";
  Komo at_start(slidingBallAndWall(), 1, 4, 2);
  const SolverResult begun = solveAcross(at_start, {.25, .5});
  EXPECT_EQ(begun.free(), at_start.checkMotion().at(0).slice > 1) << "only up to phase time .5";
}

}  // namespace kinegraph
