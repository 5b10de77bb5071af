#include "kinegraph/solvers/nlp_solver.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <utility>

#include "kinegraph/nlp/problems.h"
#include "tests/solvers/hock_schittkowski.h"
#include "tests/support/expect_error.h"
#include "tests/support/near.h"

using namespace kinegraph;

namespace {

/// All known problems, each with its solver.
struct All {
  std::vector<NlpSolver> solvers;
  std::vector<NlpSolver*> pointers;

  All() {
    for (const KnownProblem& problem : knownProblems()) {
      solvers.emplace_back(std::make_shared<KnownNlp>(problem), 0);
      solvers.back().setInitialization(problem.start);
    }
    for (NlpSolver& solver : solvers) pointers.push_back(&solver);
  }
};

SolverResult outcome(bool feasible, double cost, double violation) {
  SolverResult result;
  result.done = true;
  result.feasible = feasible;
  result.sos = cost;
  result.violation = violation;
  return result;
}

int choose(const std::vector<SolverResult>& outcomes, bool best = true) {
  return solveMany(int(outcomes.size()), {best, 2},
                   [&](int, int i, const EvaluationCallback&) { return outcomes[std::size_t(i)]; })
      .chosen;
}

}  // namespace

TEST(SolveAll, GivesWhatEachSolverGivesAloneAtAnyNumberOfThreads) {
  for (const int threads : {1, 2, 7}) {
    All together, alone;
    const SolveManyResult all = solveAll(together.pointers, {true, threads});
    ASSERT_EQ(all.results.size(), knownProblems().size());
    for (std::size_t i = 0; i < all.results.size(); ++i) {
      Rng rng(0);
      const SolverResult one = alone.solvers[i].solve(false, rng);
      EXPECT_EQ(all.results[i].x, one.x) << knownProblems()[i].name;
      EXPECT_EQ(all.results[i].evals, one.evals) << knownProblems()[i].name;
      EXPECT_EQ(together.solvers[i].x, one.x) << "the solver is left there: " << knownProblems()[i].name;
    }
  }
}

TEST(SolveMany, ChoosesByFeasibilityThenByCostOrViolation) {
  EXPECT_EQ(choose({outcome(false, 0., .2), outcome(true, 3., 0.), outcome(true, 2., 0.), outcome(true, 2., 0.)}), 2);
  EXPECT_EQ(choose({outcome(false, 0., .2), outcome(false, 9., .1)}), 1);
  EXPECT_EQ(choose({outcome(false, 0., .2), outcome(true, 3., 0.), outcome(true, 2., 0.)}, false), 1);
}

TEST(SolveMany, WhereOneSufficesThoseAfterTheFirstAreNotDone) {
  for (const int threads : {1, 3}) {
    const SolveManyResult all = solveMany(
        20, {false, threads}, [&](int, int i, const EvaluationCallback&) { return outcome(i == 4 || i == 7, i, 1.); });
    EXPECT_EQ(all.chosen, 4);
    for (int i = 0; i < 20; ++i) EXPECT_EQ(all.results[std::size_t(i)].done, i <= 4) << i << " with " << threads;
  }
}

TEST(SolveMany, CancellationEndsRunningProblemsAndLeavesTheRest) {
  // each problem runs until it is told to stop
  std::atomic<bool> runs = false;
  int ended = 0;
  const SolveManyResult all = solveMany(
      100, {true, 2},
      [&](int, int, const EvaluationCallback& callback) {
        runs = true;
        const VectorXd nothing;
        while (callback(nothing, nothing)) continue;
        SolverResult result = outcome(false, 0., 1.);
        result.status = SolverStatus::cancelled;
        return result;
      },
      [&](const Progress& progress) { ended = progress.done; }, [&] { return runs && ended == 0; });
  int done = 0;
  for (const SolverResult& result : all.results) done += result.done;
  EXPECT_GE(done, 1);
  EXPECT_LE(done, 2);
  EXPECT_EQ(all.best().status, SolverStatus::cancelled);
}

TEST(SolveMany, TheCallingThreadIsTheFirstWorkerAndReportsProgress) {
  const auto caller = std::this_thread::get_id();
  bool reported = false;
  const SolveManyResult all = solveMany(
      1, {true, 4},
      [&](int worker, int, const EvaluationCallback& callback) {
        EXPECT_EQ(worker, 0);
        EXPECT_EQ(std::this_thread::get_id(), caller);
        const VectorXd nothing;
        while (!reported) EXPECT_TRUE(callback(nothing, nothing));
        return outcome(true, 0., 0.);
      },
      [&, first = true](const Progress&) mutable {
        EXPECT_EQ(std::this_thread::get_id(), caller);
        reported = !std::exchange(first, false);
      });
  EXPECT_TRUE(all.best().feasible);
}

TEST(SolveMany, WhatIsCancelledBeforeItsFirstValueIsNotDone) {
  for (const int threads : {1, 3}) {
    const SolveManyResult all = solveMany(5, {true, threads}, [&](int, int i, const EvaluationCallback&) {
      if (i == 2) throw EvaluationCancelled();
      return outcome(true, i, 0.);
    });
    for (int i = 0; i < 5; ++i) EXPECT_EQ(all.results[std::size_t(i)].done, i != 2) << i << " with " << threads;
    EXPECT_EQ(all.chosen, 0);
  }
}

TEST(SolveMany, AProgressCallbackThatThrowsEndsIt) {
  const auto endless = [&](int, int, const EvaluationCallback& callback) {
    const VectorXd nothing;
    while (callback(nothing, nothing)) continue;
    return SolverResult();
  };
  EXPECT_THROW(solveMany(5, {true, 2}, endless, [](const Progress&) { throw std::runtime_error("enough"); }),
               std::runtime_error);
}

TEST(SolveAll, MistakesAreNamed) {
  expectError<ValueError>([] { solveAll({}); }, {"no problems"});
  NlpSolver one(makeTestProblem("Wedge"), 0), same(one.problem(), 0), none;
  expectError<ValueError>([&] { solveAll({&one, &one}); }, {"problem 1", "twice"});
  expectError<ValueError>([&] { solveAll({&one, &same}); }, {"problem 1", "twice"});
  expectError<ValueError>([&] { solveAll({&one, &none}); }, {"problem 1", "no problem"});
  expectError<ValueError>([&] { solveAll({&one}, {true, 0}); }, {"number of threads is 0"});
  NlpSolver wrong(makeTestProblem("Wedge"), 0);
  wrong.options.stepMax = -1.;
  expectError<ValueError>([&] { solveAll({&one, &wrong}); }, {"problem 1: ", "stepMax"});
}
