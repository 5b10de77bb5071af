#include "kinegraph/kinematics/kinematic_model.h"

#include <gtest/gtest.h>

#include "kinegraph/common/random.h"
#include "kinegraph/common/text.h"
#include "kinegraph/kinematics/state.h"
#include "kinegraph/scene/config.h"

using namespace kinegraph;

namespace {

/// An arm on a rotated base, with joints at quarter and other rotations, and branches.
Config arm(const std::string& base) {
  Config config;
  config.addText(cat("world: {}\nbase(world): { Q: \"", base, R"g(" }
    a(base): { pre: "t(0 .1 .2) d(90 1 0 0)", joint: hingeY }
    fixed(a): { Q: "t(.1 0 .3) d(-90 0 0 1)" }
    b(fixed): { pre: "t(0 0 .2) d(180 0 1 0)", joint: transXYPhi }
    c(b): { pre: "d(40 1 2 3)", joint: hinge, axis: [1 2 -1], joint_scale: -1.3 }
    d(c): { pre: "t(.3 0 0) d(90 0 0 1)", joint: quatBall }
    e(d): { pre: "d(-90 0 1 0)", joint: hingeX, mimic: a, joint_scale: .5 }
    tip(e): { Q: "t(.1 .2 .3) d(90 0 1 0)" }
    side(a): { pre: "d(90 0 0 1)", joint: transZ }
    finger(side): { Q: "t(.1 .2 .3)" }
  )g"));
  return config;
}

VectorXd someJoints(const Config& config, Rng& rng) {
  VectorXd q = config.model()->home;
  for (double& x : q) x += .5 * rng.normal();
  return q;
}

}  // namespace

TEST(PlaceJoint, ALinkHasTheAxesOfItsParentIfItsJointHasAQuarterRotation) {
  Config config = arm("d(90 0 0 1)");
  config.setJointState(VectorXd::Zero(config.getJointDimension()).eval());
  const State& state = config.state();
  for (const char* name : {"a", "b", "side"}) {
    const int frame = config.getFrame(name).id();
    EXPECT_EQ(state.linkPose(state.link(frame)).R, Matrix3d::Identity()) << name;
    EXPECT_TRUE(state.pose(frame).R.isApprox(config.getFrame(name).getPose().q.toRotationMatrix(), 1e-14)) << name;
    EXPECT_FALSE(state.pose(frame).R.isIdentity(.1)) << name;
  }
}

TEST(PlaceJoint, FramesAreWhereTheMotionsOfTheJointsAboveTakeThem) {
  Rng rng(3);
  for (const char* base : {"t(1 2 3)", "d(90 0 0 1)", "t(0 0 1) d(180 1 0 0)", "d(90 1 1 1)", "d(120 1 1 1)"}) {
    Config config = arm(base);
    for (int i = 0; i < 5; ++i) {
      config.setJointState(someJoints(config, rng));
      for (const Frame& frame : config.getFrames()) {
        if (!frame.getParent()) continue;
        const RigidTransform expected = (frame.getParent()->getPose() * frame.getRelativePose()).transform(),
                             X = config.state().pose(frame.id());
        EXPECT_TRUE(X.R.isApprox(expected.R, 1e-12)) << base << ", " << frame.getName();
        EXPECT_TRUE((X.p - expected.p).norm() < 1e-12) << base << ", " << frame.getName();
      }
    }
  }
}

TEST(PlaceJoint, ARotatedBaseEqualsOneThatWasLoadedWithTheRotation) {
  Rng rng(4);
  Config edited = arm("t(1 2 3)");
  for (const char* base :
       {"t(0 0 1) d(90 0 0 1)", "t(0 0 1) d(-90 1 0 0)", "d(30 1 0 2)", "t(1 0 0) d(180 0 0 1)", "t(.1 .2 .3)"}) {
    Config loaded = arm(base);
    edited.state();
    edited.getFrame("base").setRelativePose(loaded.getFrame("base").getRelativePose());
    const VectorXd q = someJoints(loaded, rng);
    edited.setJointState(q);
    loaded.setJointState(q);
    Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor> J(6, q.size()), expected(6, q.size());
    for (const Frame& frame : loaded.getFrames()) {
      const int id = frame.id();
      EXPECT_TRUE(edited.state().pose(id).R.isApprox(loaded.state().pose(id).R, 1e-14))
          << base << ", " << frame.getName();
      EXPECT_TRUE(edited.state().position(id).isApprox(loaded.state().position(id), 1e-14))
          << base << ", " << frame.getName();
      edited.state().jacobian(id, edited.state().position(id), J);
      loaded.state().jacobian(id, loaded.state().position(id), expected);
      EXPECT_LT((J - expected).norm(), 1e-13) << base << ", " << frame.getName();
    }
  }
}
