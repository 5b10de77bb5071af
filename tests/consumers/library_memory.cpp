// Frees vectors and matrices that the library has allocated, and the library frees those of the program.
#include <iostream>

#include <kinegraph/kinegraph.h>

using namespace kinegraph;

int main() {
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  VectorXd start = C.getJointState(), goal = start;
  goal[0] += .6;
  MotionPlan plan = planMotion(C, goal, {}, start);
  plan.path = MatrixXd(plan.path);  // this program's memory, which the library replaces
  plan = planMotion(C, start, {}, goal);
  const MatrixXd path{{0., 0.}, {1., .2}, {1.2, 1.}};
  const TimedPath timed = retime(path, {VectorXd::Constant(2, 1.), VectorXd::Constant(2, 2.), {}});
  const bool right = plan.feasible() && plan.path.row(0).transpose().isApprox(goal) && timed.duration() > 1.;
  std::cout << (right ? "right" : "wrong") << std::endl;
  return right ? 0 : 1;
}
