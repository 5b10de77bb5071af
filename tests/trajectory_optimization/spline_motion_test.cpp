#include "kinegraph/trajectory_optimization/motion_problems.h"

#include <gtest/gtest.h>

#include "kinegraph/komo/mode_switches.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/solvers/nlp_solver.h"
#include "tests/support/expect_error.h"
#include "tests/support/planar_arm.h"

namespace kinegraph {
namespace {

/// A planar arm of three joints, and a ball as obstacle.
Config arm() {
  Config C;
  C.addText(planarArm() + R"(target: { X: [.3 .9 0] }
ball: { shape: sphere, size: [.15], X: [1.1 .35 0], contact: 1 }
)");
  return C;
}

std::shared_ptr<Komo> reach(const Config& C, int slices) {
  auto komo = std::make_shared<Komo>(C, 1., slices, 2);
  komo->addControlObjective({}, 2, .1);
  komo->addObjective({}, FeatureSymbol::accumulatedCollisions, {}, ObjectiveType::eq, Scale(10.));
  komo->addObjective({1.}, FeatureSymbol::positionDiff, {"tip", "target"}, ObjectiveType::eq, Scale(10.));
  return komo;
}

SolverResult solved(const std::shared_ptr<Nlp>& nlp) {
  NlpSolver solver(nlp, 0);
  solver.options.verbose = 0;
  return solver.solve();
}

VectorXd somewhere(Nlp& nlp) {
  Rng rng(3);
  VectorXd c = nlp.initialPoint(rng);
  for (double& value : c) value += .2 * rng.normal();
  return c;
}

TEST(SplineMotion, JacobianEqualsCentralDifferences) {
  const Config C = arm();
  for (const bool rests : {true, false}) {
    const SplineMotion motion(reach(C, 20), {.points = 6, .degree = 3, .ends_at_rest = rests});
    const auto nlp = motion.nlp();
    EXPECT_EQ(nlp->dimension(), 3 * (rests ? 6 : 7));
    EXPECT_LT(checkJacobian(*nlp, somewhere(*nlp)).error, 1e-5);
    const Separation separation = nlp->separation();
    ASSERT_TRUE(separation.problem);
    EXPECT_LT(checkJacobian(*separation.problem, somewhere(*nlp)).error, 1e-5);
  }
}

TEST(SplineMotion, SlicesLieOnItsSplineWhichStartsAtRestInTheInitialConfiguration) {
  Config C = arm();
  C.setJointState((VectorXd(3) << -.4, .3, .2).finished());
  for (const int degree : {2, 3, 5}) {
    const auto komo = reach(C, 24);
    const SplineMotion motion(komo, {.points = 7, .degree = degree});
    const auto nlp = motion.nlp();
    ASSERT_TRUE(solved(nlp).feasible) << degree;
    const BSpline spline = motion.spline();
    const MatrixXd path = komo->getPath();
    for (int slice = 0; slice < 24; ++slice)
      EXPECT_LT((spline.eval((slice + 1) * komo->tau()) - path.row(slice).transpose()).norm(), 1e-9) << degree;
    EXPECT_LT((spline.eval(0.) - C.getJointState()).norm(), 1e-12);
    EXPECT_LT(spline.eval(1e-9, 1).norm(), 1e-6);
    EXPECT_LT(spline.eval(spline.end() - 1e-9, 1).norm(), 1e-6);
  }
}

TEST(SplineMotion, WithAsManyPointsAsSlicesItIsAsGoodAsAFreePathAndWithFewNearlySo) {
  const Config C = arm();
  const auto costOf = [](const SolverResult& result) { return result.sos + result.f; };
  const auto free = reach(C, 20);
  const SolverResult best = solved(makeNlp(free));
  const SplineMotion all(reach(C, 20), {.points = 20, .degree = 1, .ends_at_rest = false});
  const SolverResult same = solved(all.nlp());
  const SplineMotion few(reach(C, 20), {.points = 5, .degree = 3, .ends_at_rest = false});
  const SolverResult smooth = solved(few.nlp());
  ASSERT_TRUE(best.feasible && same.feasible && smooth.feasible);
  EXPECT_NEAR(costOf(same), costOf(best), 1e-3 * costOf(best));  // linear motion between slices
  EXPECT_GT(costOf(smooth), (1. - 1e-3) * costOf(best));
  EXPECT_LT(costOf(smooth), 1.5 * costOf(best));  // five points instead of twenty slices
}

TEST(SplineMotion, KeepsLimitsBetweenSlicesAsItsControlPointsDo) {
  Config C = arm();
  const auto komo = std::make_shared<Komo>(C, 1., 12, 2);
  komo->addControlObjective({}, 2, .01);
  komo->addObjective({1.}, FeatureSymbol::jointState, {}, ObjectiveType::sos, Scale(10.),
                     (VectorXd(3) << 5., 0., -5.).finished());
  const SplineMotion motion(komo, {.points = 5});
  solved(motion.nlp());
  const MatrixXd q = motion.spline().eval(VectorXd::LinSpaced(1000, 0., 1.));
  EXPECT_NEAR(q.cwiseAbs().maxCoeff(), 3., 1e-3);
  EXPECT_LE(q.cwiseAbs().maxCoeff(), 3. + 1e-9);
}

TEST(SplineMotion, DofsOfObjectsThatAreHeldStayVariablesOfTheirOwn) {
  const Config C = arm();
  const auto komo = std::make_shared<Komo>(C, 2., 10, 2);
  komo->addControlObjective({}, 2, .1);
  komo->addModeSwitch({1., 2.}, SwitchMode::stable, {"tip", "ball"}, true);
  komo->addObjective({1.}, FeatureSymbol::positionDiff, {"tip", "ball"}, ObjectiveType::eq, Scale(10.),
                     Target(VectorXd::Zero(3)));
  komo->addObjective({2.}, FeatureSymbol::positionDiff, {"ball", "target"}, ObjectiveType::eq, Scale(10.));
  const SplineMotion motion(komo, {.points = 8});
  const auto nlp = motion.nlp();
  EXPECT_EQ(nlp->dimension(), 3 * 8 + komo->path().layout().dimension - 3 * 20);
  EXPECT_LT(checkJacobian(*nlp, somewhere(*nlp)).error, 1e-5);
}

TEST(SplineMotion, AMotionThatIsToBeFreeAtAllTimesIsRefined) {
  Config C = arm();
  C.setJointState((VectorXd(3) << -.4, .3, .2).finished());
  const auto komo = std::make_shared<Komo>(C, 1., 16, 2);
  komo->addControlObjective({}, 2, .1);
  komo->addFreeMotion({}, 2e-3);
  komo->addObjective({1.}, FeatureSymbol::jointState, {}, ObjectiveType::eq, Scale(10.),
                     (VectorXd(3) << 1.6, -.3, .2).finished());
  const SplineMotion motion(komo, {.points = 8});
  const SolverResult result = solved(motion.nlp());
  EXPECT_TRUE(result.feasible) << result.message;
  EXPECT_EQ(result.free(), true);
  EXPECT_TRUE(motion.isFree(2e-3));
}

TEST(SplineMotion, MistakesAreNamed) {
  const auto komo = reach(arm(), 10);
  expectError<ValueError>([&] { SplineMotion(komo, {.points = 11}); }, {"points is 11", "1 to 10"});
  expectError<ValueError>([&] { SplineMotion(komo, {.points = 5, .degree = 0}); }, {"degree is 0"});
  expectError<ValueError>([&] { SplineMotion(komo, {.points = 10, .degree = 6, .ends_at_rest = false}); },
                          {"10 slices do not determine 13 control points"});
  const auto pose = std::make_shared<Komo>(arm(), 1., 1, 0);
  expectError<ValueError>([&] { SplineMotion(pose, {.points = 1}); }, {"order 0"});
}

}  // namespace
}  // namespace kinegraph
