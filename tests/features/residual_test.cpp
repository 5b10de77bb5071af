#include "kinegraph/features/residual.h"

#include <gtest/gtest.h>

#include "kinegraph/features/make_residual.h"
#include "tests/features/slices.h"
#include "tests/features/worked_scene.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

MatrixXd row(std::initializer_list<double> values) { return numbers(values).transpose(); }

VectorXd scaled(const Config& config, FeatureSymbol symbol, const std::vector<std::string>& frames,
                const MatrixXd& scale, const VectorXd& target = {}) {
  return eval(config, symbol, frames, scale, target).y;
}

/// A frame rotated by raw quaternions of any length and sign.
Config ball() {
  Config config;
  config.addText("base: {}  ball(base): { joint: quatBall }  slide(base): { joint: transX }");
  return config;
}

}  // namespace

TEST(Residual, SubtractsTheTargetFirstAndScalesThen) {
  const Config config = workedScene();
  const auto position = FeatureSymbol::position;
  EXPECT_TRUE(near(scaled(config, position, {"A"}, row({2})), numbers({2, 4, 6}), 1e-14));
  EXPECT_TRUE(near(scaled(config, position, {"A"}, row({2}), numbers({1, 1, 1})), numbers({0, 2, 4}), 1e-14));
  EXPECT_TRUE(near(scaled(config, position, {"A"}, {}, numbers({1})), numbers({0, 1, 2}), 1e-14));
  EXPECT_TRUE(near(scaled(config, position, {"A"}, numbers({1, 0, -1})), numbers({1, 0, -3}), 1e-14));
  EXPECT_TRUE(near(scaled(config, position, {"A"}, row({1, 0, -1})), numbers({-2}), 1e-14));  // one row is a matrix
  const MatrixXd matrix = (MatrixXd(2, 3) << 1, 1, 1, 0, 2, 0).finished();
  EXPECT_TRUE(near(scaled(config, position, {"A"}, matrix, numbers({0, 0, 1})), numbers({5, 4}), 1e-14));
}

TEST(Residual, ScalesWhatACameraSeesInTwoRows) {
  const Config config = workedScene();
  EXPECT_TRUE(near(scaled(config, FeatureSymbol::gazeAt, {"B", "A"}, numbers({3, 2})), numbers({0, -1}), 1e-14));
}

TEST(Residual, TakesTheSignOfAQuaternionThatIsNearerToTheTarget) {
  const Config config = workedScene();
  EXPECT_TRUE(
      near(value(config, "quaternion", {"A"}, numbers({-1, 0, 0, 0})), numbers({.292893, 0, 0, -.707107}), 1e-6));
  EXPECT_TRUE(
      near(value(config, "quaternion", {"A"}, numbers({1, 0, 0, 0})), numbers({-.292893, 0, 0, .707107}), 1e-6));
  EXPECT_TRUE(near(value(config, "quaternionRel", {"A", "A"}, numbers({-1, 0, 0, 0})), VectorXd::Zero(4), 1e-12));
  const VectorXd pose = value(config, "pose", {"A"}, numbers({0, 0, 0, -1, 0, 0, 0}));
  EXPECT_TRUE(near(pose, numbers({1, 2, 3, .292893, 0, 0, -.707107}), 1e-6));
}

TEST(Residual, DifferencesAlignTheSignsOfQuaternions) {
  const Config config = ball();
  const auto at = [](double angle, double sign) {
    return numbers({sign * std::cos(.5 * angle), 0, 0, sign * std::sin(.5 * angle), 0.});
  };
  Residual velocity = makeResidual(config.state(), FeatureSymbol::quaternion, {"ball"}, {}, {}, 1);
  const VectorXd same = overSlices(config, velocity, {at(3.0, 1.), at(3.3, 1.)}, .5);
  EXPECT_NEAR(same.norm(), 2. * std::sin(.075) / .5, 1e-12) << "across the angle where w changes its sign";
  EXPECT_TRUE(near(overSlices(config, velocity, {at(3.0, 1.), at(3.3, -1.)}, .5).cwiseAbs(), same.cwiseAbs(), 1e-12));
  Residual acceleration = makeResidual(config.state(), FeatureSymbol::pose, {"ball"}, {}, {}, 2);
  EXPECT_LT(overSlices(config, acceleration, {at(3.0, 1.), at(3.14, -1.), at(3.28, 1.)}, 1.).norm(), .01);
}

TEST(Residual, OrdersAreBackwardDifferencesOverTheLastDuration) {
  const Config config = ball();
  const auto at = [](double x) { return numbers({1, 0, 0, 0, x}); };
  Residual velocity = makeResidual(config.state(), FeatureSymbol::qItself, {"slide"}, {}, {}, 1);
  Residual acceleration = makeResidual(config.state(), FeatureSymbol::qItself, {"slide"}, {}, {}, 2);
  Residual jerk = makeResidual(config.state(), FeatureSymbol::qItself, {"slide"}, {}, {}, 3);
  EXPECT_NEAR(overSlices(config, velocity, {at(1), at(4)}, .5)[0], 6., 1e-14);
  EXPECT_NEAR(overSlices(config, acceleration, {at(1), at(4), at(9)}, .5)[0], 8., 1e-14);
  EXPECT_NEAR(overSlices(config, jerk, {at(0), at(1), at(8), at(27)}, 1.)[0], 6., 1e-13);
}

TEST(Residual, OfATimeIntegralDividesOnceByTheRootOfTheDuration) {
  const Config config = ball();
  const auto at = [](double x) { return numbers({1, 0, 0, 0, x}); };
  Residual velocity = makeResidual(config.state(), FeatureSymbol::qItself, {"slide"}, {}, {}, 1);
  velocity.setTimeIntegral(true);
  EXPECT_NEAR(overSlices(config, velocity, {at(1), at(4)}, .25)[0], 6., 1e-13);
  Residual acceleration = makeResidual(config.state(), FeatureSymbol::qItself, {"slide"}, {}, {}, 2);
  acceleration.setTimeIntegral(true);
  EXPECT_NEAR(overSlices(config, acceleration, {at(1), at(4), at(9)}, .25)[0], 2. / std::pow(.25, 1.5), 1e-12);
}

TEST(Residual, ScalesAndTargetsOfAWrongSizeSayWhatWasExpected) {
  const Config config = workedScene();
  const auto position = FeatureSymbol::position;
  expectError<ValueError>(
      [&] {
        scaled(config, position, {"A"}, row({1, 2}));
      },
      {"scale of position", "1 x 2", "3 numbers"});
  expectError<ValueError>([&] { scaled(config, position, {"A"}, MatrixXd::Ones(3, 4)); },
                          {"scale of position", "3 x 4", "3 columns"});
  expectError<ValueError>(
      [&] {
        scaled(config, position, {"A"}, {}, numbers({1, 2}));
      },
      {"target of position", "2 numbers", "3"});
  expectError<ValueError>([&] { scaled(config, position, {"A"}, row({NAN})); }, {"scale of position", "not finite"});
  expectError<ValueError>([&] { scaled(config, position, {"A"}, {}, numbers({INFINITY})); },
                          {"target of position", "not finite"});
}

TEST(Residual, AnOrderBelowTheFeaturesOwnIsAnError) {
  const Config config = ball();
  expectError<ValueError>([&] { makeResidual(config.state(), FeatureSymbol::linangVel, {"ball"}, {}, {}, 0); },
                          {"linangVel", "at least 1", "got 0"});
}
