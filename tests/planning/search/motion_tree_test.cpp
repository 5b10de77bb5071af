#include "kinegraph/planning/search/motion_tree.h"

#include <gtest/gtest.h>

#include "kinegraph/scene/config.h"

namespace kinegraph {
namespace {

Config slider() {
  Config C;
  C.addText("world: {}\na(world): {joint: transX, limits: [-9, 9]}");
  return C;
}

VectorXd at(double x) { return VectorXd::Constant(1, x); }

TEST(MotionTree, TheNearestNodeAndItsBranchAreFound) {
  const Config C = slider();
  const JointSpace space(*C.model());
  MotionTree tree(space, {at(0.), at(5.)});
  const int a = tree.add(at(1.), 0, false), b = tree.add(at(2.), a, false);
  double distance = 0.;
  EXPECT_EQ(tree.nearest(at(2.25), distance), b);
  EXPECT_EQ(distance, .25);
  EXPECT_EQ(tree.branch(b), (std::vector<int>{b, a, 0}));
  EXPECT_EQ(tree.node(tree.add(at(4.), 1, true)).root, 1);
}

TEST(MotionTree, ACutTakesAwayAllThatHangsOnTheNode) {
  const Config C = slider();
  const JointSpace space(*C.model());
  MotionTree tree(space, {at(0.)});
  const int a = tree.add(at(1.), 0, true), b = tree.add(at(-1.), 0, true);
  tree.add(at(2.), a, true);
  const int d = tree.add(at(-2.), b, true);
  tree.add(at(3.), 3, true);
  tree.add(at(-3.), d, true);
  tree.cut(a);
  ASSERT_EQ(tree.size(), 4);
  double distance = 0.;
  const int end = tree.nearest(at(-3.), distance);
  EXPECT_EQ(distance, 0.);
  std::vector<double> branch;
  for (const int i : tree.branch(end)) branch.push_back(tree.q(i)[0]);
  EXPECT_EQ(branch, (std::vector<double>{-3., -2., -1., 0.}));
  EXPECT_EQ(tree.q(tree.nearest(at(9.), distance))[0], 0.);
}

}  // namespace
}  // namespace kinegraph
