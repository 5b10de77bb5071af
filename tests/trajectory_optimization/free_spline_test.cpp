#include <gtest/gtest.h>

#include "kinegraph/komo/mode_switches.h"
#include "kinegraph/nlp/initial_guesses.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/solvers/nlp_solver.h"
#include "kinegraph/trajectory_optimization/motion_problems.h"
#include "tests/support/coal_distance.h"
#include "tests/support/expect_error.h"
#include "tests/support/planar_arm.h"

namespace kinegraph {
namespace {

constexpr double kMargin = 3e-3;  // m

/// A planar arm of three joints among random balls and boxes; its start and goal are collision-free.
struct Problem {
  Config scene;
  VectorXd start, goal;
};

Problem drawnProblem(Rng& rng) {
  for (;;) {
    Config scene;
    scene.addText(planarArm());
    for (int i = 0; i < 3; ++i) {
      const double radius = rng.uniform(.7, 1.2), angle = rng.uniform(-2., 2.), size = rng.uniform(.04, .1);
      Frame obstacle = scene.addFrame("obstacle" + std::to_string(i));
      if (i == 0)
        obstacle.setShape(ShapeType::box, {size, 3. * size, 1.});
      else
        obstacle.setShape(ShapeType::sphere, {size});
      obstacle.setContact(1);
      obstacle.setPosition(Vector3d(radius * std::cos(angle), radius * std::sin(angle), 0.));
    }
    State state = scene.state();
    const auto draw = [&] {
      VectorXd q(3);
      q << rng.uniform(-1.5, 1.5), rng.uniform(-1.2, 1.2), rng.uniform(-1., 1.);
      state.setJoints(q.data());
      return q;
    };
    const VectorXd start = draw();
    if (coalDistance(state) < .01) continue;
    const VectorXd goal = draw();
    if (coalDistance(state) < .01 || (goal - start).norm() < 1.) continue;
    scene.setJointState(start);
    return {std::move(scene), start, goal};
  }
}

std::shared_ptr<Komo> problemOf(const Problem& problem, int slices, bool at_all_times) {
  auto komo = std::make_shared<Komo>(problem.scene, 1., slices, 2);
  komo->addControlObjective({}, 2, .1);
  if (at_all_times)
    komo->addFreeMotion({}, kMargin);
  else
    komo->addObjective({}, FeatureSymbol::accumulatedCollisions, {}, ObjectiveType::ineq, Scale(10.), {}, -1, kMargin);
  komo->addObjective({1.}, FeatureSymbol::jointState, {}, ObjectiveType::eq, Scale(10.), problem.goal);
  MatrixXd path(slices, 3);
  for (int t = 0; t < slices; ++t)
    path.row(t) = (problem.start + (t + 1.) / slices * (problem.goal - problem.start)).transpose();
  komo->setPath(path);
  return komo;
}

/// Smallest distance along a spline of all joints, by coal, at many times.
double coalDistanceAlong(const BSpline& spline, State state, int count) {
  double least = 1.;
  const MatrixXd q = spline.eval(VectorXd::LinSpaced(count, 0., spline.end()));
  for (Eigen::Index i = 0; i < q.rows(); ++i) {
    const VectorXd here = q.row(i);
    state.setJoints(here.data());
    least = std::min(least, coalDistance(state));
  }
  return least;
}

SolverResult resultOf(const std::shared_ptr<Nlp>& nlp) {
  NlpSolver solver(nlp, 0);
  return solver.solve();
}

TEST(FreeSpline, WhatIsCalledFeasibleKeepsTheMarginAtAllTimesOnRandomProblems) {
  Rng rng(20);
  int feasible = 0, free_in_slices_only = 0;
  for (int i = 0; i < 12; ++i) {
    const Problem problem = drawnProblem(rng);
    const SplineMotionOptions options{.points = 8 + i % 3, .degree = 2 + i % 4};
    const SplineMotion always(problemOf(problem, 16, true), options), slices(problemOf(problem, 16, false), options);
    const SolverResult result = resultOf(always.nlp()), of_slices = resultOf(slices.nlp());
    const State scene = problem.scene.state();
    if (result.feasible) {
      EXPECT_EQ(result.free(), true) << i << ": " << result.summary();
      EXPECT_TRUE(always.isFree(kMargin)) << i;
      EXPECT_GT(coalDistanceAlong(always.spline(), scene, 2000), kMargin - 1e-6) << i;
    }
    feasible += result.feasible;
    EXPECT_EQ(of_slices.free(), slices.isFree()) << i;
    free_in_slices_only += of_slices.feasible && coalDistanceAlong(slices.spline(), scene, 2000) > kMargin - 1e-6;
  }
  EXPECT_GE(feasible, 10);
  EXPECT_LT(free_in_slices_only, feasible);
}

TEST(FreeSpline, LinesThroughObstaclesAreReplacedByPathsAroundThem) {
  Rng rng(33);
  int evals = 0, blocked = 0;
  constexpr int kProblems = 20;
  for (int i = 0; i < kProblems; ++i) {
    const Problem problem = drawnProblem(rng);
    const auto komo = problemOf(problem, 16, true);
    const auto nlp = makeNlp(komo);
    const VectorXd line = komo->path().variables();
    blocked += nlp->initialGuesses()->guessKind(line) == GuessKind::invalid;
    NlpSolver solver(nlp, 0);
    solver.setInitialization(line);
    const SolverResult result = solver.solve();
    EXPECT_TRUE(result.feasible) << i << ": " << result.summary();
    EXPECT_EQ(result.free(), true) << i;
    EXPECT_EQ(nlp->initialGuesses()->guessKind(result.x), GuessKind::valid) << i;
    evals += result.evals;
  }
  EXPECT_GT(blocked, 5);
  EXPECT_LT(evals, 80 * kProblems);
}

TEST(FreeSpline, ALimitOfRoundsEndsAProblemOfSlicesAtOnce) {
  Rng rng(8);
  const auto komo = problemOf(drawnProblem(rng), 16, false);
  NlpSolver solver(makeNlp(komo), 0);
  solver.options.stopOuters = 1;
  solver.setInitialization(VectorXd::Zero(komo->path().layout().dimension));
  const SolverResult result = solver.solve();
  EXPECT_EQ(result.status, SolverStatus::limit) << result.summary();
  EXPECT_LE(result.evals, 6);
}

TEST(FreeSpline, StartsThatHardlyMoveAreNoPaths) {
  Config scene;
  scene.addText(R"(
base: {}
ball (base): { joint: transXY, shape: sphere, size: [.1], contact: 1 }
wall (base): { shape: box, size: [.03 1 1], X: [.6 0 0], contact: 1 }
)");
  const auto komo = std::make_shared<Komo>(scene, 1., 10, 2);
  komo->addFreeMotion({}, kMargin);
  Rng rng(5);
  const auto lines = makeNlp(komo), spline = SplineMotion(komo, {.points = 8}).nlp();
  const auto guessKind = [](Nlp& nlp, const VectorXd& x) { return nlp.initialGuesses()->guessKind(x); };
  for (const auto& nlp : {lines, spline}) EXPECT_EQ(guessKind(*nlp, nlp->initialPoint(rng)), GuessKind::stationary);
  for (const auto& [goal, kind] : {std::pair(.4, GuessKind::valid), std::pair(1.2, GuessKind::invalid)}) {
    MatrixXd path = MatrixXd::Zero(10, 2);
    path.col(0) = VectorXd::LinSpaced(10, .1 * goal, goal);
    komo->setPath(path);
    for (const auto& nlp : {lines, spline}) EXPECT_EQ(guessKind(*nlp, nlp->initialPoint(rng)), kind) << goal;
  }
}

TEST(FreeSpline, VerdictsAgreeWithSamplesOfRandomSplines) {
  Rng rng(7);
  int free = 0;
  for (int i = 0; i < 40; ++i) {
    const Problem problem = drawnProblem(rng);
    const auto komo = problemOf(problem, 12, false);
    const SplineMotion motion(komo, {.points = 4 + i % 4, .degree = 1 + i % 5});
    const auto nlp = motion.nlp();
    VectorXd c = nlp->initialPoint(rng);
    for (double& value : c) value += .15 * rng.normal();
    nlp->leaveAt(c);
    const double least = coalDistanceAlong(motion.spline(), problem.scene.state(), 4000);
    const ValidityReport verdict = nlp->validity(c)->get();
    EXPECT_EQ(verdict.valid, motion.isFree()) << i;
    EXPECT_TRUE(verdict.valid ? least > -1e-6 : least < 4e-5) << i << ": " << least << ", " << verdict.message;
    EXPECT_TRUE(motion.isFree(least - 5e-4)) << "the bound is as tight as that";
    EXPECT_FALSE(motion.isFree(least + 1e-6)) << i;
    free += verdict.valid;
  }
  EXPECT_GT(free, 5);
  EXPECT_LT(free, 35);
}

TEST(FreeSpline, FlyingBodiesRotateByQuaternionsAndAreReportedAsSamplesSay) {
  Config scene;
  scene.addText(R"(
base: {}
bird (base): { joint: free, shape: box, size: [.4 .1 .05], contact: 1 }
wall (base): { shape: box, size: [.05 1 1], X: [.4 .5 0], contact: 1 }
)");
  Rng rng(2);
  int free = 0;
  for (int i = 0; i < 30; ++i) {
    const auto komo = std::make_shared<Komo>(scene, 1., 10, 2);
    komo->addControlObjective({}, 2, .1);
    komo->addObjective({}, FeatureSymbol::accumulatedCollisions, {}, ObjectiveType::eq, Scale(10.));
    const SplineMotion motion(komo, {.points = 5});
    const auto nlp = motion.nlp();
    VectorXd c = nlp->initialPoint(rng);
    for (double& value : c) value += .25 * rng.normal();
    nlp->leaveAt(c);
    const double least = coalDistanceAlong(motion.spline(), scene.state(), 4000);
    EXPECT_TRUE(motion.isFree(least - 5e-4)) << i;
    EXPECT_FALSE(motion.isFree(least + 1e-6)) << i;
    free += motion.isFree();
  }
  EXPECT_GT(free, 3);
  EXPECT_LT(free, 27);
}

TEST(FreeSpline, HasTheJacobianOfDifferencesInBothForms) {
  Rng rng(3);
  int checked = 0;
  for (int i = 0; i < 6; ++i) {
    const SplineMotion motion(problemOf(drawnProblem(rng), 12, true), {.points = 6, .degree = 1 + i % 4});
    const auto nlp = motion.nlp();
    VectorXd c = nlp->initialPoint(rng), no_multipliers;
    for (double& value : c) value += .1 * rng.normal();
    if (nlp->refine(c, no_multipliers) == Refinement::none) continue;
    EXPECT_LT(checkJacobian(*nlp, c, 1e-6).error, 1e-4) << i;
    EXPECT_LT(checkJacobian(*nlp->separation().problem, c, 1e-6).error, 1e-4) << i;
    ++checked;
  }
  EXPECT_GE(checked, 4);
}

TEST(FreeSpline, WhatIsHeldMovesAlongAndItsOwnVariablesCount) {
  Config scene;
  scene.addText(R"(
base: {}
slide (base): { joint: transXY }
hand (slide): { shape: sphere, size: [.02], contact: 1 }
cup (base): { shape: sphere, size: [.05], X: [.3 0 0], contact: 1 }
post (base): { shape: box, size: [.04 .04 1], X: [.8 .02 0], contact: 1 }
)");
  const auto komo = std::make_shared<Komo>(scene, 2., 8, 2);
  komo->addControlObjective({}, 2, .1);
  komo->addModeSwitch({1., 2.}, SwitchMode::stable, {"hand", "cup"}, true);
  komo->addObjective({1.}, FeatureSymbol::positionDiff, {"hand", "cup"}, ObjectiveType::eq, Scale(10.),
                     Target((VectorXd(3) << -.08, 0., 0.).finished()));
  komo->addObjective({2.}, FeatureSymbol::position, {"cup"}, ObjectiveType::eq, Scale(10.),
                     Target((VectorXd(3) << 1.3, 0., 0.).finished()));
  komo->addFreeMotion({1., 2.}, kMargin);
  MatrixXd path(16, 2);
  path.col(0) = VectorXd::LinSpaced(16, .05, 1.2);
  path.col(1).setConstant(.03);
  komo->setPath(path);
  const SplineMotion motion(komo, {.points = 8});
  const auto nlp = motion.nlp();
  Rng rng(1);
  VectorXd c = nlp->initialPoint(rng), no_multipliers;
  EXPECT_FALSE(nlp->validity(c)->get().valid);
  EXPECT_NE(nlp->refine(c, no_multipliers), Refinement::none);
  EXPECT_LT(checkJacobian(*nlp, c, 1e-6).error, 1e-4);
  EXPECT_LT(checkJacobian(*nlp->separation().problem, c, 1e-6).error, 1e-4);
  const SolverResult result = resultOf(nlp);
  ASSERT_TRUE(result.feasible) << result.summary();
  EXPECT_EQ(result.free(), true);
  const BSpline spline = motion.spline();
  const VectorXd held = komo->path().configuration(15).getFrame("cup").getPosition() -
                        komo->path().configuration(15).getFrame("hand").getPosition();
  double least = 1.;
  for (const double t : VectorXd::LinSpaced(1000, 1. + 1e-9, 2.)) {
    const VectorXd q = spline.eval(t);
    const Vector3d hand(q[0], q[1], 0.), cup = hand + held, post(.8, .02, 0.);
    for (const auto& [center, radius] : {std::pair(hand, .02), std::pair(cup, .05)}) {
      const Vector3d beyond = ((center - post).cwiseAbs() - Vector3d(.02, .02, .5)).cwiseMax(0.);
      least = std::min(least, beyond.norm() - radius);
    }
  }
  EXPECT_GT(least, kMargin - 1e-6);
}

TEST(FreeSpline, ReportsNameThePairAndTheTime) {
  Config scene;
  scene.addText(R"(
base: {}
ball (base): { joint: transX, shape: sphere, size: [.1], contact: 1 }
wall (base): { shape: box, size: [.03 1 1], X: [.6 0 0], contact: 1 }
)");
  const auto komo = std::make_shared<Komo>(scene, 1., 4, 2);
  komo->addControlObjective({}, 2, 1.);
  komo->addFreeMotion({}, 0.);
  komo->addObjective({1.}, FeatureSymbol::jointState, {}, ObjectiveType::eq, Scale(10.), VectorXd::Constant(1, 1.2));
  const SplineMotion motion(komo, {.points = 4});
  const auto nlp = motion.nlp();
  const SolverResult result = resultOf(nlp);
  EXPECT_FALSE(result.feasible) << "there is no way around";
  EXPECT_EQ(result.free(), false);
  const ValidityReport verdict = nlp->validity(result.x)->get();
  EXPECT_NE(verdict.message.find("'ball' and 'wall' overlap by 115 mm"), std::string::npos) << verdict.message;
  VectorXd phi(Eigen::Index(nlp->types().size()));
  nlp->evaluate(result.x, phi, nullptr);
  bool told = false;
  for (int row = 0; row < int(phi.size()); ++row) {
    if (nlp->describeRow(row).objective != "accumulatedCollisions between slices" || phi[row] <= 0.) continue;
    told = told || !nlp->detailsOf(row).empty();
    EXPECT_NE(nlp->rowName(row).find("between slices"), std::string::npos);
  }
  EXPECT_TRUE(told);
  expectError<ValueError>([&] { motion.isFree(NAN); }, {"SplineMotion: margin is nan"});
}

TEST(FreeSpline, ASolveIsTheSameEachTime) {
  Rng rng(12);
  const Problem problem = drawnProblem(rng);
  const auto solve = [&] { return resultOf(SplineMotion(problemOf(problem, 16, true), {.points = 8}).nlp()); };
  const SolverResult first = solve(), second = solve();
  EXPECT_EQ(first.x, second.x);
  EXPECT_EQ(first.evals, second.evals);
}

}  // namespace
}  // namespace kinegraph
