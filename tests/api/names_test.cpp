#include "kinegraph/api/names.h"

#include <gtest/gtest.h>

#include <type_traits>

#include "kinegraph/planning/path_finder.h"

namespace kinegraph {
namespace {

TEST(Names, ArePythons) {
  static_assert(std::is_same_v<RRT_PathFinder, PathFinder> && std::is_same_v<NLP_Solver, NlpSolver>);
  Config C;
  C.addText("world: {}\nj (world): { joint: hingeX, limits: [-1 1] }", "scene");
  RRT_PathFinder finder;
  finder.setProblem(C);
  finder.setStartGoal(VectorXd{{-.5}}, VectorXd{{.5}});
  EXPECT_TRUE(finder.solve().feasible);
  EXPECT_NE(_left, _right);
}

}  // namespace
}  // namespace kinegraph
