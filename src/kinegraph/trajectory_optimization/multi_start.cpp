#include "kinegraph/trajectory_optimization/motion_problems.h"

#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/komo/path/path.h"

namespace kinegraph {

std::vector<VectorXd> sampleStarts(Komo& komo, int count, std::uint64_t seed, const CancellationToken& cancellation) {
  if (count < 1) throw ValueError(cat("solveFromMany: the number of starts is ", count, "; expected at least 1"));
  Rng rng(seed);
  std::vector<VectorXd> starts = {komo.path().variables()};
  struct Restore {
    Komo& komo;
    VectorXd x;
    ~Restore() { komo.path().setVariables(x); }
  } restore{komo, starts[0]};
  while (int(starts.size()) < count) {
    cancellation.check();
    komo.setRandomPath(rng);
    starts.push_back(komo.path().variables());
  }
  return starts;
}

SolveManyResult solveFromMany(const std::shared_ptr<Komo>& komo, const std::vector<VectorXd>& starts,
                              const SolverOptions& solver, const SolveManyOptions& options,
                              const ProgressCallback& progress, const CancellationToken& cancellation) {
  if (starts.empty()) throw ValueError("solveFromMany: there are no starts");
  for (std::size_t i = 0; i < starts.size(); ++i) {
    if (starts[i].size() == komo->path().layout().dimension) continue;
    throw ValueError(cat("solveFromMany: start ", i, " has ", starts[i].size(), " numbers; the problem has ",
                         komo->path().layout().dimension));
  }
  std::vector<std::shared_ptr<Nlp>> copies(std::size_t(std::clamp(options.threads, 0, int(starts.size()))));
  for (auto& copy : copies) copy = makeNlp(std::make_shared<Komo>(komo->clone()));
  SolveManyResult all = solveMany(
      int(starts.size()), options,
      [&](int worker, int i, const EvaluationCallback& callback) {
        NlpSolver one(copies[std::size_t(worker)], 0);
        one.options = solver;
        one.options.verbose = 0;
        one.setInitialization(starts[std::size_t(i)]);
        Rng unused(0);
        SolverResult result = one.solve(false, unused, callback);
        result.problem = nullptr;  // the next start reuses the copy
        return result;
      },
      progress, cancellation);
  const auto problem = makeNlp(komo);
  for (SolverResult& result : all.results) {
    if (result.done) result.problem = problem;
  }
  if (all.best().x.size() > 0) komo->path().setVariables(all.best().x);
  return all;
}

}  // namespace kinegraph
