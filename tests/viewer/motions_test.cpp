#include "kinegraph/viewer/config_viewer.h"

#include <gtest/gtest.h>

#include "kinegraph/common/errors.h"

using namespace kinegraph;

namespace {

/// A joint with limits, one without.
Config arm() {
  Config config;
  config.addText("base: {}\none (base): { joint: hingeX, limits: [-1 3], q: .5 }\ntwo (one): { joint: hingeY, q: 7 }");
  return config;
}

bool isWithinLimits(const MatrixXd& path) {
  return path.col(0).minCoeff() >= -1. - 1e-12 && path.col(0).maxCoeff() <= 3. + 1e-12;
}

}  // namespace

TEST(Motions, APathIsPlacedSliceBySlice) {
  const Config config = arm();
  MatrixXd path(2, 2);
  path << 0., 0., 1., 0.;
  const ShownMotion motion = motionAlong(config, path, 2.);
  ASSERT_EQ(motion.poses.size(), 2u);
  EXPECT_EQ(motion.seconds, 2.);
  EXPECT_NEAR(motion.poses[1][1].q.x(), std::sin(.5), 1e-12);
  EXPECT_EQ(config.getJointState(), Eigen::Vector2d(.5, 7.));
  EXPECT_THROW(motionAlong(config, MatrixXd::Zero(2, 3), 1.), ValueError);
}

TEST(Motions, EveryJointSweepsThroughItsLimitsTheLastFirst) {
  const ShownMotion motion = jointSweep(arm());
  ASSERT_EQ(motion.q.rows(), 100);
  EXPECT_TRUE(isWithinLimits(motion.q));
  const auto first = motion.q.topRows(50), second = motion.q.bottomRows(50);
  EXPECT_TRUE((first.col(0).array() == .5).all());
  EXPECT_NEAR(first.col(1).minCoeff(), 6.5, 2e-3);
  EXPECT_NEAR(first.col(1).maxCoeff(), 7.5, 2e-3);
  EXPECT_NEAR(second.col(0).minCoeff(), -1., 2e-2);
  EXPECT_NEAR(second.col(0).maxCoeff(), 3., 2e-2);
  EXPECT_NEAR(second(0, 0), .5, 1e-12);
  EXPECT_EQ(motion.texts[0], "two  without limits");
  EXPECT_EQ(motion.texts[99], "one  [-1, 3]");
}

TEST(Motions, ASplineBeginsAndEndsHereStaysWithinTheLimitsAndNeverJumps) {
  Rng rng(3);
  const ShownMotion motion = randomSpline(arm(), 5, rng);
  EXPECT_EQ(motion.seconds, 6.);
  EXPECT_TRUE(isWithinLimits(motion.q));
  const Eigen::Index last = motion.q.rows() - 1;
  EXPECT_TRUE(motion.q.row(0).isApprox(Eigen::RowVector2d(.5, 7.), 1e-12));
  EXPECT_TRUE(motion.q.row(last).isApprox(Eigen::RowVector2d(.5, 7.), 1e-12));
  EXPECT_GT((motion.q.col(0).array() - .5).abs().maxCoeff(), .1);
  const MatrixXd steps = motion.q.bottomRows(last) - motion.q.topRows(last);
  EXPECT_LT(steps.cwiseAbs().maxCoeff(), .15);
  EXPECT_THROW(randomSpline(arm(), 0, rng), ValueError);
}
