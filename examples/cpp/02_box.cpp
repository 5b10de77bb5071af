// Part 2: a box, built step by step in C++, and the same box read from a file.
#include <kinegraph/kinegraph.h>

#include <cstring>
#include <iostream>

using namespace kinegraph;

void print(const char* what, const Frame& box) {
  std::cout << what << " at " << box.getPosition().transpose() << ", " << box.getMass() << " kg, size";
  for (double length : box.getSize()) std::cout << " " << length;
  std::cout << "\n";
}

int main(int argc, char** argv) try {
  // Every setter returns the frame, so the description of a frame can be one sentence.
  Config C;
  Frame box = C.addFrame("box1")
                  .setPosition({0, 0, .25})
                  .setShape(ST::ssBox, {.5, .5, .5, .05})
                  .setColor({1, .5, 0})
                  .setMass(.1)
                  .setContact(1);
  print("made in C++:  ", box);
  C.view(true, "a rounded box");

  // Anything can be changed afterwards.
  box.setColor({0, .5, 1}).setShape(ST::ssBox, {.8, .5, .2, .02}).setPosition({0, 0, .1});
  print("flat and blue:", box);
  C.view(true, "the same box, now flat and blue");

  Config D;
  D.addFile(SCENES "box.g");
  const Frame from_file = D.getFrame("box1");
  print("from box.g:   ", from_file);
  if (argc > 1 && !std::strcmp(argv[1], "--watch")) D.watchFile(SCENES "box.g");

  const bool same = from_file.getPosition().isApprox(Vector3d(0, 0, .25)) &&
                    from_file.getSize() == std::vector<double>{.5, .5, .5, .05};
  return same ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
