#include "kinegraph/solvers/interface/best_so_far.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "kinegraph/common/text.h"
#include "kinegraph/nlp/problems.h"
#include "kinegraph/solvers/nlp_solver.h"
#include "kinegraph/solvers/sampling/sampler.h"

using namespace kinegraph;

namespace {

using enum ObjectiveType;
using Eigen::Vector2d;

/// (x - 2)^2 + (y - 1)^2, for methods that want it with x + y <= 2; its evaluation number `fails_at` is cancelled.
struct Interrupted {
  int fails_at = 0, evals = 0;
  std::vector<VectorXd> seen;
  std::shared_ptr<Nlp> nlp;

  Interrupted(std::vector<ObjectiveType> types, int fails) : fails_at(fails) {
    const auto evaluate = [this](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
      if (++evals == fails_at) throw EvaluationCancelled();
      seen.push_back(x);
      const double values[] = {x[0] - 2., x[1] - 1., x.sum() - 2.};
      const double rows[3][2] = {{1., 0.}, {0., 1.}, {1., 1.}};
      for (Eigen::Index i = 0; i < phi.size(); ++i) {
        phi[i] = values[i];
        J.row(i) << rows[i][0], rows[i][1];
      }
    };
    nlp = std::make_shared<CallbackNlp>(2, std::move(types), Vector2d(-5., -5.), Vector2d(5., 5.), evaluate);
  }
  Interrupted(const Interrupted&) = delete;
};

std::vector<ObjectiveType> typesFor(OptMethod method) {
  using M = OptMethod;
  for (const M one : {M::newton, M::LBFGS, M::gradientDescent, M::rprop, M::NelderMead, M::CMA}) {
    if (method == one) return {sos, sos};
  }
  if (method == M::slackGN || method == M::slackGN_logBarrier) return {ineq, ineq, ineq};
  return {sos, sos, ineq};
}

}  // namespace

TEST(BestSoFar, ConstraintsComeBeforeCostsAndWhatIsNotFiniteDoesNotCount) {
  Interrupted problem({sos, sos, ineq}, 0);
  BestSoFar best(*problem.nlp, 1e-3);
  const auto see = [&](double x, double cost, double violation) {
    best.see(Vector2d(x, 0.), Vector3d(cost, 0., violation));
  };
  EXPECT_FALSE(best.isKnown());
  see(0., std::numeric_limits<double>::quiet_NaN(), 0.);
  EXPECT_FALSE(best.isKnown());
  see(1., 1., .5);
  see(2., 9., .4);  // violates less
  EXPECT_EQ(best.result(7).x[0], 2.);
  see(3., 5., 0.);
  see(4., 1., .002);  // violates more than the tolerance
  see(5., 6., -1.);
  EXPECT_EQ(best.result(7).x[0], 3.);
  see(6., 4., 5e-4);
  const SolverResult result = best.result(7);
  EXPECT_EQ(result.x[0], 6.);
  EXPECT_EQ(result.status, SolverStatus::cancelled);
  EXPECT_EQ(result.evals, 7);
  EXPECT_EQ(result.sos, 16.);
  EXPECT_TRUE(result.feasible && result.done);
}

TEST(BestSoFar, EveryMethodGivesItWhereAnEvaluationIsCancelledAndGoesOnAfterwards) {
  for (const OptMethod method : availableMethods()) {
    for (int fails_at = 1; fails_at <= 12; ++fails_at) {
      Interrupted problem(typesFor(method), fails_at);
      const std::string what = cat(optMethodName(method), " at ", fails_at);
      NlpSolver solver(problem.nlp, 0);
      solver.options.method = method;
      solver.setInitialization(Vector2d(3., -2.));
      Rng rng(0);
      bool nothing = false;
      SolverResult result;
      try {
        result = solver.solve(false, rng);
      } catch (const EvaluationCancelled&) {
        nothing = true;
      }
      if (problem.evals < fails_at) break;  // it takes fewer
      if (nothing) {
        EXPECT_LE(fails_at, 3) << what << ": there was no value yet";
      } else {
        EXPECT_EQ(result.status, SolverStatus::cancelled) << what;
        EXPECT_NE(std::ranges::find(problem.seen, result.x), problem.seen.end()) << what;
        EXPECT_EQ(solver.x, result.x);
      }
      const SolverResult rest = solver.solve(false, rng);
      EXPECT_TRUE(rest.done && rest.status != SolverStatus::cancelled) << what << ": " << rest.message;
      EXPECT_TRUE(rest.feasible || method == OptMethod::singleSquaredPenalty) << what;
    }
  }
}

TEST(BestSoFar, ASamplerGivesItToo) {
  for (int fails_at = 1; fails_at <= 10; ++fails_at) {
    Interrupted problem({ineq, ineq, ineq}, fails_at);
    NlpSampler sampler(problem.nlp);
    sampler.options.interiorSampleSteps = 20;
    Rng rng(0);
    if (fails_at == 1) {
      EXPECT_THROW(sampler.sample(rng), EvaluationCancelled);
    } else {
      const SolverResult result = sampler.sample(rng);
      EXPECT_EQ(result.status, SolverStatus::cancelled) << fails_at;
      EXPECT_EQ(result.x.size(), 2);
    }
    EXPECT_EQ(sampler.sample(rng).status, SolverStatus::converged);
  }
}
