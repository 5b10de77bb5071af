#include "kinegraph/features/velocity.h"

#include <gtest/gtest.h>

#include "kinegraph/features/make_residual.h"
#include "tests/features/slices.h"
#include "tests/features/worked_scene.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

/// Value of a feature over consecutive joint vectors of a scene, `tau` seconds apart.
VectorXd over(const Config& config, const char* feature, const std::vector<std::string>& frames,
              const std::vector<VectorXd>& q, double tau, int order = -1) {
  Residual residual = makeResidual(config.state(), featureSymbolFromName(feature), frames, {}, {}, order);
  return overSlices(config, residual, q, tau);
}

Config wheel() {
  Config config;
  config.addText(
      "base: {}  wheel(base): { pre: [1 2 3], joint: hingeZ }  rim(wheel): { Q: [.5 0 0] }  flyer(base): { joint: "
      "trans3 }");
  return config;
}

VectorXd turned(double angle) { return numbers({angle, 0, 0, 0}); }

}  // namespace

TEST(AngularVelocity, IsTwiceTheSineOfHalfTheRotationAngle) {
  const Config config = wheel();
  EXPECT_TRUE(near(over(config, "angularVel", {"rim"}, {turned(0), turned(.5)}, 1.), numbers({0, 0, .4948079}), 1e-7));
  EXPECT_TRUE(near(over(config, "angularVel", {"rim"}, {turned(.5), turned(0)}, .1), numbers({0, 0, -4.948079}), 1e-6));
}

TEST(AngularVelocity, TakesTheShorterArc) {
  const Config config = wheel();
  const double shorter = -2. * std::sin(.5 * (2. * M_PI - 6.));
  EXPECT_TRUE(near(over(config, "angularVel", {"rim"}, {turned(-3), turned(3)}, 1.), numbers({0, 0, shorter}), 1e-12));
}

TEST(AngularVelocity, OfOrderTwoIsItsDifference) {
  const Config config = wheel();
  const double first = 2. * std::sin(.1), second = 2. * std::sin(.2);
  const VectorXd y = over(config, "angularVel", {"rim"}, {turned(0), turned(.2), turned(.6)}, .5, 2);
  EXPECT_TRUE(near(y, numbers({0, 0, (second - first) / .25}), 1e-12));
}

TEST(LinearVelocity, OfLinangVelIsThatOfTheOrigin) {
  const Config config = wheel();
  const VectorXd y = over(config, "linangVel", {"rim"}, {turned(0), turned(.5)}, .1);
  EXPECT_TRUE(near(y, numbers({5. * (std::cos(.5) - 1.), 5. * std::sin(.5), 0, 0, 0, 20. * std::sin(.25)}), 1e-12));
}

TEST(AlignWithMotion, IsZeroWhereAFrameMovesAlongTheAxis) {
  const Config config = wheel();
  const VectorXd from = numbers({.3, 0, 0, 0});
  const VectorXd along_x = numbers({.9, 2. * std::cos(.3), 2. * std::sin(.3), 0});
  const VectorXd along_y = numbers({.9, -2. * std::sin(.3), 2. * std::cos(.3), 0});
  EXPECT_TRUE(near(over(config, "AlignXWithDiff", {"wheel", "flyer"}, {from, along_x}, 1.), VectorXd::Zero(3), 1e-8));
  EXPECT_TRUE(near(over(config, "AlignYWithDiff", {"wheel", "flyer"}, {from, along_y}, 1.), VectorXd::Zero(3), 1e-8));
  const VectorXd across = over(config, "AlignXWithDiff", {"wheel", "flyer"}, {from, along_y}, 1.);
  EXPECT_NEAR(across.norm(), std::sqrt(2.), 1e-4);
}

TEST(Velocity, OnASingleConfigurationIsAnErrorThatSaysHowManyItTakes) {
  const Config config = wheel();
  for (const char* feature : {"angularVel", "linangVel"}) {
    expectError<ValueError>([&] { value(config, feature, {"rim"}); }, {feature, "2 consecutive configurations"});
    expectError<ValueError>([&] { eval(config, featureSymbolFromName(feature), {"rim"}, {}, {}, 0); },
                            {feature, "got 0"});
  }
  expectError<ValueError>([&] { eval(config, FeatureSymbol::position, {"rim"}, {}, {}, 2); },
                          {"position", "3 consecutive"});
}
