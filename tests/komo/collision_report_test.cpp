#include "kinegraph/komo/collision_report.h"

#include <gtest/gtest.h>

#include "kinegraph/komo/komo.h"
#include "kinegraph/komo/objective_list.h"
#include "kinegraph/solvers/nlp_solver.h"

namespace kinegraph {

namespace {

using F = FeatureSymbol;
using T = ObjectiveType;

/// A ball that jumps over a wall from slice 1 to 2, and over a post from 2 to 3.
Komo jumpingBall() {
  Config scene;
  scene.addText(R"g(
    base: {}
    ball (base): { joint: transX, shape: sphere, size: [.05], contact: 1 }
    wall (base): { Q: [.5 0 0], shape: box, size: [.03 1 1], contact: 1 }
    post (base): { Q: [.8 0 0], shape: box, size: [.03 1 1], contact: 1 }
    ghost (base): { Q: [.1 0 0], shape: box, size: [.03 1 1] }
  )g");
  Komo komo(scene, 1, 4, 0);
  MatrixXd path(4, 1);
  path << .2, .3, .65, 1.;
  komo.setPath(path);
  return komo;
}

std::string validityOf(const Komo& komo) {
  return reportCollisions(constrainedMotions(komo.path(), komo.objectives().all()), {}).message;
}

}  // namespace

TEST(CollisionReport, NamedFramesCountAndOthersDoNot) {
  Komo komo = jumpingBall();
  komo.addObjective({}, F::accumulatedCollisions, {"post"}, T::eq, 10.);
  EXPECT_TRUE(constrainsAnyMotion(komo.path(), komo.objectives().all()));
  const std::vector<SliceMotion> motions = constrainedMotions(komo.path(), komo.objectives().all());
  ASSERT_EQ(motions.size(), 3u);
  EXPECT_FALSE(motions[0].all_pairs);
  ASSERT_EQ(motions[0].pairs.size(), 1u);
  const std::string contact = validityOf(komo);
  EXPECT_NE(contact.find("'ball' and 'post' overlap"), std::string::npos) << contact;
  Komo before = jumpingBall();
  before.addObjective({0., .75}, F::pairCollisions, {"post"}, T::ineq, 10.);
  EXPECT_EQ(validityOf(before), "") << "it jumps over the post later";
}

TEST(CollisionReport, BothTimesMustForbidIt) {
  Komo komo = jumpingBall();
  komo.addObjective({0., .5}, F::accumulatedCollisions, {"wall"}, T::eq, 10.);
  EXPECT_EQ(validityOf(komo), "") << "it is forbidden until slice 1, and the jump leads to slice 2";
  komo.addObjective({.75}, F::accumulatedCollisions, {}, T::eq, 10.);
  const std::string contact = validityOf(komo);
  EXPECT_NE(contact.find("'ball' and 'wall' overlap"), std::string::npos) << contact;
  EXPECT_EQ(contact.find("post"), std::string::npos);
}

TEST(CollisionReport, ConstrainedDistancesCountForShapesThatNeverCollide) {
  Komo komo = jumpingBall();
  MatrixXd path(4, 1);
  path << 0., .3, .31, .32;
  komo.setPath(path);
  komo.addObjective({}, F::accumulatedCollisions, {}, T::eq, 10.);
  EXPECT_EQ(validityOf(komo), "");
  komo.addObjective({}, F::distance, {"ball", "ghost"}, T::ineq, 10.);
  const std::string contact = validityOf(komo);
  EXPECT_NE(contact.find("'ball' and 'ghost' overlap by 65 mm"), std::string::npos) << contact;
  Komo touching = jumpingBall();
  touching.addObjective({}, F::distance, {"ball", "ghost"}, T::eq, 10.);
  EXPECT_FALSE(constrainsAnyMotion(touching.path(), touching.objectives().all())) << "it is to touch";
}

TEST(CollisionReport, ResultsTellIt) {
  Config scene;
  scene.addText(R"g(
    base: {}
    ball (base): { joint: transX, shape: sphere, size: [.1], contact: 1 }
    wall (base): { Q: [.6 0 0], shape: box, size: [.03 1 1], contact: 1 }
  )g");
  for (const double goal : {.4, 1.}) {
    Komo komo(scene, 1, 4, 2);
    komo.addControlObjective({}, 2, 1.);
    komo.addObjective({}, F::distance, {"ball", "wall"}, T::ineq, 10.);
    komo.addObjective({1.}, F::qItself, {}, T::eq, 10., VectorXd::Constant(1, goal));
    const SolverResult result = komo.solve();
    EXPECT_TRUE(result.feasible);
    EXPECT_EQ(result.free(), goal < .5) << goal;
  }
}

}  // namespace kinegraph
