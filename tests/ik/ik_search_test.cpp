#include "kinegraph/ik/ik_search.h"

#include <gtest/gtest.h>

#include "kinegraph/ik/ik_lanes.h"

namespace kinegraph {
namespace {

const CancellationToken kNever = [] { return false; };

Config arm() {
  Config config;
  config.addText(R"(
base: { shape: box, size: [.2 .2 .2], contact: 1 }
shoulder(base): { pre: [0 0 .2], joint: hingeZ, limits: [-3 3] }
lift(shoulder): { joint: hingeY, limits: [-2 2] }
upper(lift): { Q: [.25 0 0], shape: capsule, size: [.3 .05], contact: -1 }
elbow(lift): { pre: [.5 0 0], joint: hingeY, limits: [-2.5 2.5] }
wrist(elbow): { pre: [.4 0 0], joint: hingeX }
hand(wrist): { Q: [.1 0 0], shape: sphere, size: [.06], contact: 1 }
post: { X: [.6 0 .2], shape: cylinder, size: [1 .05], contact: 1 }
)");
  return config;
}

/// Poses of frames at random joints, so that every target is reachable.
std::vector<std::vector<IkTarget>> reachable(Config config, int count) {
  Rng rng(3);
  const auto model = config.model();
  std::vector<std::vector<IkTarget>> problems;
  for (int i = 0; i < count; ++i) {
    VectorXd q(model->dofs);
    for (int k = 0; k < q.size(); ++k)
      q[k] = rng.uniform(std::max(model->lower[k], -3.), std::min(model->upper[k], 3.));
    config.setJointState(q);
    const Pose X = config.getFrame("hand").getPose();
    problems.push_back(
        {IkTarget::toPosition("hand", X.p), IkTarget::toDirection("hand", Vector3d::UnitX(), X.q * Vector3d::UnitX())});
  }
  return problems;
}

std::shared_ptr<const IkProblem> problemOf(const Config& config, const std::vector<IkTarget>& targets,
                                           const IkOptions& options = {}) {
  return std::make_shared<const IkProblem>(config, targets, options);
}

TEST(IkSearch, ResultsReportTheErrorsOfTheSceneAtTheirJoints) {
  Config config = arm();
  const auto problems = reachable(config, 40);
  IkSearch search(problemOf(config, problems[0]));
  int solved = 0;
  for (const std::vector<IkTarget>& targets : problems) {
    const IkResult result = search.solve(targets, kNever);
    config.setJointState(result.q);
    const Pose X = config.getFrame("hand").getPose();
    EXPECT_NEAR((X.p - targets[0].pose.p).norm(), result.position_error, 1e-12);
    const Vector3d axis = X.q * Vector3d::UnitX(), wanted = targets[1].direction.normalized();
    EXPECT_NEAR(std::atan2(axis.cross(wanted).norm(), axis.dot(wanted)), result.rotation_error, 1e-9);
    double deepest = 0.;
    for (const auto& contact : config.getCollisions(0.)) deepest = std::max(deepest, -contact.distance);
    EXPECT_NEAR(deepest, result.penetration, 1e-9);
    EXPECT_EQ(result.message.empty(), result.feasible());
    solved += result.feasible();
  }
  EXPECT_GE(solved, 20);
}

TEST(IkSearch, AnAnswerDoesNotDependOnWhatWasSearchedBefore) {
  const Config config = arm();
  const auto problems = reachable(config, 12);
  const auto problem = problemOf(config, problems[0]);
  IkSearch one(problem);
  for (const std::vector<IkTarget>& targets : problems) {
    const IkResult again = one.solve(targets, kNever), fresh = IkSearch(problem).solve(targets, kNever);
    EXPECT_EQ(again.q, fresh.q);
    EXPECT_EQ(again.attempts, fresh.attempts);
    EXPECT_EQ(again.message, fresh.message);
  }
}

TEST(IkSearch, ExternalApproachesAreAssessedLikeItsOwn) {
  const Config config = arm();
  const auto problems = reachable(config, 12);
  const auto problem = problemOf(config, problems[0]);
  for (const std::vector<IkTarget>& targets : problems) {
    const IkResult alone = IkSearch(problem).solve(targets, kNever);
    IkSearch other(problem);
    IkJob job;
    other.open(job, targets);
    VectorXd x(problem->variables());
    for (int v = 0; v < x.size(); ++v) x[v] = alone.q[problem->dofs[v]];
    if (!alone.feasible()) continue;
    EXPECT_TRUE(other.assess(job, x, {true, 0., 1}, kNever)) << "an answer ends the search";
    const IkResult result = other.finish(job, false, kNever);
    EXPECT_EQ(result.q, alone.q);
    EXPECT_EQ(result.status, IkStatus::solved);
    EXPECT_EQ(result.attempts, 1);
  }
}

TEST(IkSearch, OfAllAttemptsTheBestAnswerIsTheNearest) {
  const Config config = arm();
  IkOptions first, best;
  best.best = true;
  best.attempts = first.attempts = 30;
  for (const std::vector<IkTarget>& targets : reachable(config, 10)) {
    const IkResult some = IkSearch(problemOf(config, targets, first)).solve(targets, kNever),
                   nearest = IkSearch(problemOf(config, targets, best)).solve(targets, kNever);
    ASSERT_EQ(some.feasible(), nearest.feasible());
    if (!some.feasible()) continue;
    EXPECT_LE((nearest.q - config.getJointState()).norm(), (some.q - config.getJointState()).norm() + 1e-9);
  }
}

TEST(IkSearch, ACancelledSearchSaysSo) {
  const Config config = arm();
  const auto targets = reachable(config, 1)[0];
  const IkResult result = IkSearch(problemOf(config, targets)).solve(targets, [] { return true; });
  EXPECT_EQ(result.status, IkStatus::cancelled);
  EXPECT_EQ(result.attempts, 0);
  EXPECT_NE(result.message.find("cancelled"), std::string::npos);
}

}  // namespace
}  // namespace kinegraph
