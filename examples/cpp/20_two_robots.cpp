// Part 20: two robots at a table, moved by one BotOp.
//
// Both arms grasp and lift a block at the same time. The world is simulated: forces hold the blocks. A log of all
// commands repeats the motion, to the bit.
#include <kinegraph/kinegraph.h>

#include <iostream>

using namespace kinegraph;

Config scene() {
  Config C;
  C.addFile(modelPath("scenarios/pandasTable.g"));
  for (const auto& [side, x] : {std::pair("l", -.35), std::pair("r", .35)}) {
    Frame block = C.addFrame(std::string(side) + "_block").setShape(ST::box, {.05, .05, .08}).setColor({1, .5, 0});
    block.setPosition({x, .2, .64}).setMass(.2);
  }
  return C;
}

/// Returns joint values of both arms with the hands around their blocks, or above them.
VectorXd handsAt(const Config& C, double height) {
  Komo komo(C, 1, 1, 0);
  komo.addControlObjective({}, 0, 1e-1);
  komo.addObjective({}, FS::jointLimits, {}, OT::ineq);
  for (const std::string side : {"l", "r"}) {
    const std::string hand = side + "_gripper";
    const Vector3d block = C.getFrame(side + "_block").getPosition();
    const auto is = [&](FS what, const Vector3d& target) {
      komo.addObjective({}, what, {hand}, OT::eq, 10., VectorXd(target));
    };
    is(FS::position, block + Vector3d(0, 0, height));
    is(FS::vectorZ, {0, 0, 1});
    is(FS::vectorX, {1, 0, 0});
  }
  if (!komo.solve().feasible) throw Error("no configuration with both hands there");
  return komo.getPath().row(0).transpose();
}

int main() try {
  Config C = scene();
  BotOp bot(C);
  bot.sync(C, .3);  // the blocks come to rest on the table
  const auto height = [&](const char* block) { return C.getFrame(block).getPosition().z(); };
  const double l_start = height("l_block"), r_start = height("r_block");
  const VectorXd above = handsAt(C, .15), around = handsAt(C, .01);
  MatrixXd path(3, above.size());
  path << above.transpose(), above.transpose(), around.transpose();
  bot.moveAutoTimed(path, 1.5);
  bot.wait(C);
  for (const int hand : {0, 1}) bot.gripperClose(hand, 20.);
  bot.wait(C, true, false, true);
  bot.moveTo(above);
  bot.wait(C);
  bot.sync(C, 1.);
  const double l = height("l_block") - l_start, r = height("r_block") - r_start;
  std::cout << "after " << bot.get_t() << " s the blocks are " << l << " m and " << r << " m higher\n";

  Config start = scene();
  BotOp again(start);
  again.replay(bot.getLog());
  const bool same = again.get_q() == bot.get_q();
  std::cout << "the same again, to the bit: " << same << "\n";
  C.view(true, "both blocks are lifted");
  return std::min(l, r) > .12 && same ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
