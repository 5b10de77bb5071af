// Part 8: inverse kinematics in one call.
//
// `solveIk` makes the problem, tries many starting points, respects limits and avoids collisions. If there is no
// solution, it explains why.
#include <kinegraph/kinegraph.h>

#include <algorithm>
#include <iostream>

using namespace kinegraph;

int main() try {
  Config C;
  C.addFile(modelPath("scenarios/pandasTable.g"));
  const Frame ball = C.addFrame("ball").setShape(ST::sphere, {.05}).setColor({1, .5, 0}).setPosition({-.1, .2, 1.});
  C.view(true, "two arms, a table and a ball");

  // Moves a frame to a position, from above: z points out of the back of the hand.
  IkResult result = solveIk(C, {IkTarget::toPosition("l_gripper", ball.getPosition()),
                                IkTarget::toDirection("l_gripper", Vector3d::UnitZ(), Vector3d::UnitZ())});
  std::cout << result.str() << "\n";
  C.setJointState(result.q);
  C.view(true, "the left gripper is at the ball");
  const bool at_ball = result.feasible() && C.eval(FS::positionDiff, {"l_gripper", "ball"}).y.norm() < 1e-5;

  // Both arms at once, at least 2 cm from everything, and the nearest of 50 answers to the present configuration.
  const Vector3d left = C.getFrame("l_gripper").getPosition(), right = C.getFrame("r_gripper").getPosition();
  const Vector3d up(0, 0, .1);
  const std::vector<IkTarget> both = {IkTarget::toPosition("l_gripper", left + up),
                                      IkTarget::toPosition("r_gripper", right + up)};
  result = solveIk(C, both, {.attempts = 50, .best = true, .margin = .02});
  C.setJointState(result.q);
  std::cout << result.str() << "\nmoved by " << (C.getFrame("r_gripper").getPosition() - right).norm() << " m\n";
  C.view(true, "both went up by 10 cm");
  const bool went_up = result.feasible();

  // A target out of reach is an outcome with a reason.
  result = solveIk(C, {IkTarget::toPosition("l_gripper", {1.5, .4, 1.})});
  std::cout << result.str() << "\n";

  // A thousand targets at once; threads share them, and the solutions do not depend on their number.
  Rng rng(0);
  std::vector<std::vector<IkTarget>> problems;
  for (int i = 0; i < 1000; ++i) {
    const Vector3d point = left + .3 * Vector3d(rng.normal(), rng.normal(), rng.normal());
    problems.push_back({IkTarget::toPosition("l_gripper", point)});
  }
  const std::vector<IkResult> results = solveIkBatch(C, problems, {.attempts = 10}, 2);
  const auto count = std::count_if(results.begin(), results.end(), [](const IkResult& one) { return one.feasible(); });
  std::cout << count << " of " << results.size() << " reached without collision\n";
  return at_ball && went_up && !result.feasible() && count > 500 ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
