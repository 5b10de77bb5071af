#include "kinegraph/komo/continuous_collisions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kinegraph/komo/komo.h"
#include "kinegraph/komo/objective_list.h"
#include "kinegraph/solvers/nlp_solver.h"
#include "tests/komo/ball_and_wall.h"
#include "tests/support/coal_distance.h"
#include "tests/support/expect_error.h"
#include "tests/support/near.h"

namespace kinegraph {

namespace {

/// A ball in the plane, and a wall of 3 cm that it can avoid.
Config ballAndWall() {
  return kinegraph::ballAndWall("joint: transXY, size: [.04]", "Q: [.5 -.2 0], size: [.03 .6 1.]");
}

/// From (0, 0) to (1, 0), initialized with a path around the upper end of the wall at y = .1.
Komo aroundWall(int slices) {
  Komo komo(ballAndWall(), 1, slices, 2);
  komo.addControlObjective({}, 2, 1.);
  komo.addObjective({1.}, FeatureSymbol::qItself, {}, ObjectiveType::eq, 10., Eigen::Vector2d(1., 0.));
  MatrixXd path(slices, 2);
  for (int t = 0; t < slices; ++t) {
    const double s = (t + 1.) / slices;
    path.row(t) << s, .25 * std::sin(M_PI * s);
  }
  komo.setPath(path);
  return komo;
}

/// Times of the samples of a motion, in order of addition.
VectorXd sharesOf(const Objective& objective, std::size_t motion) {
  const std::vector<CollisionSample>& samples = objective.samples[motion];
  VectorXd shares(Eigen::Index(samples.size()));
  for (std::size_t i = 0; i < samples.size(); ++i) shares[Eigen::Index(i)] = samples[i].time;
  return shares;
}

/// Smallest distance on the whole motion, by coal, at steps of `step` of the dof that moves most.
double coalDistanceAlong(const Komo& komo, double step) {
  double least = 1.;
  for (const SliceMotion& motion : motionsOf(komo.path())) {
    State state(motion.model, motion.parameters);
    const int count = int((motion.to - motion.from).cwiseAbs().maxCoeff() / step) + 1;
    for (int i = 0; i <= count; ++i) {
      const VectorXd q = motion.from + double(i) / count * (motion.to - motion.from);
      state.setJoints(q.data());
      least = std::min(least, coalDistance(state));
    }
  }
  return least;
}

}  // namespace

TEST(ContinuousCollisions, KeepsTheMarginWherePathsOfFreeSlicesCutCorners) {
  for (const int slices : {6, 10, 16}) {
    Komo in_slices = aroundWall(slices), always = aroundWall(slices);
    in_slices.addObjective({}, FeatureSymbol::accumulatedCollisions, {}, ObjectiveType::eq, 10.);
    const SolverResult cut = in_slices.solve();
    EXPECT_TRUE(cut.feasible) << slices;
    EXPECT_EQ(cut.free(), false) << slices;
    always.addFreeMotion({}, .005);
    const SolverResult result = always.solve();
    EXPECT_TRUE(result.feasible) << slices << ": " << result.summary();
    EXPECT_EQ(result.free(), true) << slices;
    EXPECT_TRUE(always.isFree(.005)) << slices;
    EXPECT_GT(coalDistanceAlong(always, 1e-3), .005 - 1e-6) << slices;
  }
}

TEST(ContinuousCollisions, AddsSamplesAtViolationsOfTheMargin) {
  Komo komo(ballAndWall(), 1, 4, 0);
  komo.addFreeMotion({}, .01);
  MatrixXd path(4, 2);
  path << 0., 0., .3, 0., .7, 0., 1., 0.;
  komo.setPath(path);
  ASSERT_EQ(komo.objectives().size(), 2u);
  Objective between_slices = komo.objectives()[1];
  EXPECT_EQ(between_slices.from, 1) << "no motion leads to slice 0";
  MotionProbe probe(kFreeTolerance);
  LinearSliceMotions lines(komo.path(), probe);
  EXPECT_NEAR(addSamples(between_slices, lines), .065, 1e-4);
  ASSERT_EQ(between_slices.samples.size(), 3u);
  EXPECT_TRUE(near(sharesOf(between_slices, 0), VectorXd::Constant(1, .5), 1e-9))
      << "beside a motion that goes right through";
  EXPECT_TRUE(near(sharesOf(between_slices, 1), Eigen::Vector3d(.5, .25, .75), 1e-9));
  EXPECT_TRUE(near(sharesOf(between_slices, 2), VectorXd::Constant(1, .5), 1e-9));
  const CollisionSample& sample = between_slices.samples[1][0];
  const std::vector<std::string>& names = komo.path().state(0).model().frame_name;
  EXPECT_EQ(names[std::size_t(sample.a)], "ball");
  EXPECT_EQ(names[std::size_t(sample.b)], "wall");
  path.col(0) << 0., .1, .2, .3;
  komo.setPath(path);
  EXPECT_EQ(addSamples(between_slices, lines), 0.) << "free";
  path.col(0) << .7, .6, .58, .3;
  komo.setPath(path);
  EXPECT_GT(measurePath(komo).per_slice(3, 1), 10. * .05) << "reports see it";
}

TEST(ContinuousCollisions, HasTheJacobianOfDifferencesInBothForms) {
  Config scene;
  scene.addText(R"g(
    base: {}
    one (base): { joint: hingeZ }
    upper (one): { Q: [.25, 0, 0], shape: capsule, size: [.3, .03], contact: 1 }
    two (one): { pre: "t(.5 0 0)", joint: hingeZ }
    lower (two): { Q: [.25, 0, 0], shape: capsule, size: [.3, .03], contact: 1 }
    wall (base): { Q: [.5 .4 0], shape: box, size: [.03 .3 1.], contact: 1 }
  )g");
  auto komo = std::make_shared<Komo>(scene, 1, 3, 1);
  komo->addFreeMotion({}, .02);
  MatrixXd path(3, 2);
  path << .2, .1, 1.2, .3, 1.5, .2;
  komo->setPath(path);
  const VectorXd x = komo->path().variables();
  const auto nlp = makeNlp(komo);
  const std::size_t rows = nlp->types().size(), pairs = nlp->separation().problem->types().size();
  VectorXd dual = VectorXd::LinSpaced(Eigen::Index(pairs), 1., double(pairs));
  ASSERT_EQ(nlp->refine(x, dual), Refinement::much);
  EXPECT_EQ(nlp->types().size(), rows) << "sums, one per motion";
  const Separation separation = nlp->separation();
  const std::size_t more = separation.problem->types().size() - pairs;
  EXPECT_GT(more, 0u);
  EXPECT_EQ(dual.size(), Eigen::Index(pairs + more));
  EXPECT_EQ((dual.array() > 0.).count(), Eigen::Index(pairs)) << "multipliers stay";
  EXPECT_LT(checkJacobian(*nlp, x).error, 1e-6);
  EXPECT_LT(checkJacobian(*separation.problem, x).error, 1e-6);
  VectorXd sums((Eigen::Index(rows))), terms((Eigen::Index(pairs + more)));
  nlp->evaluate(x, sums, nullptr);
  separation.problem->evaluate(x, terms, nullptr);
  EXPECT_GT(sums.maxCoeff(), .1);
  for (double& term : terms) term -= 10. * 1e-3;  // additional distance that a solver aims for
  EXPECT_TRUE(near(separation.joined(terms, sums.size()), sums, 1e-9));
}

TEST(ContinuousCollisions, HoldsJointsThatEndWithASwitchWhereTheyAre) {
  Config scene;
  scene.addText(R"g(
    base: {}
    gripper (base): { pre: "t(0 0 .3)", joint: transX, shape: sphere, size: [.02], contact: 1 }
    box (base): { Q: [.2 0 .1], shape: box, size: [.1 .1 .1], contact: 1 }
    wall (base): { Q: [.6 0 .1], shape: box, size: [.01 1 .1], contact: 1 }
  )g");
  auto komo = std::make_shared<Komo>(scene, 2, 2, 1);
  komo->addModeSwitch({1., 2.}, SwitchMode::stable, {"gripper", "box"}, false);
  komo->addModeSwitch({2., -1.}, SwitchMode::stable, {"base", "box"}, false);
  komo->addFreeMotion({}, .01);
  for (int slice = 0; slice < 4; ++slice) {
    VectorXd q = komo->path().state(slice).q();
    q[0] = slice < 2 ? .2 : .9;
    if (slice == 1 || slice == 2) q.tail(7) << 0., .01, -.2, .9, .1, 0., .2;
    if (slice == 3) q.tail(7) << 1.5, 0., .1, 1., 0., 0., 0.;
    komo->path().setSlice(slice, q.data());
  }
  const VectorXd x = komo->path().variables();
  const auto nlp = makeNlp(komo);
  VectorXd dual;
  ASSERT_EQ(nlp->refine(x, dual), Refinement::much) << "the box is carried through the wall";
  // at the deepest point the shortest separations lead to both sides
  const VectorXd beside = x + VectorXd::LinSpaced(x.size(), -3e-3, 3e-3);
  EXPECT_LT(checkJacobian(*nlp, beside).error, 1e-5);
  EXPECT_LT(checkJacobian(*nlp->separation().problem, beside).error, 1e-5);
}

TEST(ContinuousCollisions, CostsNoEvaluationWhereTheMotionIsFree) {
  Komo in_slices(ballAndWall(), 1, 10, 2), always(ballAndWall(), 1, 10, 2);
  for (Komo* komo : {&in_slices, &always}) {
    komo->addControlObjective({}, 2, 1.);
    komo->addObjective({1.}, FeatureSymbol::position, {"ball"}, ObjectiveType::eq, 10., Eigen::Vector3d(.4, .3, 0.));
  }
  in_slices.addObjective({}, FeatureSymbol::accumulatedCollisions, {}, ObjectiveType::ineq, 10.);
  always.addFreeMotion();
  const SolverResult one = in_slices.solve(), other = always.solve();
  EXPECT_TRUE(in_slices.isFree());
  EXPECT_EQ(one.evals, other.evals);
  EXPECT_EQ(one.x, other.x);
}

TEST(ContinuousCollisions, IsNotCalledFeasibleWhereTheStartCollides) {
  Config scene = ballAndWall();
  scene.setJointState(Eigen::Vector2d(.47, 0.));
  Komo komo(scene, 1, 4, 1);
  komo.addControlObjective({}, 1, 1.);
  komo.addFreeMotion({}, .005);
  const SolverResult result = komo.solve();
  EXPECT_FALSE(result.feasible);
  EXPECT_EQ(result.free(), false);
  EXPECT_GT(measurePath(komo).totals.ineq, .1);
}

TEST(ContinuousCollisions, LeavesAStartThatIsNearerThanTheMargin) {
  Config scene = ballAndWall();
  scene.setJointState(Eigen::Vector2d(.442, 0.));  // 3 mm off the wall
  Komo komo(scene, 1, 8, 1);
  komo.addControlObjective({}, 1, 1.);
  komo.addFreeMotion({}, .005);
  const SolverResult result = komo.solve();
  EXPECT_TRUE(result.feasible) << result.message;
  EXPECT_EQ(result.free(), true);
}

TEST(ContinuousCollisions, RefusesWhatMakesNoSense) {
  Komo komo(ballAndWall(), 1, 4, 1);
  expectError<ValueError>([&] { komo.addFreeMotion({}, -1.); }, {"addFreeMotion: margin is -1; expected 0 or more"});
  expectError<ValueError>([&] { komo.addFreeMotion({}, .1, 0.); }, {"addFreeMotion: scale is 0"});
  using F = FeatureSymbol;
  const auto add = [&](F feature, double margin) {
    komo.addObjective({}, feature, {}, ObjectiveType::ineq, {}, {}, -1, margin);
  };
  expectError<ValueError>([&] { add(F::accumulatedCollisions, -.1); }, {"margin is -0.1"});
  expectError<ValueError>([&] { add(F::qItself, .1); }, {"qItself has no margin; accumulatedCollisions"});
  EXPECT_EQ(komo.objectives().size(), 0u);
}

TEST(ContinuousCollisions, HasAMarginInSlicesToo) {
  Komo komo(ballAndWall(), 1, 1, 0);
  MatrixXd q(1, 2);
  q << .43, 0.;  // 15 mm off
  komo.setPath(q);
  using F = FeatureSymbol;
  for (const F feature : {F::accumulatedCollisions, F::pairCollisions})
    komo.addObjective({}, feature, {}, ObjectiveType::ineq, 10., {}, -1, .02);
  komo.addObjective({}, F::distance, {"ball", "wall"}, ObjectiveType::ineq, 10., {}, -1, .02);
  EXPECT_TRUE(near(VectorXd(measurePath(komo).per_slice.row(0)), VectorXd::Constant(3, .05), 1e-9));
}

}  // namespace kinegraph
