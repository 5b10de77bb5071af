#include "kinegraph/komo/objective.h"

#include <gtest/gtest.h>

#include "kinegraph/common/errors.h"
#include "kinegraph/features/residual.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

Config scene() {
  Config config;
  config.addText(R"(
    world: {}
    arm (world): { joint: hingeZ, limits: [-1, 2], q: .5 }
    slide (arm): { joint: transX, limits: [-3, 4], q: .25 }
    box (world): { Q: [1, 1, 0], shape: ssBox, size: [.1, .1, .1, .01], mass: 2 }
  )");
  return config;
}

Path twoSlices() {
  Path path;
  path.setScene(scene());
  path.setGrid(TimeGrid(2., 1, 1., 0));
  return path;
}

VectorXd valueIn(const Objective& objective, const Path& path, int slice) {
  Residual residual = residualIn(objective, path, {}, slice);
  const State* state = &path.state(slice);
  VectorXd y(residual.rows());
  residual.eval({&state, 1}, 1., y, nullptr);
  return y;
}

}  // namespace

TEST(Objective, JointFeaturesUseTheInitialJointsInAllModes) {
  Path path = twoSlices();
  const Objective joints{.feature = FeatureSymbol::qItself, .type = ObjectiveType::sos};
  const Objective limits{.feature = FeatureSymbol::jointLimits, .type = ObjectiveType::ineq};
  const VectorXd q = Eigen::Vector2d(.5, .25), within = Eigen::Vector4d(-1.5, -3.25, -1.5, -3.75);
  EXPECT_EQ(valueIn(joints, path, 1), q);
  const VectorXd plain = valueIn(limits, path, 1);
  path.beginModes();
  Attachment free;
  free.type = JointType::trans3;
  path.attach(1, "arm", "box", free);
  EXPECT_EQ(path.state(1).dofs(), 5);
  EXPECT_EQ(valueIn(joints, path, 1), q);
  EXPECT_EQ(valueIn(limits, path, 1), plain);  // bounds limit added joints
  EXPECT_EQ(plain.size(), within.size());
  EXPECT_NEAR(plain.sum(), within.sum(), 1e-12);
}

TEST(Objective, AJointThatASwitchReplacedIsNamed) {
  Path path = twoSlices();
  path.beginModes();
  path.attach(1, "world", "slide", {});
  const Objective joints{.feature = FeatureSymbol::qItself, .type = ObjectiveType::sos};
  EXPECT_EQ(valueIn(joints, path, 0).size(), 2);
  expectError<ValueError>([&] { valueIn(joints, path, 1); }, {"'slide'", "replaced by a mode switch", "slice 1"});
  const Objective of_box{.feature = FeatureSymbol::qItself, .frames = {"box"}, .type = ObjectiveType::sos};
  expectError<ValueError>([&] { valueIn(of_box, path, 0); }, {"'box' is not there, or not active in slice 0"});
}

TEST(Objective, ForcesCountWhereTheyAre) {
  Path path = twoSlices();
  const Objective balance{.feature = FeatureSymbol::totalForce, .frames = {"box"}, .type = ObjectiveType::eq};
  EXPECT_NEAR(valueIn(balance, path, 1)[2], 2. * 9.81, 1e-12);  // no contact force
}
