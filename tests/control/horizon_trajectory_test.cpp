#include "kinegraph/control/mpc.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kinegraph/common/random.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

constexpr double kRounding = 1e-8;

std::vector<double> evenTimes(int count, double step) {
  std::vector<double> times;
  for (int k = 0; k < count; ++k) times.push_back(step * k);
  return times;
}

}  // namespace

TEST(HorizonTrajectory, IsNowhereFasterThanTheFastestSlice) {
  Rng rng(0);
  for (int trial = 0; trial < 300; ++trial) {
    const int slices = 2 + trial % 12;
    const double step = .05, limit = 1.;
    MatrixXd q = MatrixXd::Zero(1, slices + 1);
    for (int k = 1; k <= slices; ++k) {
      const double u = rng.uniform(-1.5, 1.5);
      q(0, k) = q(0, k - 1) + step * std::clamp(u, -limit, limit);  // often at the limit
    }
    const HorizonTrajectory motion(evenTimes(slices + 1, step), q, VectorXd::Constant(1, rng.uniform(-1., 1.)));
    VectorXd before = motion.eval(0.).q;
    const double fine = 1e-4;
    for (double t = 0.; t < motion.duration(); t += fine) {
      const MotionState state = motion.eval(t);
      EXPECT_LE(std::abs(state.velocity[0]), limit + kRounding) << trial << " at " << t;
      EXPECT_LE(std::abs(state.q[0] - before[0]), fine * (limit + 1e-6)) << trial << " at " << t;  // no jump
      before = state.q;
    }
    for (int k = 0; k <= slices; ++k) EXPECT_NEAR(motion.eval(step * k).q[0], q(0, k), 1e-12);
  }
}

TEST(HorizonTrajectory, BrakingFromTheLimitStaysAtIt) {
  MatrixXd q(1, 5);
  q << 0., .1, .2, .25, .25;  // velocities 1, 1, .5, 0
  const HorizonTrajectory motion(evenTimes(5, .1), q, VectorXd::Ones(1));
  for (double t = 0.; t < .2; t += .01) EXPECT_NEAR(motion.eval(t).velocity[0], 1., 1e-6) << t;
  double before = motion.eval(0.).velocity[0];
  for (double t = 0.; t < .4; t += 1e-3) {  // the velocity is continuous
    const double now = motion.eval(t).velocity[0];
    EXPECT_LT(std::abs(now - before), .05) << t;
    before = now;
  }
}

TEST(HorizonTrajectory, PointsThatDoNotFitTheTimesAreRefused) {
  expectError<ValueError>([] { HorizonTrajectory({}, MatrixXd(2, 0), VectorXd::Zero(2)); }, {"0 times"});
  expectError<ValueError>([] { HorizonTrajectory({0., 1.}, MatrixXd::Ones(2, 1), VectorXd::Zero(2)); }, {"(2, 1)"});
  expectError<ValueError>([] { HorizonTrajectory({0.}, MatrixXd::Ones(2, 1), VectorXd()); }, {"0 velocities"});
}

TEST(HorizonTrajectory, ATimeThatIsNoNumberIsRefused) {
  const HorizonTrajectory motion({0.}, MatrixXd::Ones(2, 1), VectorXd::Zero(2));
  EXPECT_EQ(motion.eval(3.).q, VectorXd::Ones(2));
  expectError<ValueError>([&] { motion.eval(std::nan("")); }, {"t is NaN"});
}
