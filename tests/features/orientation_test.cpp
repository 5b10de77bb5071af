#include "kinegraph/features/orientation.h"

#include <gtest/gtest.h>

#include "tests/features/worked_scene.h"

using namespace kinegraph;

namespace {

const double kHalfRoot = std::sqrt(.5), kHalfRoot3 = std::sqrt(.75);

/// The nearer of y and -y.
VectorXd signFree(const VectorXd& y, const VectorXd& expected) { return y.dot(expected) < 0. ? VectorXd(-y) : y; }

}  // namespace

TEST(Orientation, IsAQuaternionOfTheRotationInTheWorld) {
  const VectorXd expected = numbers({kHalfRoot, 0, 0, kHalfRoot});
  EXPECT_TRUE(near(signFree(value(workedScene(), "quaternion", {"A"}), expected), expected, 1e-12));
}

TEST(Orientation, RelativeToAnotherFrameIsTheRotationSeenFromThere) {
  const VectorXd expected = numbers({-.6830127, -.1830127, .1830127, .6830127});
  EXPECT_TRUE(near(signFree(value(workedScene(), "quaternionRel", {"B", "A"}), expected), expected, 1e-7));
}

TEST(Orientation, DifferencesTakeTheNearerSign) {
  Config config = workedScene();
  EXPECT_TRUE(near(value(config, "quaternionDiff", {"A", "B"}), numbers({-.258819, -.258819, 0, .707107}), 1e-6));
  config.addText("E: { X: [0 0 0 -.70710678 0 0 -.70710678] }");
  EXPECT_TRUE(near(value(config, "quaternionDiff", {"A", "E"}), VectorXd::Zero(4), 1e-8));
}

TEST(Orientation, PosesAreAPositionAndAQuaternion) {
  const Config config = workedScene();
  const std::vector<std::vector<std::string>> frames = {{"A"}, {"A", "B"}, {"B", "A"}};
  const char* names[][3] = {{"pose", "position", "quaternion"},
                            {"poseDiff", "positionDiff", "quaternionDiff"},
                            {"poseRel", "positionRel", "quaternionRel"}};
  for (int i = 0; i < 3; ++i) {
    const VectorXd pose = value(config, names[i][0], frames[i]);
    EXPECT_EQ(pose.head(3), value(config, names[i][1], frames[i])) << names[i][0];
    EXPECT_EQ(pose.tail(4), value(config, names[i][2], frames[i])) << names[i][0];
  }
}

TEST(Axis, IsAColumnOfTheRotation) {
  const Config config = workedScene();
  EXPECT_TRUE(near(value(config, "vectorX", {"A"}), numbers({0, 1, 0}), 1e-14));
  EXPECT_TRUE(near(value(config, "vectorY", {"A"}), numbers({-1, 0, 0}), 1e-14));
  EXPECT_TRUE(near(value(config, "vectorZ", {"B"}), numbers({0, -.5, kHalfRoot3}), 1e-14));
  EXPECT_TRUE(near(value(config, "vectorXDiff", {"A", "B"}), numbers({-1, 1, 0}), 1e-14));
  EXPECT_TRUE(near(value(config, "vectorXRel", {"B", "A"}), numbers({0, -1, 0}), 1e-14));
}

TEST(AxisProduct, FirstLetterBelongsToTheFirstFrame) {
  const Config config = workedScene();
  const auto product = [&](const char* letters) {
    return value(config, (std::string("scalarProduct") + letters).c_str(), {"A", "B"})[0];
  };
  EXPECT_NEAR(product("XX"), 0., 1e-14);
  EXPECT_NEAR(product("XY"), kHalfRoot3, 1e-14);
  EXPECT_NEAR(product("YX"), -1., 1e-14);
  EXPECT_NEAR(product("YZ"), 0., 1e-14);
  for (const char* a : {"X", "Y", "Z"}) {
    for (const char* b : {"X", "Y", "Z"}) {
      const VectorXd u = value(config, (std::string("vector") + a).c_str(), {"A"}),
                     v = value(config, (std::string("vector") + b).c_str(), {"B"});
      EXPECT_NEAR(product((std::string(a) + b).c_str()), u.dot(v), 1e-14) << a << b;
    }
  }
}
