#include "kinegraph/solvers/sampling/sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kinegraph/nlp/problems.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

using enum ObjectiveType;

using Function = CallbackNlp::Function;

std::shared_ptr<Nlp> problem(int n, std::vector<ObjectiveType> types, double half_width, Function function) {
  return std::make_shared<CallbackNlp>(n, std::move(types), VectorXd::Constant(n, -half_width),
                                       VectorXd::Constant(n, half_width), std::move(function));
}

/// .5 <= |x| <= 1 in the plane.
std::shared_ptr<Nlp> ring() {
  return problem(2, {ineq, ineq}, 2., [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    phi << x.squaredNorm() - 1., .25 - x.squaredNorm();
    J.row(0) = 2. * x;
    J.row(1) = -2. * x;
  });
}

/// x >= 0, y >= 0, x + y <= 1.
std::shared_ptr<Nlp> triangle() {
  return problem(2, {ineq, ineq, ineq}, 2., [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    phi << -x[0], -x[1], x.sum() - 1.;
    J << -1., 0., 0., -1., 1., 1.;
  });
}

/// The unit sphere.
std::shared_ptr<Nlp> sphere() {
  return problem(3, {eq}, 2., [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    phi << x.squaredNorm() - 1.;
    J = 2. * x.transpose();
  });
}

/// Costs of a normal distribution of deviation .5 around (.3, -.2).
std::shared_ptr<Nlp> bell() {
  return problem(2, {sos, sos}, 3., [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    phi << (x[0] - .3) / (.5 * std::numbers::sqrt2), (x[1] + .2) / (.5 * std::numbers::sqrt2);
    J = MatrixXd::Identity(2, 2) / (.5 * std::numbers::sqrt2);
  });
}

std::vector<VectorXd> draw(const std::shared_ptr<Nlp>& nlp, const char* method, int burn_in, int count,
                           std::uint64_t seed = 3) {
  NlpSampler sampler(nlp);
  sampler.options.interiorMethod = method;
  sampler.options.interiorBurnInSteps = burn_in;
  Rng rng(seed);
  for (int i = 0; i < count; ++i) {
    const SolverResult result = sampler.sample(rng);
    EXPECT_TRUE(result.feasible) << result.message;
    EXPECT_LE(result.violation, sampler.options.tolerance);
    EXPECT_TRUE((result.x.array() >= nlp->lower().array()).all() && (result.x.array() <= nlp->upper().array()).all());
  }
  return sampler.samples();
}

/// Kolmogorov and Smirnov: the largest difference of the distribution of `of` from the uniform one on [0, 1], times
/// sqrt(N). It exceeds 1.63 by chance in one of a hundred.
double distanceFromUniform(const std::vector<VectorXd>& samples, const std::function<double(const VectorXd&)>& of) {
  std::vector<double> values;
  for (const VectorXd& x : samples) values.push_back(of(x));
  std::sort(values.begin(), values.end());
  double worst = 0.;
  const double n = double(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) worst = std::max({worst, (i + 1) / n - values[i], values[i] - i / n});
  return worst * std::sqrt(n);
}

double angle(const VectorXd& x) { return std::atan2(x[1], x[0]) / (2. * std::numbers::pi) + .5; }

double bellCurve(double x) { return .5 * std::erfc(-x / std::numbers::sqrt2); }

}  // namespace

TEST(Sampler, HitAndRunIsUniformInABox) {
  const auto box = problem(3, {}, 1., [](const VectorXd&, VectorXd&, MatrixXd&) {});
  const auto samples = draw(box, "HR", 0, 2000);
  for (int i = 0; i < 3; ++i)
    EXPECT_LT(distanceFromUniform(samples, [i](const VectorXd& x) { return .5 * (x[i] + 1.); }), 1.63);
}

TEST(Sampler, HitAndRunIsUniformInATriangle) {
  const auto samples = draw(triangle(), "HR", 20, 2000);
  EXPECT_LT(distanceFromUniform(samples, [](const VectorXd& x) { return 1. - std::pow(1. - x[0], 2); }), 1.63);
  EXPECT_LT(distanceFromUniform(samples, [](const VectorXd& x) { return std::pow(x.sum(), 2); }), 1.63);
}

