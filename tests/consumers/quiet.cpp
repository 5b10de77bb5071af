// The library prints nothing and leaves locale, signals and the floating-point environment alone. This program prints
// one line.
#include <cfenv>
#include <clocale>
#include <csignal>
#include <iostream>
#include <vector>

#include <kinegraph/kinegraph.h>

using namespace kinegraph;

void everything() {
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  Komo komo(C, 1, 1, 0);
  komo.addObjective({}, FS::position, {"l_gripper"}, OT::eq, 10., {.3, .3, 1.});
  NlpSolver solver(komo.nlp(), 3);
  solver.solve();
  solveIk(C, {IkTarget::toPosition("l_gripper", {3., 0., 0.})});
  Simulation simulation(C);
  simulation.step();
}

int main() {
  using Handler = void (*)(int);
  const std::vector<int> signals = {SIGINT, SIGTERM, SIGPIPE, SIGSEGV, SIGFPE};
  const auto handlers = [&] {
    std::vector<Handler> all;
    for (const int number : signals) {
      struct sigaction action {};
      sigaction(number, nullptr, &action);
      all.push_back(action.sa_handler);
    }
    return all;
  };
  const auto before = handlers();
  const std::string locale = std::setlocale(LC_ALL, nullptr);
  std::feclearexcept(FE_ALL_EXCEPT);
  everything();
  int messages = 0;
  setLogSink([&](LogLevel, std::string_view) { ++messages; });
  everything();
  const bool right = messages > 1 && handlers() == before && locale == std::setlocale(LC_ALL, nullptr) &&
                     std::fegetround() == FE_TONEAREST;
  std::cout << (right ? "quiet" : "wrong") << std::endl;
  return right ? 0 : 1;
}
