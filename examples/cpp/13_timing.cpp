// Timing: the fastest motion along a path, within limits of velocity, acceleration and jerk.
#include <kinegraph/kinegraph.h>

#include <iostream>

using namespace kinegraph;

int main() try {
  Config C;
  C.addFile(modelPath("panda/panda.g"));
  const VectorXd start = C.getJointState().head(7);
  VectorXd velocity(7), acceleration(7), over(7), goal(7);
  velocity << 2.175, 2.175, 2.175, 2.175, 2.61, 2.61, 2.61;
  acceleration << 15, 7.5, 10, 12.5, 15, 20, 20;
  over << .8, -.3, .2, .4, 0, .3, .1;
  goal << 1.6, .5, -.3, .1, .4, -.2, .5;
  MatrixXd path(3, 7);
  path << start.transpose(), (start + over).transpose(), (start + goal).transpose();

  bool is_within = true;
  for (const Corners corners : {Corners::stop, Corners::blend, Corners::spline}) {
    RetimeOptions options;
    options.corners = corners;
    options.tolerance = .1;
    const TimedPath fast = retime(path, {velocity, acceleration, {}}, options);
    const TimedPath smooth = retime(path, {velocity, acceleration, 20. * acceleration}, options);
    std::cout << fast.duration() << " s, with limits of the jerk " << smooth.duration() << " s\n";
    const MotionState middle = smooth.eval(smooth.duration() / 2.);
    is_within = is_within && fast.duration() <= smooth.duration() &&
                (middle.velocity.array().abs() <= velocity.array()).all() &&
                (middle.acceleration.array().abs() <= acceleration.array()).all();
  }
  return is_within ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
