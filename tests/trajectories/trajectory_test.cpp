#include "kinegraph/trajectories/trajectory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "kinegraph/common/random.h"
#include "kinegraph/trajectories/retime.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

/// q = (sin t, t^2 / 2) for 2 s.
class Swing final : public Trajectory {
 public:
  int dimension() const override { return 2; }
  double duration() const override { return 2.; }
  void evalTo(double t, double* q, double* velocity, double* acceleration) const override {
    t = std::clamp(t, 0., 2.);
    q[0] = std::sin(t), q[1] = .5 * t * t;
    velocity[0] = std::cos(t), velocity[1] = t;
    acceleration[0] = -std::sin(t), acceleration[1] = 1.;
  }
};

/// Velocity and acceleration are the central differences of q and of the velocity.
void expectConsistent(const Trajectory& motion, double t, double tolerance) {
  constexpr double h = 1e-5;
  const MotionState before = motion.eval(t - h), at = motion.eval(t), after = motion.eval(t + h);
  EXPECT_LT(((after.q - before.q) / (2. * h) - at.velocity).norm(), tolerance) << t;
  EXPECT_LT(((after.velocity - before.velocity) / (2. * h) - at.acceleration).norm(), tolerance) << t;
}

}  // namespace

TEST(Trajectory, SamplesAtEqualStepsWithBothEnds) {
  const MotionStates samples = Swing().sample(3.);
  ASSERT_EQ(samples.times.size(), 7);
  for (Eigen::Index k = 0; k < 7; ++k) {
    EXPECT_NEAR(samples.times[k], double(k) / 3., 1e-15);
    const MotionState state = Swing().eval(samples.times[k]);
    EXPECT_EQ(VectorXd(samples.q.row(k)), state.q);
    EXPECT_EQ(VectorXd(samples.velocity.row(k)), state.velocity);
    EXPECT_EQ(VectorXd(samples.acceleration.row(k)), state.acceleration);
  }
  EXPECT_EQ(Swing().sample(3.1).times.size(), 8);
  expectError<ValueError>([] { Swing().sample(0.); }, {"the rate is 0 Hz"});
  expectError<ValueError>([] { Swing().sample(1e9); }, {"fewer than 1e+08 samples"});
}

TEST(Trajectory, OfASplineHasTheStatesOfTheSpline) {
  MatrixXd points(4, 2);
  points << 0., 1., .5, -1., 2., .3, 1., 1.;
  const BSpline spline(3, points, Eigen::Vector4d(1., 2., 2.5, 4.));
  const SplineTrajectory motion(spline), absolute(spline, 0.);
  EXPECT_EQ(motion.duration(), 3.);
  EXPECT_EQ(absolute.duration(), 4.);
  for (const double t : {0., .3, 1., 1.7, 2.9999}) {
    const MotionState state = motion.eval(t);
    EXPECT_EQ(state.q, spline.eval(1. + t)) << t;
    EXPECT_EQ(state.velocity, spline.eval(1. + t, 1)) << t;
    EXPECT_EQ(state.acceleration, spline.eval(1. + t, 2)) << t;
    EXPECT_EQ(absolute.eval(1. + t).q, state.q) << t;
  }
  EXPECT_LT((motion.eval(3.).acceleration - spline.eval(4. - 1e-9, 2)).norm(), 1e-6);  // the left-hand limit
  EXPECT_EQ(motion.eval(-1.).q, spline.eval(1.));
  EXPECT_EQ(motion.eval(9.).q, spline.eval(4.));
  EXPECT_EQ(absolute.eval(.5).velocity, VectorXd::Zero(2));
  expectError<ValueError>([] { SplineTrajectory empty{BSpline()}; }, {"no control points"});
  expectError<ValueError>([&] { SplineTrajectory(spline, 5.); }, {"ends at 4 s, before the origin, 5 s"});
  expectError<ValueError>([&] { motion.eval(NAN); }, {"t is NaN"});
}

TEST(Trajectory, OfSamplesPassesThroughThemToTheBit) {
  const MotionStates samples = Swing().sample(7.3);
  const SampledTrajectory motion(samples);
  EXPECT_EQ(motion.duration(), 2.);
  const MotionStates again = motion.eval(samples.times);
  EXPECT_EQ(again.q, samples.q);
  EXPECT_EQ(again.velocity, samples.velocity);
  EXPECT_EQ(again.acceleration, samples.acceleration);
  Rng rng(0);
  for (int i = 0; i < 100; ++i) {
    const double t = rng.uniform(.01, 1.99);
    expectConsistent(motion, t, 1e-6);
    EXPECT_LT((motion.eval(t).q - Swing().eval(t).q).norm(), 1e-8) << t;
    EXPECT_LT((motion.eval(t).velocity - Swing().eval(t).velocity).norm(), 1e-6) << t;
    EXPECT_LT((motion.eval(t).acceleration - Swing().eval(t).acceleration).norm(), 1e-4) << t;
  }
  EXPECT_EQ(motion.eval(5.).q, Swing().eval(2.).q);
}

