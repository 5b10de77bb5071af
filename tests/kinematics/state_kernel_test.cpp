#include "kinegraph/kinematics/state_kernel.h"

#include <gtest/gtest.h>

#include "kinegraph/common/random.h"
#include "kinegraph/kinematics/kinematic_model.h"
#include "kinegraph/kinematics/state.h"
#include "kinegraph/scene/config.h"

using namespace kinegraph;

namespace {

/// Joints of all kinds, in parallel and in series, on bases with all kinds of rotations.
Config joints() {
  Config config;
  config.addText(R"g(
    world: {}
    a(world): { pre: "t(.1 -.2 .3) d(90 1 0 0)", joint: hingeX }
    b(a): { pre: "d(180 0 1 0)", joint: hingeY, joint_scale: -1.5 }
    c(b): { pre: "t(0 .2 0)", joint: hingeZ }
    d(c): { pre: "t(.3 .1 .2) d(30 1 2 3)", joint: hingeZ }
    e(d): { pre: "d(-90 0 0 1)", joint: hinge, axis: [1 2 -1] }
    f(c): { pre: "t(.1 0 0)", joint: transXYPhi }
    g(f): { joint: universal }
    h(a): { pre: "t(0 0 .4)", joint: quatBall }
    i(h): { joint: circleZ }
    j(i): { pre: "d(90 0 1 0)", joint: free }
    k(world): { joint: hingeY }
    l(k): { pre: "t(.1 .2 .3) d(270 1 0 0)", joint: hingeX, mimic: a, joint_scale: .5 }
    m(l): { joint: transZ }
  )g");
  return config;
}

struct Numbers {
  std::vector<double> turned, poses, twists;
};

Numbers computed(UpdateState update, const State& state, const VectorXd& q) {
  const KinematicModel& model = state.model();
  const Parameters& parameters = state.parameters();
  Numbers numbers{std::vector<double>(2 * model.angle_dof.size()), std::vector<double>(12 * model.links.size() + 1),
                  std::vector<double>(6 * model.column_dof.size() + 1)};
  for (const int k : {0, 4, 8}) numbers.poses[std::size_t(k)] = 1.;
  update({parameters.link.data(), int(parameters.link.size()), parameters.step.data(), model.angle_dof.data(),
          parameters.angle_factor.data(), int(model.angle_dof.size()), q.data(), numbers.turned.data(),
          numbers.poses.data(), numbers.twists.data()});
  return numbers;
}

}  // namespace

TEST(StateKernel, AllGiveTheSameBitsAndThoseOfTheState) {
  const Config config = joints();
  State state = config.state();
  Rng rng(2);
  for (int i = 0; i < 50; ++i) {
    VectorXd q = state.model().home;
    for (double& x : q) x += (i % 10 == 9 ? 1e6 : 1.) * rng.normal();  // large angles, too
    state.setJoints(q.data());
    const Numbers base = computed(lanes::updateStateBase, state, q), chosen = computed(stateKernel(), state, q);
    EXPECT_EQ(base.poses, chosen.poses) << i;
    EXPECT_EQ(base.twists, chosen.twists) << i;
    EXPECT_EQ(base.turned, chosen.turned) << i;
    for (std::size_t link = 0; link < state.model().links.size(); ++link) {
      const RigidTransform& pose = state.linkPose(int(link));
      EXPECT_EQ(Eigen::Map<const Matrix3d>(base.poses.data() + 12 * link), pose.R) << i;
      EXPECT_EQ(Eigen::Map<const Vector3d>(base.poses.data() + 12 * link + 9), pose.p) << i;
    }
    for (std::size_t column = 0; column < state.model().column_dof.size(); ++column) {
      EXPECT_EQ(Eigen::Map<const Vector3d>(base.twists.data() + 6 * column), state.twist(int(column)).angular) << i;
      EXPECT_EQ(Eigen::Map<const Vector3d>(base.twists.data() + 6 * column + 3), state.twist(int(column)).linear) << i;
    }
  }
}
