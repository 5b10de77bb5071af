#include "kinegraph/komo/path/path.h"

#include <gtest/gtest.h>

#include "kinegraph/common/errors.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

Config twoLinksAndBox() {
  Config config;
  config.addText(R"(
    world: {}
    shoulder (world): { joint: hingeZ, limits: [-3, 3], q: .1 }
    elbow (shoulder): { Q: [1, 0, 0], joint: hingeZ, limits: [-3, 3], q: .2 }
    box (world): { Q: [1, 1, 0], shape: ssBox, size: [.1, .1, .1, .01] }
  )");
  return config;
}

Path path(double phases, int per_phase, int order) {
  Path path;
  path.setScene(twoLinksAndBox());
  path.setGrid(TimeGrid(phases, per_phase, 1., order));
  return path;
}

Attachment freeJoint(bool stable) {
  Attachment attachment;
  attachment.type = JointType::trans3;
  attachment.stable = stable;
  attachment.starts_at_object = true;
  return attachment;
}

}  // namespace

TEST(Path, NeedsASceneAndAGridInEitherOrder) {
  Path first;
  expectError<Error>([&] { first.requireBuilt("addObjective"); }, {"addObjective needs"});
  first.setGrid(TimeGrid(1., 3, 1., 1));
  expectError<Error>([&] { first.requireBuilt("addObjective"); }, {"addObjective needs"});
  first.setScene(twoLinksAndBox());
  first.requireBuilt("addObjective");
  const Path second = path(1., 3, 1);
  EXPECT_EQ(first.joints(), second.joints());
  EXPECT_EQ(first.layout().dimension, 6);
}

TEST(Path, ItsVariablesAreTheSlicesOneAfterTheOther) {
  Path three = path(3., 1, 2);
  VectorXd x(6);
  x << 1., 2., 3., 4., 5., 6.;
  three.setVariables(x);
  EXPECT_EQ(three.variables(), x);
  EXPECT_EQ(three.joints(), (MatrixXd(3, 2) << 1., 2., 3., 4., 5., 6.).finished());
  EXPECT_EQ(three.state(-1).q(), Eigen::Vector2d(.1, .2));  // initial configuration before the start
  EXPECT_EQ(three.configuration(1).getJointState(), Eigen::Vector2d(3., 4.));
  expectError<ValueError>([&] { three.configuration(3); }, {"slice 3", "-2 .. 2"});
}

TEST(Path, SharedJointsAreInTheVariablesOnce) {
  for (const bool stable : {true, false}) {
    Path four = path(4., 1, 1);
    four.beginModes();
    four.attach(1, "elbow", "box", freeJoint(stable));
    EXPECT_EQ(four.layout().dimension, 4 * 2 + (stable ? 3 : 9));
    VectorXd x = four.variables();
    for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = .1 * double(i);
    four.setVariables(x);
    EXPECT_EQ(four.variables(), x);
    const int box = four.initial().tree->get("box", "test").id;
    const MatrixXd place = [&] {
      MatrixXd rows(3, 3);
      for (int t = 1; t < 4; ++t) rows.row(t - 1) = four.state(t).q()(four.dofsOf({box}, t)).transpose();
      return rows;
    }();
    EXPECT_EQ(place.row(0) == place.row(2), stable);
    expectError<ValueError>([&] { four.dofsOf({box}, 0); }, {"no active joint in slice 0"});
  }
}

TEST(Path, AChangeOfTheStructureKeepsWhatWasThere) {
  Path four = path(4., 1, 1);
  VectorXd x = four.variables();
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = .1 * double(i);
  four.setVariables(x);
  const MatrixXd joints = four.joints();
  const Vector3d before = four.state(2).position(four.initial().tree->get("box", "test").id);
  const int revision = four.revision();
  four.beginModes();
  EXPECT_EQ(four.revision(), revision);
  four.attach(2, "elbow", "box", freeJoint(true));
  EXPECT_GT(four.revision(), revision);
  EXPECT_EQ(four.joints(), joints);
  EXPECT_EQ(four.configuration(1).getFrame("box").getParent()->getName(), "world");
  EXPECT_EQ(four.configuration(2).getFrame("box").getParent()->getName(), "elbow");
  EXPECT_EQ(four.mode(2).added.size(), 1u);
  EXPECT_EQ(before, Vector3d(1., 1., 0.));
}

TEST(Path, OnlyFramesThatPeopleAddAreShown) {
  Path two = path(2., 1, 1);
  two.beginModes();
  two.addDofs("force", 0, 1, freeJoint(false));
  EXPECT_EQ(two.framePoses(0).rows(), 4);
  const Pose elbow = two.configuration(0).getFrame("elbow").getPose();
  two.addFrame("grasp", "box", JointType::free, true, elbow);
  EXPECT_EQ(two.framePoses(0).rows(), 6);  // the frame and its origin
  EXPECT_EQ(two.configuration(0).getFrame("grasp").getPose().p, elbow.p);
}

TEST(Path, ItsContentMakesItAnew) {
  Path four = path(2., 2, 2);
  four.beginModes();
  four.attach(1, "elbow", "box", freeJoint(true));
  VectorXd x = four.variables();
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = .1 * double(i);
  four.setVariables(x);
  Path again = path(2., 2, 2);
  again.setContent(four.content());
  EXPECT_EQ(again.variables(), x);
  for (int t = -2; t < 4; ++t) EXPECT_EQ(again.framePoses(t), four.framePoses(t));
  Path other = path(3., 2, 2);
  expectError<ValueError>([&] { other.setContent(four.content()); }, {"do not fit"});
}

TEST(Path, ACloneHasModesOfItsOwn) {
  Path four = path(2., 2, 2);
  four.beginModes();
  Path clone = four.clone();
  clone.attach(1, "elbow", "box", freeJoint(true));
  EXPECT_EQ(four.configuration(3).getFrame("box").getParent()->getName(), "world");
  EXPECT_EQ(clone.configuration(3).getFrame("box").getParent()->getName(), "elbow");
}
