// Part 16: a conveyor belt carries boxes of different weight, and a bar pushes them off.
//
// `surfaceVelocity` moves a shape's surface without moving the shape.
#include <kinegraph/kinegraph.h>

#include <iostream>

using namespace kinegraph;

int main() try {
  Config C;
  C.addFrame("belt", "", "shape: box, size: [2 .3 .1], color: [.2 .2 .2], surfaceVelocity: [.3 0 0]")
      .setPosition({0, 0, .5});
  C.addFrame("rail").setPosition({.6, .4, .6});
  C.addFrame("bar", "rail", "joint: transY, limits: [-1 1], shape: box, size: [.3 .05 .08], color: [.8 .3 .2]");
  const double masses[] = {.05, .5, 2.};
  for (int i = 0; i < 3; ++i) {
    Frame box = C.addFrame("box" + std::to_string(i)).setShape(ST::ssBox, {.08, .08, .08, .005});
    box.setPosition({-.8 + .3 * i, 0, .59}).setColor({1, .6, .2}).setMass(masses[i]);
  }

  Simulation S(C);
  for (int i = 0; i < 150; ++i) S.step();
  const VectorXd speeds = S.get_frameVelocities().col(0);
  std::cout << "the boxes move at " << speeds.transpose() << " m/s\n";
  const bool as_the_belt = (speeds.array() - .3).abs().maxCoeff() < 1e-3;

  // The bar waits until the first box (the one that started in front) is before it, then pushes.
  while (C.getFrame("box2").getPosition().x() < .55) S.step();
  for (int i = 0; i < 60; ++i) S.step(-VectorXd::Ones(1), .01, ControlMode::velocity);
  for (int i = 0; i < 100; ++i) S.step();
  const double first = C.getFrame("box2").getPosition().z(), last = C.getFrame("box0").getPosition().z();
  std::cout << "heights: of the first box " << first << " m, of the last one " << last << " m\n";
  C.view(true, "one box is on the floor");
  return as_the_belt && first < .1 && last > .5 ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