TEST(Sampler, HitAndRunAndMetropolisAreUniformInARingWhichIsNotConvex) {
  for (const char* method : {"HR", "MCMC"}) {
    const auto samples = draw(ring(), method, 30, 2000);
    EXPECT_LT(distanceFromUniform(samples, [](const VectorXd& x) { return (x.squaredNorm() - .25) / .75; }), 1.63)
        << method;
    EXPECT_LT(distanceFromUniform(samples, angle), 1.63) << method;
  }
}

TEST(Sampler, HitAndRunFindsItsWayWithoutBounds) {
  const double inf = std::numeric_limits<double>::infinity();
  const auto disk =
      std::make_shared<CallbackNlp>(2, std::vector<ObjectiveType>{ineq}, VectorXd::Constant(2, -inf),
                                    VectorXd::Constant(2, inf), [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
                                      phi << x.squaredNorm() - 9.;
                                      J = 2. * x.transpose();
                                    });
  const auto samples = draw(disk, "HR", 20, 1000);
  EXPECT_LT(distanceFromUniform(samples, [](const VectorXd& x) { return x.squaredNorm() / 9.; }), 1.63);
}

TEST(Sampler, MetropolisIsUniformOnASphere) {
  // each coordinate of a uniform point of a sphere is uniform (Archimedes)
  for (const char* method : {"MCMC", "Langevin"}) {
    const auto samples = draw(sphere(), method, 30, 1500);
    for (int i = 0; i < 3; ++i)
      EXPECT_LT(distanceFromUniform(samples, [i](const VectorXd& x) { return .5 * (x[i] + 1.); }), 1.63) << method;
  }
}

TEST(Sampler, MetropolisIsUniformAlongAnEllipseWhoseNormalsTurnQuickly) {
  // half axes 1 and .25; the shares of the perimeter come from 1e5 chords
  const auto ellipse = problem(2, {eq}, 2., [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    phi << x[0] * x[0] + 16. * x[1] * x[1] - 1.;
    J << 2. * x[0], 32. * x[1];
  });
  std::vector<double> length = {0.};
  constexpr int kChords = 100000;
  for (int i = 1; i <= kChords; ++i) {
    const double a = 2. * std::numbers::pi * (i - 1) / kChords, b = 2. * std::numbers::pi * i / kChords;
    length.push_back(length.back() + std::hypot(std::cos(b) - std::cos(a), .25 * (std::sin(b) - std::sin(a))));
  }
  const auto share = [&](const VectorXd& x) {
    const double t = std::atan2(4. * x[1], x[0]) / (2. * std::numbers::pi);
    return length[std::size_t(std::clamp((t < 0. ? t + 1. : t) * kChords, 0., double(kChords)))] / length.back();
  };
  EXPECT_LT(distanceFromUniform(draw(ellipse, "MCMC", 60, 1500), share), 1.63);
}

TEST(Sampler, MetropolisAndLangevinFollowTheCosts) {
  for (const char* method : {"MCMC", "Langevin"}) {
    const auto samples = draw(bell(), method, 60, 1500);
    EXPECT_LT(distanceFromUniform(samples, [](const VectorXd& x) { return bellCurve((x[0] - .3) / .5); }), 1.63)
        << method;
    EXPECT_LT(distanceFromUniform(samples, [](const VectorXd& x) { return bellCurve((x[1] + .2) / .5); }), 1.63)
        << method;
  }
}

TEST(Sampler, HitAndRunEndsOnTheSurfaceOfEqualities) {
  for (const VectorXd& x : draw(sphere(), "HR", 5, 100)) EXPECT_NEAR(x.squaredNorm(), 1., 1e-3);
}

TEST(Sampler, ATreeSpreadsOverAllOfASurface) {
  NlpSampler sampler(sphere());
  sampler.options.interiorMethod = "manifoldRRT";
  sampler.options.interiorSampleSteps = 50;
  Rng rng(1);
  int octants[8] = {};
  for (int i = 0; i < 200; ++i) {
    const SolverResult result = sampler.sample(rng);
    EXPECT_NEAR(result.x.norm(), 1., 1e-3);
    ++octants[(result.x[0] > 0.) + 2 * (result.x[1] > 0.) + 4 * (result.x[2] > 0.)];
  }
  for (int count : octants) EXPECT_GE(count, 8);
}

