#include "kinegraph/api/batch_queries.h"

#include <gtest/gtest.h>

#include "kinegraph/scene/frame_setters.h"
#include "kinegraph/task_planning/task_actions.h"
#include "tests/support/expect_error.h"

namespace kinegraph {
namespace {

/// A ball on a slider of 1 m, with a wall at x = .5.
Config ballBeforeWall() {
  Config C;
  C.addText(R"(
base: {}
slide (base): { joint: transX, limits: [0 1] }
ball (slide): { shape: sphere, size: [.1], contact: 1 }
wall: { X: [.5 0 0], shape: box, size: [.1 1 1], contact: 1 }
)");
  return C;
}

TEST(BatchQueriesTest, ValidityIsThatOfTheDistanceToTheWall) {
  const Config C = ballBeforeWall();
  EXPECT_TRUE(isValid(C, VectorXd::Constant(1, .34)));
  EXPECT_FALSE(isValid(C, VectorXd::Constant(1, .36)));
  EXPECT_FALSE(isValid(C, VectorXd::Constant(1, .34), .02));
  EXPECT_FALSE(isValid(C, VectorXd::Constant(1, 1.1))) << "beyond the limit";
  RowMatrix Q(3, 1);
  Q << 0., .5, .8;
  EXPECT_EQ(isValid(C, Q), (std::vector<bool>{true, false, true}));
  const RowMatrix distances = getDistances(C, Q);
  EXPECT_NEAR(distances(0, 0), .35, 1e-9);
  EXPECT_NEAR(distances(2, 0), .15, 1e-9);
}

TEST(BatchQueriesTest, MotionsThroughTheWallAreNotFree) {
  const Config C = ballBeforeWall();
  const VectorXd before = VectorXd::Constant(1, .1), near = VectorXd::Constant(1, .3),
                 behind = VectorXd::Constant(1, .9);
  EXPECT_TRUE(isMotionFree(C, before, near));
  EXPECT_FALSE(isMotionFree(C, before, behind));
  RowMatrix from(2, 1), to(2, 1);
  from << .1, .1;
  to << .3, .9;
  EXPECT_EQ(isMotionFree(C, from, to), (std::vector<bool>{true, false}));
}

TEST(BatchQueriesTest, PosesHaveSevenNumbersPerFrame) {
  const Config C = ballBeforeWall();
  RowMatrix Q(2, 1);
  Q << .2, .7;
  const RowMatrix poses = getFramePoses(C, Q, {"ball", "wall"});
  ASSERT_EQ(poses.cols(), 14);
  EXPECT_NEAR(poses(0, 0), .2, 1e-12);
  EXPECT_NEAR(poses(1, 0), .7, 1e-12);
  EXPECT_NEAR(poses(1, 7), .5, 1e-12);
}

TEST(BatchQueriesTest, WrongInputIsNamed) {
  const Config C = ballBeforeWall();
  expectError<ValueError>([&] { isValid(C, VectorXd::Zero(2)); }, {"1 dofs"});
  expectError<ValueError>([&] { isValid(C, VectorXd::Zero(1), NAN); }, {"margin is nan"});
  expectError<ValueError>([&] { isMotionFree(C, RowMatrix::Zero(2, 1), RowMatrix::Zero(1, 1)); },
                          {"2 starts and 1 ends"});
  expectError<FrameNotFound>([&] { getFramePoses(C, RowMatrix::Zero(1, 1), {"bal"}); }, {"ball"});
}

TEST(BatchQueriesTest, AttributesAsTextMakeADrawer) {
  Config C = ballBeforeWall();
  EXPECT_TRUE(doorStates(C).empty());
  Frame slide = C.getFrame("slide");
  EXPECT_TRUE(setAttributes(slide, "logical: { is_drawer }, friction: .5").empty());
  const std::vector<std::string> warnings = setAttributes(slide, "mas: 2");
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0], "setAttributes: frame 'slide': unknown attribute 'mas'; did you mean 'mass'?");
  EXPECT_EQ(doorStates(C), (std::map<std::string, std::string>{{"slide", "closed"}}));
  C.setJointState(VectorXd::Constant(1, .9));
  EXPECT_EQ(doorStates(C).at("slide"), "opened");
  expectError<ParseError>([&] { setAttributes(slide, "friction: ["); }, {"attributes of frame 'slide'"});
  expectError<ValueError>([&] { setAttributes(slide, "joint: hingeX"); }, {"setJoint"});
}

}  // namespace
}  // namespace kinegraph
