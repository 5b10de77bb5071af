#include "kinegraph/solvers/sampling/sampler_options.h"

namespace kinegraph {

void SamplerOptions::validate() const { samplerOptionTable().validate(*this); }

const OptionTable<SamplerOptions>& samplerOptionTable() {
  using O = SamplerOptions;
  using R = OptionRange;
  static const OptionTable<SamplerOptions> table(
      "NlpSampler",
      {{"seedMethod",
        &O::seedMethod,
        "",
        "Where a sample starts: uni in the bounds, gauss at the problem's initial point, nov far from earlier samples, "
        "dist by chance more likely far from them.",
        {"uni", "gauss", "nov", "dist"}},
       {"seedCandidates", &O::seedCandidates, "", "Points that nov and dist choose from.", R::atLeastOne()},
       {"seedAttempts", &O::seedAttempts, "", "Seeds that are tried until the way down reaches the constraints.",
        R::atLeastOne()},
       {"tolerance", &O::tolerance, "", "Sum of all violations that a sample may have.", R::positive()},
       {"downhillMethod",
        &O::downhillMethod,
        "",
        "To the constraints by Gauss-Newton steps (GN) or along the gradient (grad).",
        {"GN", "grad"}},
       {"downhillMaxSteps", &O::downhillMaxSteps, "", "Steps down at most.", R::notNegative()},
       {"penaltyMu", &O::penaltyMu, "", "Weight of the squared violation.", R::positive()},
       {"slackStepAlpha", &O::slackStepAlpha, "", "Part of a step down that is taken.", R::positive()},
       {"slackMaxStep", &O::slackMaxStep, "rad or m", "Largest length of a step down.", R::positive()},
       {"slackRegLambda", &O::slackRegLambda, "", "Regularization of GN.", R::positive()},
       {"ineqOverstep", &O::ineqOverstep, "",
        "> 1: steps go that much too far for inequalities, into their interior; else none.", R::finite()},
       {"downhillNoiseMethod",
        &O::downhillNoiseMethod,
        "",
        "Noise of steps down: none, iso, or cov, with the covariance that GN has.",
        {"none", "iso", "cov"}},
       {"downhillNoiseSigma", &O::downhillNoiseSigma, "rad or m", "Its standard deviation.", R::notNegative()},
       {"downhillRejectMethod",
        &O::downhillRejectMethod,
        "",
        "Steps that do not help are taken (none), not taken (Wolfe), or by chance (MH).",
        {"none", "Wolfe", "MH"}},
       {"interiorMethod",
        &O::interiorMethod,
        "",
        "How a sample moves within the constraints: HR is hit-and-run, with many steps uniform on the feasible set; "
        "MCMC and Langevin end in proportion to exp(-costs), on the surface of the equalities; manifoldRRT; none.",
        {"none", "HR", "MCMC", "Langevin", "manifoldRRT"}},
       {"interiorBurnInSteps", &O::interiorBurnInSteps, "", "Steps before the first sample.", R::notNegative()},
       {"interiorSampleSteps", &O::interiorSampleSteps, "", "Steps for each sample.", R::notNegative()},
       {"interiorNoiseSigma", &O::interiorNoiseSigma, "rad or m", "Length of these steps.", R::positive()},
       {"hitRunEqMargin", &O::hitRunEqMargin, "",
        "HR walks where |eq| is below it, and goes back to eq = 0 at the end.", R::positive()},
       {"eps", &O::eps, "", "Violation that HR may have on its way, to be removed at the end.", R::notNegative()},
       {"langevinTauPrime", &O::langevinTauPrime, "", "Step size of Langevin; < 0: interiorNoiseSigma^2 / 2."},
       {"verbose", &O::verbose, "", "0 silent; 1 says how far it is, if it takes long."}});
  return table;
}

}  // namespace kinegraph
