#include "kinegraph/features/position.h"

#include <gtest/gtest.h>

#include "tests/features/worked_scene.h"

using namespace kinegraph;

TEST(Position, OfFramesAtRestIsWhatTheirPosesSay) {
  const Config config = workedScene();
  EXPECT_TRUE(near(value(config, "position", {"A"}), numbers({1, 2, 3}), 1e-14));
  EXPECT_TRUE(near(value(config, "positionDiff", {"B", "A"}), numbers({.5, 0, 0}), 1e-14));
  EXPECT_TRUE(near(value(config, "positionDiff", {"A", "B"}), numbers({-.5, 0, 0}), 1e-14));
  EXPECT_TRUE(near(value(config, "positionRel", {"B", "A"}), numbers({0, -.5, 0}), 1e-14));
}

TEST(Position, InACameraIsTheFirstTwoOfItsCoordinates) {
  const Config config = workedScene();
  EXPECT_TRUE(near(value(config, "gazeAt", {"B", "A"}), numbers({0, -.5}), 1e-14));
  EXPECT_TRUE(near(value(config, "gazeAt", {"A", "B"}), numbers({-.5, 0}), 1e-14));
}

TEST(Position, TipOfABentTwoLinkArmIsWhereTrigonometryPutsIt) {
  Config config;
  config.addText(
      "base: {}  a(base): { joint: hingeZ }  b(a): { pre: [1 0 0], joint: hingeZ }  tip(b): { Q: [.5 0 0] }");
  config.setJointState(numbers({.3, .7}));
  const Evaluation at = eval(config, FeatureSymbol::position, {"tip"});
  const double x = std::cos(.3) + .5 * std::cos(1.), y = std::sin(.3) + .5 * std::sin(1.);
  EXPECT_TRUE(near(at.y, numbers({x, y, 0}), 1e-14));
  const MatrixXd J = (MatrixXd(3, 2) << -y, -.5 * std::sin(1.), x, .5 * std::cos(1.), 0., 0.).finished();
  EXPECT_TRUE(near(at.J, J, 1e-14));
}

TEST(Position, OfThePandasGripperAgreesWithTheReference) {
  Config config;
  config.addFile(std::string(KINEGRAPH_SOURCE_DIR) + "/models/scenarios/pandaSingle.g");
  const Evaluation at = eval(config, FeatureSymbol::position, {"l_gripper"});
  EXPECT_TRUE(near(at.y, numbers({0, .276251, 1.266783}), 1e-6));
  EXPECT_TRUE(near(at.J.col(0), numbers({-.476251, 0, 0}), 1e-6));
}
