// Motions among dynamic obstacles, replanning of a running motion, and improving motions.
#include <kinegraph/kinegraph.h>

#include <iostream>

using namespace kinegraph;

namespace {

/// Whether the robot keeps 9 mm to the load, every 10 ms of a motion.
bool keepsClear(Config& C, const MotionPlan& plan) {
  for (double t = 0.; t <= plan.duration() + 1.; t += .01) {
    C.setJointState(plan.eval(t).q);
    C.getFrame("cart").setPose(Pose::fromNumbers(plan.obstaclesAt(t).front()));
    const int load = C.getFrame("load").id();
    for (const Config::NearPair& pair : C.getCollisions(.009))
      if (pair.a == load || pair.b == load) return false;
  }
  return true;
}

/// A disc, and two walls with gaps.
Config twoWalls() {
  Config C;
  C.addFrame("floor");
  C.addFrame("disc", "floor").setJoint(JointType::transXY, {-2., -2., 2., 2.});
  C.addFrame("body", "disc").setShape(ShapeType::cylinder, {.2, .05}).setContact(1);
  const auto wall = [&](double x, double low, double high) {
    Frame piece = C.addFrame(std::to_string(x) + " " + std::to_string(low));
    piece.setShape(ShapeType::box, {.1, high - low, 1.}).setContact(1).setPosition({x, .5 * (low + high), 0.});
  };
  wall(-.5, -2.2, -1.5), wall(-.5, -1.2, -.2), wall(-.5, .05, 1.), wall(-.5, 1.3, 2.2);
  wall(.5, -2.2, -1.25), wall(.5, -.95, .05), wall(.5, .3, .75), wall(.5, 1.05, 2.2);
  return C;
}

}  // namespace

int main() try {
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  C.addFrame("cart").setPosition({-.6, .35, 1.1});
  C.addFrame("load", "cart").setShape(ShapeType::ssBox, {.3, .3, .5, .02}).setContact(1);
  VectorXd start = C.getJointState(), goal = start;
  start[0] -= .6, goal[0] += .6;

  // The trajectory of a load that is carried past the arm, and then away.
  MatrixXd poses(3, 7);
  poses << -.6, .35, 1.1, 1., 0., 0., 0., .6, .35, 1.1, 1., 0., 0., 0., .6, 1.5, 1.1, .7, 0., 0., .7;
  const std::vector<ObstacleTrajectory> moving = {{"cart", VectorXd{{0., 2., 4.}}, poses}};
  const MotionPlan past = planMotion(C, goal, {.margin = .01, .obstacle_trajectories = moving}, start);
  std::cout << past.str() << "\n";
  for (const std::string& note : past.warnings) std::cout << note << "\n";
  if (!past.feasible() || !keepsClear(C, past)) return 1;

  // The moving robot gets another goal: the new motion continues with its velocity.
  C.getFrame("cart").setPosition({0., 2., 1.});
  const MotionPlan plan = planMotion(C, goal, {.velocity = VectorXd{{.6}}, .acceleration = VectorXd{{1.5}}}, start);
  const double now = .4 * plan.duration();
  VectorXd elsewhere = goal;
  elsewhere[0] -= .3, elsewhere[1] += .3;
  const MotionPlan bend = plan.replan(C, now, MotionGoal(elsewhere));
  std::cout << "another goal after " << now << " s: " << bend.str() << "\n";
  if (!bend.feasible() || (bend.eval(0.).velocity - plan.eval(now).velocity).norm() > 1e-9) return 1;

  // The first path is seldom in the best homotopy class.
  MotionPlans better =
      planMotions(twoWalls(), VectorXd{{1.5, .9}},
                  {.optimize = "length", .restarts = 1, .improvement_evaluations = 20000}, VectorXd{{-1.5, -1.}});
  double length = 0.;
  while (const auto found = better.next()) std::cout << "length " << (length = found->length) << "\n";
  return length > 0. && length < 3.7 ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
