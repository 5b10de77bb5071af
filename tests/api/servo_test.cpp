#include "kinegraph/api/robot_motion.h"

#include <gtest/gtest.h>

#include "kinegraph/api/names.h"
#include "tests/support/expect_error.h"

namespace kinegraph {
namespace {

class Servo : public ::testing::Test {
 protected:
  void SetUp() override {
    config.addText(
        "base: { }\n x (base): { joint: transX, limits: [-1 1] }\n y (x): { joint: transY, limits: [-1 1] }\n"
        "target: { }");
    ik.emplace(config, DiffIkOptions{.velocity = VectorXd::Constant(2, 2.)});
    ik->addTask(FeatureSymbol::positionDiff, {"y", "target"});
    options.realtime = false;
    options.seconds = .5;
  }
  Vector3d hand() { return config.getFrame("y").getPosition(); }

  Config config;
  std::optional<DiffIk> ik;
  ServoOptions options;
};

TEST_F(Servo, FollowsAFileOrAFunction) {
  servo(*ik, config, "target", TargetFile::fromText("0, 0, 0, 0\n.4, .2, .1, 0\n"), options);
  EXPECT_TRUE(hand().isApprox(Vector3d(.2, .1, 0.), 1e-3));
  servo(
      *ik, config, "target", [](double t) { return Vector3d(.2 - .2 * t, .1, 0.); }, options);
  EXPECT_TRUE(hand().isApprox(Vector3d(.1, .1, 0.), 1e-2));
}

TEST_F(Servo, ByHandItShowsTheScene) {
  int shown = 0;
  options.view = [&](Config& scene) {
    ++shown;
    scene.getFrame("target").setPosition(Vector3d(.05, 0., 0.));
  };
  servo(*ik, config, "target", options);
  EXPECT_NEAR(shown, 15, 1);
  EXPECT_TRUE(hand().isApprox(Vector3d(.05, 0., 0.), 1e-3));
  options.show = false;
  servo(*ik, config, "target", options);
  EXPECT_NEAR(shown, 15, 1);
}

TEST_F(Servo, MistakesAreNamed) {
  const auto still = [](double) { return Vector3d::Zero(); };
  expectError<FrameNotFound>([&] { servo(*ik, config, "traget", still, options); }, {"traget", "target"});
  expectError<ValueError>(
      [&] {
        servo(
            *ik, config, "target", [](double) { return VectorXd(2); }, options);
      },
      {"2 numbers"});
  options.dt = 0.;
  expectError<ValueError>([&] { servo(*ik, config, "target", still, options); }, {"dt is 0"});
}

}  // namespace
}  // namespace kinegraph
