#include "kinegraph/features/masses.h"

#include <gtest/gtest.h>

#include "kinegraph/features/make_residual.h"
#include "tests/features/slices.h"
#include "tests/features/worked_scene.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

/// A body of 2 kg that moves freely, its center of mass at its origin, and one of 1 kg at rest.
Config bodies() {
  Config config;
  config.addText(R"g(
    world: {}
    body(world): { joint: free, q: [0 0 1 1 0 0 0], mass: 2 }
    part(body): { Q: "t(.5 0 0)", mass: 1 }
    light(body): { Q: "t(0 .5 0)" }
    ground: { X: "t(.25 1 0)", mass: 3 }
  )g");
  return config;
}

/// The joint vectors of a body at heights, without rotation.
std::vector<VectorXd> heights(std::initializer_list<double> z) {
  std::vector<VectorXd> q;
  for (double height : z) q.push_back(numbers({0., 0., height, 1., 0., 0., 0.}));
  return q;
}

constexpr double kSliceTime = .1;

}  // namespace

TEST(Energy, OfABodyAtRestIsThatOfItsHeight) {
  const Config config = bodies();
  Residual energy = makeResidual(config.state(), FeatureSymbol::energy, {"body"});
  EXPECT_EQ(energy.order(), 1);
  EXPECT_TRUE(near(overSlices(config, energy, heights({1., 1.}), kSliceTime), numbers({19.62}), 1e-12));
}

TEST(Energy, AddsHalfTheMassTimesTheSquaredVelocity) {
  const Config config = bodies();
  Residual energy = makeResidual(config.state(), FeatureSymbol::energy, {"body", "light"});
  const double v = .2 / kSliceTime;
  EXPECT_TRUE(near(overSlices(config, energy, heights({1., 1.2}), kSliceTime),
                   numbers({3. * (.5 * v * v + 9.81 * 1.2)}), 1e-12));
}

TEST(Energy, FollowsTheMass) {
  Config config = bodies();
  Residual energy = makeResidual(config.state(), FeatureSymbol::energy, {"body"});
  config.getFrame("body").setMass(5.);
  EXPECT_TRUE(near(overSlices(config, energy, heights({1., 1.}), kSliceTime), numbers({5. * 9.81}), 1e-12));
}

TEST(Physics, IsGravityTimesTauAtRestInFreeSpace) {
  const Config config = bodies();
  Residual physics = makeResidual(config.state(), FeatureSymbol::physics, {"body"});
  EXPECT_EQ(physics.order(), 2);
  EXPECT_TRUE(
      near(overSlices(config, physics, heights({1., 1., 1.}), kSliceTime), numbers({0., 0., .981, 0., 0., 0.}), 1e-12));
}

TEST(Physics, IsZeroInFreeFall) {
  const Config config = bodies();
  Residual physics = makeResidual(config.state(), FeatureSymbol::physics, {"body"});
  const auto height = [](double t) { return 1. + 2. * t - 9.81 / 2. * t * t; };
  EXPECT_TRUE(
      near(overSlices(config, physics, heights({height(0.), height(kSliceTime), height(2. * kSliceTime)}), kSliceTime),
           VectorXd(VectorXd::Zero(6)), 1e-12));
}

TEST(EqCenterOfMass, IsAFramesOffsetFromTheCommonCenterOfTheOthers) {
  const Config config = bodies();
  EXPECT_TRUE(
      near(value(config, "EqCenterOfMass", {"ground", "body", "part"}), numbers({.25 - .5 / 3., 1., -1.}), 1e-12));
  EXPECT_TRUE(near(value(config, "EqCenterOfMass", {"ground", "body", "light"}), numbers({.25, 1., -1.}), 1e-12));
}

TEST(EqCenterOfMass, OfOneFrameIsItsOffsetFromEverythingThatMoves) {
  const Config config = bodies();
  EXPECT_TRUE(near(value(config, "EqCenterOfMass", {"ground"}), numbers({.25 - .5 / 3., 1., -1.}), 1e-12));
  const VectorXd center = config.centerOfMass().second;
  EXPECT_TRUE(near(value(config, "EqCenterOfMass", {"ground"}),
                   VectorXd(config.getFrame("ground").getPose().p - center), 1e-12));
}

TEST(EqCenterOfMass, WithoutAnyMassIsAnErrorThatSaysSo) {
  const Config config = bodies();
  expectError<ValueError>(
      [&] {
        value(config, "EqCenterOfMass", {"body", "light"});
      },
      {"EqCenterOfMass of 'body'", "has a mass"});
  expectError<ValueError>([&] { value(workedScene(), "EqCenterOfMass", {"A"}); }, {"nothing that moves has a mass"});
}
