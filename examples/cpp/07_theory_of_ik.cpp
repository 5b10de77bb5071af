// Part 7: inverse kinematics from scratch, ten damped Newton steps.
//
// Near q, the position of the end effector is y + J dq. A short step that brings it to the target,
//
//     minimize  |y_target - y - J dq|^2 + w |dq|^2,   is   dq = (J^T J + w I)^-1 J^T (y_target - y).
//
// The damping w keeps the inverse finite if J loses rank, as for a stretched arm.
#include <kinegraph/kinegraph.h>

#include <Eigen/LU>
#include <iostream>

using namespace kinegraph;

/// Moves K and returns the final error of the end effector, m.
double newton(Config& K, const Vector3d& y_target, int steps = 10) {
  const Matrix3d W = 1e-4 * Matrix3d::Identity();
  std::cout << "\ntarget " << y_target.transpose() << "\n";
  K.setJointState(VectorXd{{.3, .4, 0.}});
  VectorXd q = K.getJointState();
  for (int step = 0; step < steps; ++step) {
    const auto [y, J] = K.eval(FS::position, {"endeffector"});
    std::cout << "  step " << step << ": end effector " << y.transpose() << ", " << (y_target - y).norm() << " m off\n";
    q += (J.transpose() * J + W).inverse() * J.transpose() * (y_target - y);
    K.setJointState(q);  // sets the angles and moves all frames
    K.view(true, "after step " + std::to_string(step));
  }
  const VectorXd y = K.eval(FS::position, {"endeffector"}).y;
  std::cout << "  done:   end effector " << y.transpose() << ", " << (y_target - y).norm()
            << " m off, q = " << q.transpose() << "\n";
  return (y_target - y).norm();
}

int main() try {
  Config K;
  K.addFile(SCENES "two_link_arm.g");
  K.setJointState(VectorXd::Zero(3));
  K.view(true, "stretched upwards");

  // .5 m to the side and .2 m up: the arm bends and reaches it.
  const double reached = newton(K, {0, .5, .2});

  // .7 m to the side: the arm is only .68 m long, so the nearest it comes is .02 m.
  const double beyond = newton(K, {0, .7, 0});
  return reached < 1e-5 && beyond > .0199 && beyond < .05 ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
