#include "kinegraph/features/joints.h"

#include <gtest/gtest.h>

#include "tests/features/worked_scene.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

Config robot() {
  Config config;
  config.addText(R"(
    base: {}
    a(base): { joint: hingeX, limits: [-1 2] }
    b(a): { joint: quatBall }
    c(base): { joint: transXY, limits: [-1 -2 1 2] }
    twin(base): { joint: hingeX, mimic: a }
  )");
  config.setJointState(numbers({.1, 1., .5, 0., 0., .3, -.4}));
  return config;
}

}  // namespace

TEST(JointState, IsQWithoutFramesAndTheirDofsWithFrames) {
  const Config config = robot();
  for (const char* name : {"jointState", "qItself"}) {
    EXPECT_EQ(value(config, name, {}), config.getJointState());
    EXPECT_EQ(value(config, name, {"c", "a"}), numbers({.3, -.4, .1}));
    EXPECT_EQ(value(config, name, {"twin"}), numbers({.1}));
  }
  EXPECT_EQ(eval(config, FeatureSymbol::qItself, {}).J, MatrixXd::Identity(7, 7));
  EXPECT_EQ(eval(config, FeatureSymbol::qItself, {"c"}).J, MatrixXd::Identity(7, 7).bottomRows(2));
}

TEST(JointState, OfAFrameWithoutAJointNamesIt) {
  const Config config = robot();
  expectError<ValueError>([&] { value(config, "jointState", {"a", "base"}); }, {"qItself", "'base'", "joint"});
  expectError<ValueError>([&] { value(config, "jointLimits", {"base"}); }, {"jointLimits", "'base'", "joint"});
}

TEST(JointLimits, HaveTwoRowsPerLimitedDof) {
  const Config config = robot();
  EXPECT_TRUE(near(value(config, "jointLimits", {}), numbers({-1.1, -1.9, -1.3, -.7, -1.6, -2.4}), 1e-15));
  EXPECT_TRUE(near(value(config, "jointLimits", {"c"}), numbers({-1.3, -.7, -1.6, -2.4}), 1e-15));
  EXPECT_EQ(value(config, "jointLimits", {"b"}).size(), 0);
}

TEST(JointLimits, OfThePandaAgreeWithTheReference) {
  Config config;
  config.addFile(std::string(KINEGRAPH_SOURCE_DIR) + "/models/scenarios/pandaSingle.g");
  const VectorXd y = value(config, "jointLimits", {});
  ASSERT_EQ(y.size(), 14);
  EXPECT_TRUE(near(y.head(4), numbers({-2.8973, -2.8973, -1.2628, -2.2628}), 1e-9));
}

TEST(QuaternionNorms, AreZeroForUnitQuaternionsOnly) {
  Config config = robot();
  EXPECT_TRUE(near(value(config, "qQuaternionNorms", {}), numbers({.25}), 1e-15));
  config.setJointState(numbers({.1, .8, .6, 0., 0., .3, -.4}));
  EXPECT_TRUE(near(value(config, "qQuaternionNorms", {}), numbers({0.}), 1e-15));
}
