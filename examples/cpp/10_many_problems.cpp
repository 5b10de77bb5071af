// Part 10: one problem from many starts, several problems at once, and samples of the feasible set.
//
// A motion problem may have many solutions, or be a choice between several problems: which hand grasps the ball? All of
// them are solved in parallel, with the same results for any number of threads.
#include <kinegraph/kinegraph.h>

#include <iostream>

using namespace kinegraph;

Komo take(const Config& C, const std::string& gripper) {
  Komo komo(C, 1, 20, 2);
  komo.addControlObjective({}, 0, 1e-2);
  komo.addControlObjective({}, 2, 1.);
  komo.addObjective({}, FS::accumulatedCollisions, {}, OT::eq, 1.);
  komo.addObjective({1.}, FS::positionDiff, {gripper, "ball"}, OT::eq, 10.);
  return komo;
}

int main() try {
  Config C;
  C.addFile(modelPath("scenarios/pandasTable.g"));
  C.addFrame("ball").setShape(ST::sphere, {.05}).setColor({1, .5, 0}).setPosition({.25, .15, .9});

  // A discrete choice: each hand is a separate problem; the cheapest feasible one is chosen.
  const std::vector<std::string> hands = {"l_gripper", "r_gripper"};
  std::vector<Komo> problems;
  for (const std::string& hand : hands) problems.push_back(take(C, hand));
  const SolveManyResult answers = solveAll(problems, {.threads = 2});
  for (std::size_t i = 0; i < hands.size(); ++i) {
    const SolverResult& result = answers.results[i];
    std::cout << hands[i] << ": " << solverStatusName(result.status) << ", feasible: " << result.feasible << ", cost "
              << result.sos << "\n";
  }
  const std::string hand = hands[std::size_t(answers.chosen)];
  Komo& komo = problems[std::size_t(answers.chosen)];
  std::cout << "taken by " << hand << "\n";
  komo.view(true, "the motion of the hand that is chosen");

  // One problem from the present path and from random ones: the best result.
  const SolveManyResult all = komo.solveFromMany(6, {.threads = 2}, 1);
  std::cout << all.best().str() << "\ncosts:";
  for (const SolverResult& result : all.results) std::cout << " " << result.sos;

  // Random configurations with the gripper at the ball.
  Komo hold(C, 1, 1, 0);
  hold.addObjective({}, FS::jointLimits, {}, OT::ineq);
  hold.addObjective({}, FS::positionDiff, {hand, "ball"}, OT::eq, 1.);
  NlpSampler sampler(hold.nlp());
  sampler.options.interiorMethod = "MCMC";
  sampler.options.interiorSampleSteps = 10;
  Rng rng(0);
  for (int i = 0; i < 10; ++i) sampler.sample(rng);
  std::cout << "\n" << sampler.samples().size() << " configurations\n";
  return answers.best().feasible && all.best().feasible && sampler.samples().size() >= 5 ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
