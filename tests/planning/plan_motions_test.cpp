#include "kinegraph/planning/plan_motion.h"

#include <gtest/gtest.h>

#include "kinegraph/common/errors.h"
#include "tests/planning/plane_room.h"

namespace kinegraph {
namespace {

/// Two walls with gaps at different places: the first path is seldom in the best homotopy class.
Config twoWalls() {
  Config C = disc(.05);
  int count = 0;
  const auto wall = [&](double x, double low, double high) {
    Frame part = C.addFrame("wall" + std::to_string(count++));
    part.setShape(ShapeType::box, {.1, high - low, 1.}).setPosition({x, .5 * (low + high), 0.}).setContact(1);
  };
  for (const double x : {-.5, .5}) {
    const double shift = x < 0. ? 0. : .25;
    wall(x, -2.2, -1.5 + shift);
    wall(x, -1.2 + shift, -.2 + shift);
    wall(x, .05 + shift, 1. - shift);
    wall(x, 1.3 - shift, 2.2);
  }
  C.setJointState(VectorXd{{-1.5, -1.}});
  return C;
}

const VectorXd kOtherSide{{1.5, .9}};

PlanOptions shortest(int improve) {
  PlanOptions options{.optimize = "length", .restarts = 1, .improvement_evaluations = improve};
  return options;
}

TEST(PlanMotions, EachIsShorterThanTheOneBeforeAndFree) {
  MotionPlans plans = planMotions(twoWalls(), kOtherSide, shortest(20000));
  Config C = twoWalls();
  double before = 1e9, first = 0.;
  int count = 0;
  while (std::optional<MotionPlan> plan = plans.next()) {
    ASSERT_TRUE(plan->feasible()) << plan->message;
    EXPECT_LT(plan->length, before);
    before = plan->length;
    if (count++ == 0) first = before;
    std::vector<VectorXd> points;
    for (Eigen::Index i = 0; i < plan->path.rows(); ++i) points.push_back(plan->path.row(i).transpose());
    EXPECT_GE(leastDistance(C, points), -1e-9);
  }
  EXPECT_LE(before, first);
  EXPECT_FALSE(plans.next());
}

TEST(PlanMotions, MoreEffortComesToTheSameLengthFromAnyFirstWay) {
  std::vector<double> first, last;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    PlanOptions options = shortest(20000);
    options.seed = seed;
    MotionPlans plans(twoWalls(), kOtherSide, options);
    first.push_back(plans.next()->length);
    last.push_back(first.back());
    while (std::optional<MotionPlan> plan = plans.next()) last.back() = plan->length;
  }
  const auto [least, most] = std::minmax_element(last.begin(), last.end());
  EXPECT_LT(*most / *least, 1.005);
  EXPECT_GT(*std::max_element(first.begin(), first.end()) / *least, 1.05);  // the budget was worth it
}

TEST(PlanMotions, ThreadsChangeNothingAndPlanMotionEndsWithTheLast) {
  const auto last = [](int threads) {
    PlanOptions options = shortest(12000);
    options.threads = threads;
    MotionPlans plans(twoWalls(), kOtherSide, options);
    MotionPlan last;
    while (std::optional<MotionPlan> plan = plans.next()) last = std::move(*plan);
    return last.path;
  };
  const MatrixXd path = last(1);
  EXPECT_EQ(last(3), path);
  EXPECT_EQ(planMotion(twoWalls(), kOtherSide, shortest(12000)).path, path);
}

TEST(PlanMotions, OneThatFailsSaysWhyOnce) {
  MotionPlans plans(twoWalls(), VectorXd{{.5, -1.9}}, shortest(1000));
  const std::optional<MotionPlan> plan = plans.next();
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->status, PlanStatus::invalid_goal);
  EXPECT_FALSE(plans.next());
  PlanOptions options = shortest(1000);
  options.start_velocity = VectorXd{{1., 0.}};
  EXPECT_THROW(MotionPlans(twoWalls(), kOtherSide, options), ValueError);
}

}  // namespace
}  // namespace kinegraph