TEST(Sampler, TheSameSeedGivesTheSameSamplesAndAnotherOneOthers) {
  for (const char* method : {"none", "HR", "MCMC", "Langevin", "manifoldRRT"}) {
    EXPECT_EQ(draw(ring(), method, 3, 5, 8), draw(ring(), method, 3, 5, 8)) << method;
    EXPECT_NE(draw(ring(), method, 3, 5, 8), draw(ring(), method, 3, 5, 9)) << method;
  }
}

TEST(Sampler, NewSeedsKeepAwayFromEarlierSamples) {
  const auto box = problem(2, {}, 1., [](const VectorXd&, VectorXd&, MatrixXd&) {});
  double nearest[3] = {};
  int at = 0;
  for (const char* method : {"uni", "dist", "nov"}) {
    NlpSampler sampler(box);
    sampler.options.seedMethod = method;
    sampler.options.interiorMethod = "none";
    Rng rng(0);
    for (int i = 0; i < 100; ++i) sampler.sample(rng);
    const auto& samples = sampler.samples();
    for (const VectorXd& a : samples) {
      double distance = 10.;
      for (const VectorXd& b : samples) distance = &a == &b ? distance : std::min(distance, (a - b).norm());
      nearest[at] += distance / 100.;
    }
    ++at;
  }
  EXPECT_GT(nearest[1], 1.05 * nearest[0]);
  EXPECT_GT(nearest[2], 1.4 * nearest[0]);
}

TEST(Sampler, EveryWayDownReachesTheConstraints) {
  for (const char* downhill : {"GN", "grad"}) {
    for (const char* reject : {"none", "Wolfe", "MH"}) {
      for (const char* noise : {"none", "iso", "cov"}) {
        NlpSampler sampler(triangle());
        sampler.options.downhillMethod = downhill;
        sampler.options.downhillRejectMethod = reject;
        sampler.options.downhillNoiseMethod = noise;
        sampler.options.downhillNoiseSigma = .02;
        sampler.options.ineqOverstep = 1.2;
        sampler.options.downhillMaxSteps = 300;
        Rng rng(2);
        int good = 0;
        for (int i = 0; i < 20; ++i) good += sampler.sample(rng).feasible;
        EXPECT_GE(good, 18) << downhill << ", " << reject << ", " << noise;
      }
    }
  }
}

TEST(Sampler, ConstraintsThatContradictEachOtherGiveNoSample) {
  const auto nlp = problem(1, {eq, eq}, 3., [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    phi << x[0], x[0] - 1.;
    J << 1., 1.;
  });
  NlpSampler sampler(nlp);
  Rng rng(0);
  const SolverResult result = sampler.sample(rng);
  EXPECT_FALSE(result.feasible);
  EXPECT_EQ(result.status, SolverStatus::infeasible);
  EXPECT_NEAR(result.eq, 1., 1e-2) << "the least sum of violations, in words: " << result.message;
  EXPECT_TRUE(sampler.samples().empty());
}

TEST(Sampler, EndsWhenTheCallerSaysSo) {
  NlpSampler sampler(ring());
  sampler.options.interiorSampleSteps = 1000000;
  Rng rng(0);
  int calls = 0;
  const SolverResult result = sampler.sample(rng, [&](const VectorXd&, const VectorXd&) { return ++calls < 50; });
  EXPECT_EQ(result.status, SolverStatus::cancelled);
  EXPECT_EQ(calls, 50);
}

TEST(Sampler, MistakesAreNamed) {
  NlpSampler sampler(ring());
  Rng rng(0);
  sampler.options.interiorMethod = "HitRun";
  expectError<ValueError>([&] { sampler.sample(rng); }, {"interiorMethod", "'HitRun'", "HR, MCMC, Langevin"});
  sampler.options = {};
  sampler.options.slackMaxStep = 0.;
  expectError<ValueError>([&] { sampler.sample(rng); }, {"slackMaxStep", "positive"});
  NlpSampler broken(problem(1, {sos}, 1., [](const VectorXd&, VectorXd& phi, MatrixXd&) { phi << NAN; }));
  expectError<ValueError>([&] { broken.sample(rng); }, {"row 0 (sos)", "nan"});
}
