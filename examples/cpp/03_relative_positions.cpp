// Part 3: relative positions. A frame with a parent moves along with it.
#include <kinegraph/kinegraph.h>

#include <iostream>
#include <numbers>

using namespace kinegraph;

void show(const Frame& frame) {
  std::cout << "  " << frame.getName() << ": position " << frame.getPosition().transpose() << ", orientation "
            << wxyz(frame.getQuaternion()).transpose() << "\n";
}

int main() try {
  Config C;
  C.addFile(SCENES "box.g");
  Frame box1 = C.getFrame("box1");
  const Frame box2 = C.addFrame("box2", "box1")
                         .setShape(ST::ssBox, {.5, .5, .5, .05})
                         .setRelativePosition({0, 0, 1})
                         .setColor({0, 0, 1});

  // box2 is 1 m above its parent, and the parent is .25 m above the ground: 1.25 m in the world.
  std::cout << "a second box, 1 m above the first:\n";
  show(box1);
  show(box2);
  const bool is_above = box2.getPosition().isApprox(Vector3d(0, 0, 1.25));
  C.view(true, "the blue box is 1 m above the orange one");

  box1.setPosition({.5, 0, .25});
  std::cout << "after moving only the first box by .5 m along x:\n";
  show(box1);
  show(box2);
  C.view(true, "both moved");

  // `Above` means along the parent's z axis, so a tilted parent moves its child to the side.
  box1.setQuaternion({std::cos(std::numbers::pi / 8), std::sin(std::numbers::pi / 8), 0, 0});
  std::cout << "after tilting only the first box by 45 degrees about x:\n";
  show(box1);
  show(box2);
  std::cout << "  seen from box1, box2 has not moved: " << box2.getRelativePosition().transpose() << "\n";
  C.view(true, "both tilted");
  return is_above && box2.getRelativePosition().isApprox(Vector3d(0, 0, 1)) ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
