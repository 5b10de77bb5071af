#include "kinegraph/trajectories/curve_part.h"

#include <gtest/gtest.h>

#include "kinegraph/common/random.h"
#include "kinegraph/trajectories/retime.h"

namespace kinegraph {
namespace {

PathCurve someCurve(bool smooth) {
  MatrixXd points(5, 3);
  Rng rng(3);
  for (double& value : points.reshaped()) value = rng.uniform(-1., 1.);
  return blendedPolyline(points, {.2, smooth, {}});
}

TEST(CurvePart, IsTheWholeCurveBetweenItsEnds) {
  for (const bool smooth : {false, true}) {
    const PathCurve curve = someCurve(smooth);
    const double from = .23 * curve.length(), to = .81 * curve.length();
    const CurvePart part = partOf(curve, from, to);
    EXPECT_DOUBLE_EQ(part.curve.length(), to - from);
    for (int order = 0; order <= 2; ++order)
      for (double s = 1e-3; s < to - from; s += .013)
        EXPECT_TRUE(part.curve.eval(s, order).isApprox(curve.eval(from + s, order), 1e-9)) << s << " " << order;
  }
}

TEST(CurvePart, ATimeScalingAlongItIsOneAlongTheWhole) {
  const PathCurve curve = someCurve(false);
  const CurvePart part = partOf(curve, .4 * curve.length(), .9 * curve.length());
  const MotionLimits limits{VectorXd::Constant(3, 1.), VectorXd::Constant(3, 2.), {}};
  const TimedPath timed = retime(MatrixXd(), part.curve, limits);
  const TimeScaling scaling = part.onWhole(timed.scaling());
  for (double t = 0.; t < scaling.duration(); t += .01) {
    const MotionState whole = motionAt(curve, scaling, t), own = timed.eval(t);
    EXPECT_TRUE(whole.q.isApprox(own.q, 1e-9)) << t;
    EXPECT_LE((whole.velocity - own.velocity).norm(), 1e-9) << t;
  }
}

TEST(CurvePart, TheRestOfATimeScalingIsItFromThenOn) {
  for (const bool smooth : {false, true}) {
    const PathCurve curve = someCurve(smooth);
    MotionLimits limits{VectorXd::Constant(3, 1.), VectorXd::Constant(3, 2.), {}};
    if (smooth) limits.jerk = VectorXd::Constant(3, 30.);
    const TimedPath timed = retime(MatrixXd(), curve, limits);
    for (const double time : {.1, .41 * timed.duration(), .9 * timed.duration()}) {
      const ScalingPhase& phase = timed.scaling().phaseAt(time);
      const CurvePart part = partOf(curve, phase.at(time - phase.time).s, curve.length());
      const TimeScaling rest = part.restOf(timed.scaling(), time);
      EXPECT_NEAR(rest.duration(), timed.duration() - time, 1e-12);
      for (double t = 0.; t < rest.duration(); t += .01) {
        const MotionState now = motionAt(part.curve, rest, t), then = timed.eval(time + t);
        EXPECT_LE((now.q - then.q).norm(), 1e-9) << t;
        EXPECT_LE((now.velocity - then.velocity).norm(), 1e-9) << t;
        EXPECT_LE((now.acceleration - then.acceleration).norm(), 1e-7) << t;
      }
    }
  }
}

TEST(CurvePart, JoinedCurvesStopWhereTheyMeet) {
  const PathCurve curve = someCurve(false);
  const double at = .37 * curve.length();
  const PathCurve both = joined(partOf(curve, 0., at).curve, partOf(curve, at, curve.length()).curve);
  EXPECT_NEAR(both.length(), curve.length(), 1e-12);
  for (double s = 0.; s < curve.length(); s += .017) EXPECT_TRUE(both.eval(s).isApprox(curve.eval(s), 1e-9)) << s;
  EXPECT_EQ(both.marks().size(), 3u);
  const MotionLimits limits{VectorXd::Constant(3, 1.), VectorXd::Constant(3, 2.), {}};
  const TimedPath timed = retime(MatrixXd(), both, limits);
  EXPECT_LE(timed.eval(timed.times[1]).velocity.norm(), 1e-9);
}

TEST(CurvePart, AReversedMotionTakesTheSameWayBack) {
  for (const bool smooth : {false, true}) {
    MotionLimits limits{VectorXd::Constant(3, 1.), VectorXd::Constant(3, 2.), {}};
    if (smooth) limits.jerk = VectorXd::Constant(3, 20.);
    const TimedPath there = retime(MatrixXd(), someCurve(smooth), limits), back = reversed(there);
    ASSERT_TRUE(there.feasible());
    ASSERT_NEAR(back.duration(), there.duration(), 1e-12);
    for (double t = .0037; t < there.duration(); t += .01) {
      const MotionState a = there.eval(t), b = back.eval(there.duration() - t);
      EXPECT_LE((a.q - b.q).norm(), 1e-9) << t;
      EXPECT_LE((a.velocity + b.velocity).norm(), 1e-7) << t;
      EXPECT_LE((a.acceleration - b.acceleration).norm(), 1e-5) << t;
    }
    EXPECT_TRUE(back.times.isApprox((there.duration() - there.times.reverse().array()).matrix()));
  }
}

}  // namespace
}  // namespace kinegraph
