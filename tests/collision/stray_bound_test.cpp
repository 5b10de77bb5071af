#include "kinegraph/collision/stray_bound.h"

#include <gtest/gtest.h>

#include "kinegraph/common/random.h"
#include "kinegraph/geometry/distance/proximity.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {
namespace {

State stateOf(const char* text) {
  Config scene;
  scene.addText(text);
  return scene.state();
}

VectorXd drawn(Rng& rng, Eigen::Index size, double scale) {
  VectorXd values(size);
  for (double& value : values) value = scale * rng.normal();
  return values;
}

TEST(StrayBound, OfATwoLinkArmIsTheSumOfWhatItsJointsMoveItsTip) {
  const State arm = stateOf(R"(
base: {}
j1 (base): { joint: hingeZ }
j2 (j1): { joint: hingeZ, pre: [.5 0 0] }
tip (j2): { shape: sphere, size: [.1], Q: [.3 0 0], contact: 1 }
ball (base): { shape: sphere, size: [.1], X: [2 0 0], contact: 1 }
)");
  StrayBound bound(arm);
  const VectorXd q = Eigen::Vector2d(.3, -.2);
  EXPECT_NEAR(bound.of(q, q, Eigen::Vector2d(.01, 0.)), .01 * .9, 1e-12);
  EXPECT_NEAR(bound.of(q, q, Eigen::Vector2d(.01, .02)), .01 * .9 + .02 * .4, 1e-12);
  EXPECT_EQ(bound.of(q, q, Eigen::Vector2d(0., 0.)), 0.);
}

TEST(StrayBound, DistancesOfAllPairsDifferByNoMore) {
  const State scene = stateOf(R"(
base: {}
slide (base): { joint: transX }
j1 (slide): { joint: hingeZ, pre: [0 0 .2] }
l1 (j1): { shape: capsule, size: [.5 .03], Q: [.25 0 0 .7071068 0 .7071068 0], contact: 1 }
j2 (j1): { joint: hingeY, pre: [.5 0 0] }
out (j2): { joint: transX, pre: [.1 .1 0] }
hand (out): { shape: box, size: [.1 .2 .05], Q: [.3 0 0], contact: 1 }
left (out): { joint: hingeZ, pre: [.3 0 0], shape: sphere, size: [.05], Q: [0 .2 0], contact: 1 }
right (out): { joint: hingeZ, pre: [.3 0 0], mimic: left, shape: sphere, size: [.05], Q: [0 -.2 0], contact: 1 }
bird (base): { joint: free }
wing (bird): { shape: box, size: [.6 .1 .05], Q: [.2 0 0], contact: 1 }
wheel (base): { joint: circleZ, pre: [0 1 0] }
spoke (wheel): { shape: box, size: [.05 .6 .05], Q: [0 .3 0], contact: 1 }
wall (base): { shape: box, size: [1 .02 1], X: [0 .8 0], contact: 1 }
)");
  State here = scene, there = scene;
  StrayBound bound(scene);
  Rng rng(4);
  double most = 0.;
  for (int i = 0; i < 400; ++i) {
    const VectorXd from = scene.q() + drawn(rng, scene.dofs(), .5), to = from + drawn(rng, scene.dofs(), .1);
    const VectorXd stray = drawn(rng, scene.dofs(), i % 2 ? .05 : .005).cwiseAbs(),
                   largest = from.cwiseAbs().cwiseMax(to.cwiseAbs()) + stray;
    bound.setLargest(largest);
    const double at_most = bound.of(from, to, stray);
    const double share = rng.uniform();
    const VectorXd q = from + share * (to - from);
    VectorXd off = q;
    for (Eigen::Index dof = 0; dof < q.size(); ++dof) off[dof] += rng.uniform(-1., 1.) * stray[dof];
    here.setJoints(q.data());
    there.setJoints(off.data());
    for (const auto& [a, b] : scene.model().movingPairs()) {
      const auto &body_a = *scene.model().body[std::size_t(a)], &body_b = *scene.model().body[std::size_t(b)];
      const double change = proximity(body_a, there.pose(a), body_b, there.pose(b)).distance -
                            proximity(body_a, here.pose(a), body_b, here.pose(b)).distance;
      EXPECT_LE(std::abs(change), at_most + 1e-9);
      most = std::max(most, std::abs(change) / at_most);
    }
  }
  EXPECT_GT(most, .3) << "and the bound is no wild one";
}

}  // namespace
}  // namespace kinegraph
