// Part 1: frames. A scene is a tree of frames, each with a pose relative to its parent.
//
// Loads mini.g, prints its frames, and opens its door. `01_frames --watch` then watches the file: edit it and save.
#include <kinegraph/kinegraph.h>

#include <cstring>
#include <iostream>

using namespace kinegraph;

void printFrames(const Config& C) {
  std::cout << "frame, parent, position in the world, m, and seen from the parent, m\n";
  for (const Frame& frame : C.getFrames()) {
    const std::optional<Frame> parent = frame.getParent();
    std::cout << frame.getName() << "  " << (parent ? parent->getName() : "-") << "  "
              << frame.getPosition().transpose();
    if (parent) std::cout << "  " << frame.getRelativePosition().transpose();
    std::cout << "\n";
  }
}

int main(int argc, char** argv) try {
  Config C;
  C.addFile(SCENES "mini.g");
  printFrames(C);
  C.view(true, "a post with a sign, and a door handle on a hinge");

  // One number moves everything below the hinge.
  const Vector3d closed = C.getFrame("handle").getPosition();
  std::cout << "\njoints: " << C.getJointNames()[0] << " between " << C.getJointLimits().transpose() << "\n";
  C.setJointState(VectorXd{{1.}});
  std::cout << "door opened by 1 rad\n\n";
  printFrames(C);
  C.view(true, "the door is open");

  if (argc > 1 && !std::strcmp(argv[1], "--watch")) C.watchFile(SCENES "mini.g");
  const double moved = (C.getFrame("handle").getPosition() - closed).norm();
  return std::abs(moved - 2 * .4 * std::sin(.5)) < 1e-9 ? 0 : 1;  // a chord of a circle of 40 cm
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