TEST(Trajectory, OfSamplesNeedsTimesThatIncreaseFromZeroAndFiniteStates) {
  const MatrixXd q = MatrixXd::Zero(2, 3);
  expectError<ValueError>([&] { SampledTrajectory({VectorXd(), q, q, q}); }, {"there are no samples"});
  expectError<ValueError>([&] { SampledTrajectory({Eigen::Vector2d(1., 2.), q, q, q}); }, {"first time is 1 s"});
  expectError<ValueError>(
      [&] {
        SampledTrajectory({Eigen::Vector2d(0., 0.), q, q, q});
      },
      {"times[1] is 0 s; expected a number above 0"});
  expectError<ValueError>(
      [&] {
        SampledTrajectory({Eigen::Vector2d(0., 1.), q, MatrixXd::Zero(2, 2), q});
      },
      {"velocity has shape (2, 2); expected (2, 3)"});
  expectError<ValueError>(
      [&] {
        SampledTrajectory({Eigen::Vector2d(0., 1.), q, q, MatrixXd::Constant(2, 3, NAN)});
      },
      {"acceleration has numbers that are not finite"});
  expectError<ValueError>([] { SampledTrajectory().eval(0.); }, {"no samples"});
}

TEST(Trajectory, OfARetimedPathIsItsMotion) {
  MatrixXd path(3, 2);
  path << 0., 0., 1., .3, .4, 1.;
  const TimedPath timed = retime(path, {VectorXd::Constant(2, 1.), VectorXd::Constant(2, 3.), {}});
  const Trajectory& motion = timed;
  const MotionStates samples = motion.sample(50.);
  EXPECT_EQ(samples.times[samples.times.size() - 1], timed.duration());
  EXPECT_EQ(VectorXd(samples.q.row(0)), VectorXd(path.row(0)));
  EXPECT_LT((VectorXd(samples.q.bottomRows(1).transpose()) - VectorXd(path.row(2))).norm(), 1e-12);
  expectError<ValueError>([&] { motion.eval(NAN); }, {"TimedPath::eval: t is NaN"});
}

TEST(TrajectoryCsvTest, ReadGivesTheSamplesToTheBit) {
  const std::string file = testing::TempDir() + "/swing.csv";
  Swing().writeCsv(file, 50., {"a", "b"});
  const SampledTrajectory back = SampledTrajectory::read(file);
  const MotionStates expected = Swing().sample(50.);
  EXPECT_EQ(back.samples().times, expected.times);
  EXPECT_EQ(back.samples().q, expected.q);
  EXPECT_EQ(back.samples().velocity, expected.velocity);
  EXPECT_EQ(back.samples().acceleration, expected.acceleration);
  std::ifstream in(file);
  std::string names;
  std::getline(in, names);
  EXPECT_EQ(names, "time,a,b,a_velocity,b_velocity,a_acceleration,b_acceleration");
}

TEST(TrajectoryCsvTest, ErrorsHaveTheirPlace) {
  const std::string file = testing::TempDir() + "/wrong.csv";
  const auto write = [&](const char* text) { std::ofstream(file) << text; };
  const auto read = [&] { (void)SampledTrajectory::read(file); };
  expectError<ValueError>([] { Swing().writeCsv("x.csv", 50., {"a"}); }, {"1 names", "2 dofs"});
  expectError<FileError>([] { Swing().writeCsv("/no_such_folder/x.csv"); }, {"cannot write"});
  expectError<FileError>([] { (void)SampledTrajectory::read("/no_such_file.csv"); }, {"cannot open"});
  write("time,a\n0,1\n.1,2\n");
  expectError<ParseError>(read, {":2:1", "2 numbers", "retime"});
  write("0,1,0,0\n.1,x,0,0\n");
  expectError<ParseError>(read, {":2:4", "not a finite number"});
  write("0,1,0,0\n.1,1,0,0,3,4,5\n");
  expectError<ParseError>(read, {":2:1", "7 numbers"});
  write("");
  expectError<ParseError>(read, {"no rows"});
  write("0,1,0,0\n0,1,0,0\n");
  expectError<ValueError>(read, {"times[1]"});
}
