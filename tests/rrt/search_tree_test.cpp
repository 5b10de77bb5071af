#include "kinegraph/rrt/search_tree.h"

#include <gtest/gtest.h>

namespace kinegraph {
namespace {

/// Points on a line.
struct Line {
  double squaredDistance(const double* a, const double* b) const { return (*b - *a) * (*b - *a); }
} line;

VectorXd at(double x) { return VectorXd::Constant(1, x); }

TEST(SearchTree, TheNearestNodeAndItsBranchAreFound) {
  SearchTree tree(1, {at(0.), at(5.)});
  const int a = tree.add(at(1.), 0, false), b = tree.add(at(2.), a, false);
  double distance = 0.;
  EXPECT_EQ(tree.nearest(line, at(2.25), distance), b);
  EXPECT_EQ(distance, .25);
  EXPECT_EQ(tree.branch(b), (std::vector<int>{b, a, 0}));
  EXPECT_EQ(tree.node(tree.add(at(4.), 1, true)).root, 1);
}

TEST(SearchTree, ACutTakesAwayAllThatHangsOnTheNode) {
  SearchTree tree(1, {at(0.)});
  const int a = tree.add(at(1.), 0, true), b = tree.add(at(-1.), 0, true);
  tree.add(at(2.), a, true);
  const int d = tree.add(at(-2.), b, true);
  tree.add(at(3.), 3, true);
  tree.add(at(-3.), d, true);
  tree.cut(a);
  ASSERT_EQ(tree.size(), 4);
  double distance = 0.;
  const int end = tree.nearest(line, at(-3.), distance);
  EXPECT_EQ(distance, 0.);
  std::vector<double> branch;
  for (const int i : tree.branch(end)) branch.push_back(tree.q(i)[0]);
  EXPECT_EQ(branch, (std::vector<double>{-3., -2., -1., 0.}));
  EXPECT_EQ(tree.q(tree.nearest(line, at(9.), distance))[0], 0.);
}

}  // namespace
}  // namespace kinegraph
