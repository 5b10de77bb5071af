#include "kinegraph/planning/plan_to_velocity.h"

#include "kinegraph/collision/edge_check.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/planning/plan_motion.h"
#include "tests/planning/dynamic_room.h"
#include "tests/planning/plane_room.h"

namespace kinegraph {
namespace {

PlanOptions arriving(const VectorXd& velocity, const VectorXd& acceleration = {}) {
  PlanOptions options{.margin = .01};
  options.velocity = VectorXd{{1.}}, options.acceleration = VectorXd{{4.}};
  if (acceleration.size() > 0) options.jerk = VectorXd{{60.}};
  options.end_velocity = velocity, options.end_acceleration = acceleration;
  return options;
}

/// The limits by differences, and the margin at samples.
void expectKept(const Config& C, const MotionPlan& plan) {
  constexpr double kStep = 1e-3;
  const double limits[] = {1., 4., plan.options.jerk.size() > 0 ? plan.options.jerk[0] : 1e9};
  const VectorXd times = VectorXd::LinSpaced(int(plan.duration() / kStep), 0., plan.duration());
  MatrixXd differences = plan.eval(times).q;
  const MatrixXd q = differences;
  for (const double limit : limits) {
    differences = ((differences.bottomRows(differences.rows() - 1) - differences.topRows(differences.rows() - 1)) /
                   (times[1] - times[0]))
                      .eval();
    EXPECT_LE(differences.cwiseAbs().maxCoeff(), 1.001 * limit);
  }
  EdgeChecker check(C.state(), .01 - 1e-9);
  for (Eigen::Index k = 0; k < q.rows(); ++k) EXPECT_TRUE(check.isFree(VectorXd(q.row(k)).data())) << k;
}

TEST(PlanToVelocity, ItEndsWithAVelocityInAnyDirection) {
  Config C = room(.8);
  C.setJointState(VectorXd{{-1., 1.2}});
  const VectorXd goal{{1., 1.}};
  for (const VectorXd& velocity : {VectorXd{{.5, .2}}, VectorXd{{0., -.8}}, VectorXd{{-.3, .1}}})
    for (const VectorXd& acceleration : {VectorXd(), VectorXd{{.4, -.6}}}) {
      const MotionPlan plan = planMotion(C, goal, arriving(velocity, acceleration));
      ASSERT_TRUE(plan.feasible()) << plan.message;
      EXPECT_TRUE(plan.warnings.empty());
      const MotionState end = plan.eval(plan.duration());
      EXPECT_LE((end.q - goal).norm(), 1e-9);
      EXPECT_LE((end.velocity - velocity).norm(), 1e-9);
      if (acceleration.size() > 0) EXPECT_LE((end.acceleration - acceleration).norm(), 1e-9);
      EXPECT_LE(plan.eval(0.).velocity.norm(), 1e-9);
      expectKept(C, plan);
    }
}

TEST(PlanToVelocity, WithoutALineToBendItComesBackFromBehind) {
  Config C = room(.8);
  C.setJointState(VectorXd{{1., 1.}});
  const VectorXd velocity{{.5, 0.}};
  const MotionPlan plan = planMotion(C, VectorXd{{1., 1.}}, arriving(velocity));
  ASSERT_TRUE(plan.feasible()) << plan.message;
  EXPECT_LE((plan.eval(plan.duration()).velocity - velocity).norm(), 1e-9);
  EXPECT_GT(plan.duration(), .1);
  expectKept(C, plan);
}

TEST(PlanToVelocity, AWallBehindTheGoalIsTheReason) {
  Config C = disc(.2);
  C.addFrame("wall").setShape(ShapeType::box, {.1, 3., 1.}).setPosition({.28, 0., 0.}).setContact(1);
  C.setJointState(VectorXd{{1.5, 1.}});
  const MotionPlan plan = planMotion(C, VectorXd{{.55, 0.}}, arriving(VectorXd{{1., 0.}}));
  EXPECT_EQ(plan.status, PlanStatus::no_path_found);
  EXPECT_NE(plan.message.find("a motion ends there at rest, but none with the end velocity"), std::string::npos)
      << plan.message;
}

TEST(PlanToVelocity, VelocitiesBeyondTheLimitsAndOtherGoalsAreRefused) {
  Config C = room(.8);
  const VectorXd goal{{1., 1.}};
  EXPECT_EQ(planMotion(C, goal, arriving(VectorXd{{0., 1.1}})).status, PlanStatus::invalid_goal);
  EXPECT_THROW(planMotion(C, std::vector<VectorXd>{goal, goal}, arriving(VectorXd{{0., .5}})), ValueError);
  PlanOptions both = arriving(VectorXd{{0., .5}});
  both.start_velocity = VectorXd{{.1, 0.}};
  EXPECT_THROW(planMotion(C, goal, both), ValueError);
}

}  // namespace
}  // namespace kinegraph
