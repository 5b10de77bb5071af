#include <gtest/gtest.h>

#include "kinegraph/kinegraph.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

Config lifetimesArm() {
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  return C;
}

Komo reachProblem(const Config& C) {
  Komo komo(C, 1, 1, 0);
  komo.addObjective({}, FS::jointState, {}, OT::sos, .1, C.getJointState());
  komo.addObjective({}, FS::position, {"l_gripper"}, OT::eq, 10., {.3, .3, 1.});
  return komo;
}

}  // namespace

TEST(Lifetimes, AResultOwnsItsProblem) {
  const Config C = lifetimesArm();
  const SolverResult result = reachProblem(C).solve();
  EXPECT_TRUE(result.feasible);
  VectorXd phi(result.problem->types().size());
  result.problem->evaluate(result.x, phi, nullptr);
  EXPECT_LT(phi.tail(3).norm(), 1e-2);
  Sensitivity sensitivity(result, {objectiveTarget(*result.problem, 1)});
  EXPECT_EQ(sensitivity.jacobian().cols(), 3);
  EXPECT_TRUE(sensitivity.jacobian().allFinite());
}

TEST(Lifetimes, AProblemSharesThePathOfAKomoThatIsMovedOrDestroyed) {
  Komo moved;
  std::shared_ptr<Nlp> nlp;
  {
    Komo komo = reachProblem(lifetimesArm());
    nlp = komo.nlp();
    moved = std::move(komo);
    expectError<ValueError>([&] { komo.getPath(); }, {"Komo", "moved from"});
  }
  const SolverResult result = NlpSolver(nlp, 0).solve();
  EXPECT_TRUE(result.feasible);
  EXPECT_EQ(moved.getPath().row(0).transpose(), result.x);
  moved = Komo();
  EXPECT_TRUE(NlpSolver(nlp, 0).solve().feasible);
}

TEST(Lifetimes, MovedFromObjectsThrowUntilAnotherOneIsAssigned) {
  Config C = lifetimesArm();
  Config D = std::move(C);
  expectError<ValueError>([&] { C.getFrames(); }, {"Config", "moved from"});
  expectError<ValueError>([&] { C.clear(); }, {"moved from"});
  expectError<ValueError>([&] { const Config copy = C; }, {"moved from"});
  Simulation simulation(D);
  const Simulation other = std::move(simulation);
  expectError<ValueError>([&] { simulation.step(); }, {"Simulation", "moved from"});
  C = D;
  EXPECT_EQ(C.getFrameDimension(), D.getFrameDimension());
}

TEST(Lifetimes, NullArgumentsThrow) {
  expectError<ValueError>([] { NlpSolver(nullptr, 0); }, {"NlpSolver", "null"});
  expectError<ValueError>([] { makeNlp(std::shared_ptr<Komo>()); }, {"Komo is null"});
  const Config C = lifetimesArm();
  expectError<ValueError>([&] { BotOp(C, std::shared_ptr<RobotDriver>()); }, {"driver is null"});
}

TEST(Lifetimes, FramesOfAConstConfigCannotBeChanged) {
  Config C = lifetimesArm();
  const Config& constant = C;
  Frame table = constant.getFrame("table");
  const Pose before = table.getPose();
  expectError<ValueError>([&] { table.setPosition({1., 2., 3.}); }, {"table", "const Config"});
  expectError<ValueError>([&] { table.setMass(1.); }, {"const Config"});
  expectError<ValueError>([&] { table.setContact(0); }, {"const Config"});
  expectError<ValueError>([&] { table.setName("desk"); }, {"const Config"});
  expectError<ValueError>([&] { table.editAttributes(); }, {"const Config"});
  expectError<ValueError>([&] { constant.getFrames().front().setColor({1.}); }, {"const Config"});
  expectError<ValueError>([&] { table.getChildren().front().setPosition({0., 0., 0.}); }, {"const Config"});
  EXPECT_EQ(constant.getFrame("table").getPose().p, before.p);
  C.getFrame("table").setPosition({1., 2., 3.});
  EXPECT_EQ(table.getPosition(), Vector3d(1., 2., 3.));
}
