#include "kinegraph/ik/ik_problem.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/expect_error.h"

namespace kinegraph {
namespace {

/// Two arms on a rotating base, a mimicking finger, a ball joint, and a fixed body.
Config arms() {
  Config config;
  config.addText(R"(
base: { shape: box, size: [.2 .2 .2], contact: 1 }
turn(base): { joint: hingeZ, limits: [-2 2] }
left(turn): { pre: [0 .5 0], joint: hingeX, limits: [-1 1], shape: sphere, size: [.1], contact: 1 }
ball(left): { pre: [0 0 1], joint: quatBall }
hand(ball): { Q: [0 0 .5], shape: sphere, size: [.1], contact: 1 }
right(turn): { pre: [0 -.5 0], joint: transX, limits: [-.3 .3], shape: sphere, size: [.1], contact: 1 }
tool(right): { pre: [0 0 1], joint: hingeY }
finger(tool): { Q: [.2 0 0], shape: sphere, size: [.05], contact: 1 }
other(tool): { pre: [-.2 0 0], joint: hingeY, mimic: tool, shape: sphere, size: [.05], contact: 1 }
wall: { X: [2 0 0], shape: box, size: [.1 2 2], contact: 1 }
stone: { X: [4 0 0], shape: sphere, size: [.1], contact: 1 }
)");
  return config;
}

TEST(IkProblem, ItsVariablesAreTheDofsThatMoveATarget) {
  Config config = arms();
  for (const std::vector<const char*>& frames :
       std::vector<std::vector<const char*>>{{"hand"}, {"finger"}, {"other"}, {"hand", "finger"}, {"turn"}}) {
    std::vector<IkTarget> targets;
    for (const char* frame : frames) targets.push_back(IkTarget::toPose(frame, Pose()));
    const IkProblem problem(config, targets, {});
    std::vector<int> moving;
    for (int dof = 0; dof < config.getJointDimension(); ++dof) {
      bool moves = false;
      for (const char* frame : frames) {
        Config changed = config;
        VectorXd q = config.getJointState();
        q[dof] += .1;
        changed.setJointState(q);
        moves =
            moves || !(config.getFrame(frame).getPose().inverse() * changed.getFrame(frame).getPose()).isIdentity(1e-9);
      }
      const bool of_ball = config.getFrame("ball").getJointState().size() == 4 && dof >= 2 && dof < 6;
      if (moves || (of_ball && std::string(frames[0]) == "hand"))
        moving.push_back(dof);  // w alone only changes the norm
    }
    EXPECT_EQ(problem.dofs, moving) << frames[0];
    for (int v = 0; v < problem.variables(); ++v) EXPECT_EQ(problem.variable[problem.dofs[v]], v);
  }
}

TEST(IkProblem, ItsPairsAreThoseWhoseRelativePoseTheVariablesChange) {
  Config config = arms();
  Rng rng(1);
  for (const char* frame : {"hand", "finger", "turn"}) {
    const IkProblem problem(config, {IkTarget::toPose(frame, Pose())}, {});
    Config changed = config;
    VectorXd q = config.getJointState();
    for (int dof : problem.dofs) q[dof] += .2 + .3 * rng.uniform();
    changed.setJointState(q);
    std::set<std::pair<int, int>> moved;
    for (const auto& [a, b] : config.getCollidablePairs()) {
      const Pose before = config.getFrame(a).getPose(config.getFrame(b)),
                 after = changed.getFrame(a).getPose(changed.getFrame(b));
      if (!(before.inverse() * after).isIdentity(1e-9)) moved.emplace(a, b);
    }
    EXPECT_EQ(std::set(problem.pairs.begin(), problem.pairs.end()), moved) << frame;
    EXPECT_FALSE(moved.empty());
  }
  IkOptions without;
  without.collisions = false;
  EXPECT_TRUE(IkProblem(config, {IkTarget::toPose("hand", Pose())}, without).pairs.empty());
}

TEST(IkProblem, StartingPointsAreWithinLimitsOfNormOneAndTheFirstIsThePresentOne) {
  Config config = arms();
  const IkProblem problem(config, {IkTarget::toPose("hand", Pose()), IkTarget::toPose("finger", Pose())}, {});
  VectorXd x(problem.variables()), before;
  for (int i = 0; i < 50; ++i) {
    problem.startingPoint(i, x.data());
    for (int v = 0; v < x.size(); ++v) {
      EXPECT_GE(x[v], problem.lower[v]);
      EXPECT_LE(x[v], problem.upper[v]);
      if (i == 0) EXPECT_EQ(x[v], config.getJointState()[problem.dofs[v]]);
    }
    const int first = problem.variable[config.model()->unit_norms.at(0).first];
    EXPECT_NEAR(x.segment(first, 4).norm(), 1., 1e-15);
    if (i > 0) EXPECT_NE(x, before);
    before = x;
  }
}

TEST(IkProblem, AnswersAreWantedWhereTheWeightsSay) {
  Config config = arms();  // q is home
  VectorXd q = config.getJointState();
  q[0] = 1.;
  config.setJointState(q);
  const std::vector<IkTarget> targets = {IkTarget::toPosition("finger", {0., 0., 0.})};
  IkOptions options;
  EXPECT_FALSE(IkProblem(config, targets, options).has_preference);
  options.start_weight = 3.;
  options.home_weight = 1.;
  EXPECT_NEAR(IkProblem(config, targets, options).preferred[0], .75, 1e-15);
  options.start_weight = 0.;
  EXPECT_NEAR(IkProblem(config, targets, options).preferred[0], 0., 1e-15);
}

TEST(IkProblem, WhatMakesNoSenseIsSaid) {
  const Config config = arms();
  expectError<FrameNotFound>([&] { IkProblem(config, {IkTarget::toPose("hnad", Pose())}, {}); }, {"'hnad'", "hand"});
  expectError<ValueError>([&] { IkProblem(config, {IkTarget::toPose("wall", Pose())}, {}); },
                          {"'wall'", "no active joint"});
  expectError<ValueError>([&] { IkProblem(config, {}, {}); }, {"no targets"});
  IkOptions options;
  options.attempts = 0;
  expectError<ValueError>([&] { IkProblem(config, {IkTarget::toPose("hand", Pose())}, options); }, {"attempts is 0"});
}

}  // namespace
}  // namespace kinegraph
