// The part of the package `robotic` in benchmarks/cpp_calls.py, which compiles it with the headers and the library of
// the wheel.
//     robotic_calls SCENE FRAME JOINT_VECTORS
#include <Kin/frame.h>
#include <Kin/kin.h>

#include "calls.h"

int main(int argc, char** argv) try {
  if (argc != 4) return 2;
  rai::Configuration C;
  C.addFile(argv[1]);
  rai::Frame* frame = C.getFrame(argv[2]);
  std::vector<arr> joint_vectors;
  for (const calls::Numbers& numbers : calls::readRows(argv[3])) {
    arr q(uint(numbers.size()));
    std::copy(numbers.begin(), numbers.end(), q.p);
    joint_vectors.push_back(q);
  }
  arr linear, angular;
  const auto call = [&](std::size_t i) {
    C.setJointState(joint_vectors[i]);
    C.jacobian_pos(linear, frame, frame->ensure_X().pos);
    C.jacobian_angular(angular, frame);
  };
  const auto answer = [&] {
    const auto& position = frame->ensure_X().pos;
    calls::Numbers numbers{position.x, position.y, position.z};
    for (const arr& J : {linear, angular}) numbers.insert(numbers.end(), J.p, J.p + J.N);
    return numbers;
  };
  calls::report("", joint_vectors.size(), call, answer);
  std::fflush(stdout);
  _exit(0);  // skips its destructors
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
