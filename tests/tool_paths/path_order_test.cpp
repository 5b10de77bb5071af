#include "kinegraph/tool_paths/path_order.h"

#include <gtest/gtest.h>

#include <cmath>

namespace kinegraph {
namespace {

double transferOver(double distance, double velocity, double acceleration, double jerk) {
  MotionLimits limits;
  limits.velocity = VectorXd::Constant(1, velocity), limits.acceleration = VectorXd::Constant(1, acceleration);
  if (jerk > 0.) limits.jerk = VectorXd::Constant(1, jerk);
  return leastTransfer(VectorXd::Zero(1), VectorXd::Constant(1, distance), limits);
}

TEST(PathOrder, TheLeastTransferIsThatOfRampsFromRestToRest) {
  EXPECT_NEAR(transferOver(-4., 1., 2., 0.), 4.5, 1e-12);                    // 4 / 1 + 1 / 2
  EXPECT_NEAR(transferOver(.25, 1., 2., 0.), std::sqrt(.5), 1e-12);          // 2 sqrt(d / a)
  EXPECT_NEAR(transferOver(1., 1., 2., 8.), 1.75, 1e-12);                    // d / v + v / a + a / j
  EXPECT_NEAR(transferOver(.001, 1., 2., 8.), std::cbrt(.004), 1e-12);       // cbrt(32 d / j)
  EXPECT_NEAR(transferOver(.3, 1., 2., 8.), std::sqrt(.6625) + .25, 1e-12);  // sqrt((a / j)^2 + 4 d / a) + a / j
  EXPECT_NEAR(transferOver(10., 1., 100., 1.), 10. + 2., 1e-12);             // d / v + 2 sqrt(v / j)
  EXPECT_EQ(transferOver(0., 1., 2., 8.), 0.);
}

/// Four paths at points on a line, done from the left.
TEST(PathOrder, VisitsPointsOnALineInTheirOrder) {
  OrderProblem problem;
  const VectorXd at{{3., 1., 4., 2.}};
  problem.free_order = true;
  for (int k = 0; k < 4; ++k)
    problem.variants.push_back({{0, false, VectorXd::Constant(1, at[k]), VectorXd::Constant(1, at[k])}});
  problem.begin = at, problem.transfer.resize(4, 4);
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) problem.transfer(a, b) = std::abs(at[a] - at[b]);
  std::vector<int> order;
  for (const OrderedPath& path : orderPaths(problem)) order.push_back(path.path);
  EXPECT_EQ(order, (std::vector<int>{1, 3, 0, 2}));
}

/// Plans transfers in the plane; a configuration at y = 9 is in a part of the space that nothing leads to.
TEST(PathOrder, LeavesOutVariantsThatNoTransferLeadsTo) {
  const auto variant = [](int solution, double x, double y) {
    return PathVariant{solution, false, VectorXd{{x, y}}, VectorXd{{x, y}}};
  };
  MotionLimits limits;
  limits.velocity = limits.acceleration = VectorXd::Ones(2);
  int calls = 0;
  const TransferPlanner plan = [&](const VectorXd& from, const VectorXd& to) {
    ++calls;
    MotionPlan motion;
    if ((from[1] == 9.) == (to[1] == 9.)) {
      MatrixXd points(2, 2);
      points << from.transpose(), to.transpose();
      motion.timed_path = retime(points, limits);
      if (motion.timed_path.feasible()) motion.status = PlanStatus::solved;
    }
    return motion;
  };
  const VectorXd from{{0., 0.}};
  const PathSequence sequence =
      orderWithTransfers({{variant(0, 1., 9.), variant(1, 20., 1.)}, {variant(0, 2., 9.), variant(1, 21., 1.)}}, false,
                         from, limits, plan);
  ASSERT_TRUE(sequence.feasible);
  EXPECT_EQ(sequence.order[0].solution, 1);
  EXPECT_EQ(sequence.order[1].solution, 1);
  EXPECT_EQ(sequence.transfers.size(), 2u);
  EXPECT_LE(calls, 6);
  EXPECT_FALSE(orderWithTransfers({{variant(0, 1., 9.)}}, false, from, limits, plan).feasible);
  for (const bool free_order : {false, true}) {  // a wall between the two
    EXPECT_FALSE(
        orderWithTransfers({{variant(0, 1., 0.)}, {variant(0, 2., 9.)}}, free_order, from, limits, plan).feasible);
  }
}

TEST(PathOrder, APathThatIsFasterIsWorthALongerTransfer) {
  OrderProblem problem;
  const VectorXd at{{0.}};
  problem.variants = {{{0, false, at, at, 5.}, {1, false, at, at, 2.}}, {{0, false, at, at, 1.}}};
  problem.begin = VectorXd{{0., 1., 0.}}, problem.transfer = MatrixXd::Constant(3, 3, 1.);
  EXPECT_EQ(orderPaths(problem)[0].solution, 1);
}

}  // namespace
}  // namespace kinegraph
