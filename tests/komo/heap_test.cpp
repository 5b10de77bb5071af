#include <gtest/gtest.h>

#include "kinegraph/komo/komo.h"
#include "kinegraph/komo/path/path.h"
#include "kinegraph/solvers/methods/augmented_lagrangian.h"
#include "tests/support/malloc_count.h"

using namespace kinegraph;

namespace {

/// An arm of three hinges that reaches around a ball.
Config armAndBall() {
  Config config;
  config.addText(R"g(
    world: {}
    one (world): { joint: hingeZ, limits: [-3, 3] }
    upper (one): { Q: [.25, 0, 0], shape: capsule, size: [.3, .03] }
    two (one): { pre: "t(.5 0 0)", joint: hingeZ, limits: [-3, 3] }
    three (two): { pre: "t(.5 0 0)", joint: hingeZ, limits: [-3, 3] }
    tip (three): { Q: [.3, 0, 0], shape: sphere, size: [.05] }
    target (world): { Q: [-.3, .9, 0] }
    ball (world): { Q: [.7, .8, 0], shape: sphere, size: [.2] }
    block (world): { Q: [0, .8, 0], joint: rigid, shape: sphere, size: [.05] }
  )g");
  return config;
}

/// Number of allocations between two evaluations, after the first three.
std::vector<long> requestsOf(const std::shared_ptr<Komo>& komo) {
  const auto nlp = makeNlp(komo);
  std::vector<long> requests;
  requests.reserve(1000);
  long before = 0;
  SolverOptions options;
  options.verbose = 0;
  int calls = 0;
  const VectorXd x = komo->path().variables();
  const SolverResult result = solveAugmentedLagrangian(*nlp, x, options, {}, [&](const VectorXd&, const VectorXd&) {
    if (++calls > 3) requests.push_back(heap_requests - before);
    before = heap_requests;
    return true;
  });
  EXPECT_EQ(result.status, SolverStatus::converged) << result.message;
  EXPECT_GT(requests.size(), 3u);
  return requests;
}

std::shared_ptr<Komo> reachingPath(int order) {
  auto komo = std::make_shared<Komo>(armAndBall(), 1., 12, order);
  komo->addControlObjective({}, 2, 1.);
  komo->addObjective({}, FeatureSymbol::jointLimits, {}, ObjectiveType::ineq, 1e1);
  komo->addObjective({}, FeatureSymbol::distance, {"tip", "ball"}, ObjectiveType::ineq, 1e1);
  komo->addObjective({}, FeatureSymbol::distance, {"upper", "ball"}, ObjectiveType::ineq, 1e1);
  komo->addObjective({1.}, FeatureSymbol::positionDiff, {"tip", "target"}, ObjectiveType::eq, 1e1);
  komo->addObjective({1.}, FeatureSymbol::qItself, {}, ObjectiveType::eq, {}, {}, 1);
  return komo;
}

}  // namespace

TEST(Heap, AStepOfTheSolverOnAPathWithConstraintsRequestsNoMemory) {
  for (const long requests : requestsOf(reachingPath(2))) EXPECT_EQ(requests, 0);
}

TEST(Heap, AStepOnAPathWithAGraspRequestsNoMemory) {
  const auto komo = reachingPath(2);
  komo->addModeSwitch({.5, -1.}, SwitchMode::stable, {"tip", "block"});
  komo->addObjective({.5}, FeatureSymbol::positionDiff, {"tip", "block"}, ObjectiveType::eq, 1e1);
  komo->addQuaternionNorms();
  for (const long requests : requestsOf(komo)) EXPECT_EQ(requests, 0);
}
