#include "kinegraph/solvers/sampling/sampler.h"

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
        "Seeds: uni uniform in the bounds, gauss at the initial point of the problem, nov the candidate farthest from "
        "earlier samples, dist a random candidate with probability proportional to that distance.",
        {"uni", "gauss", "nov", "dist"}},
       {"seedCandidates", &O::seedCandidates, "", "Number of candidates of nov and dist.", R::atLeastOne()},
       {"seedAttempts", &O::seedAttempts, "", "Largest number of seeds until the descent reaches the constraints.",
        R::atLeastOne()},
       {"tolerance", &O::tolerance, "", "Largest sum of all violations of a sample.", R::positive()},
       {"downhillMethod",
        &O::downhillMethod,
        "",
        "Descent to the constraints by Gauss-Newton steps (GN) or along the gradient (grad).",
        {"GN", "grad"}},
       {"downhillMaxSteps", &O::downhillMaxSteps, "", "Largest number of descent steps.", R::notNegative()},
       {"penaltyMu", &O::penaltyMu, "", "Weight of the squared violation.", R::positive()},
       {"slackStepAlpha", &O::slackStepAlpha, "", "Factor of a descent step.", R::positive()},
       {"slackMaxStep", &O::slackMaxStep, "rad or m", "Largest length of a descent step.", R::positive()},
       {"slackRegLambda", &O::slackRegLambda, "", "Regularization of GN.", R::positive()},
       {"ineqOverstep", &O::ineqOverstep, "",
        "> 1: factor by which steps overshoot inequalities, into their interior; else none.", R::finite()},
       {"downhillNoiseMethod",
        &O::downhillNoiseMethod,
        "",
        "Noise of descent steps: none, iso, or cov, with the covariance of GN.",
        {"none", "iso", "cov"}},
       {"downhillNoiseSigma", &O::downhillNoiseSigma, "rad or m", "Standard deviation of this noise.",
        R::notNegative()},
       {"downhillRejectMethod",
        &O::downhillRejectMethod,
        "",
        "Descent steps without decrease are accepted (none), rejected (Wolfe), or accepted at random (MH).",
        {"none", "Wolfe", "MH"}},
       {"interiorMethod",
        &O::interiorMethod,
        "",
        "Interior steps: HR is hit-and-run, uniform on the feasible set after many steps; MCMC and Langevin converge "
        "to "
        "exp(-costs) on the surface of the equalities; manifoldRRT grows a tree; none.",
        {"none", "HR", "MCMC", "Langevin", "manifoldRRT"}},
       {"interiorBurnInSteps", &O::interiorBurnInSteps, "", "Interior steps before the first sample.",
        R::notNegative()},
       {"interiorSampleSteps", &O::interiorSampleSteps, "", "Interior steps per sample.", R::notNegative()},
       {"interiorNoiseSigma", &O::interiorNoiseSigma, "rad or m", "Length of these steps.", R::positive()},
       {"hitRunEqMargin", &O::hitRunEqMargin, "",
        "HR moves within |eq| below this margin, and projects to eq = 0 at the end.", R::positive()},
       {"eps", &O::eps, "", "Largest violation during HR, which is removed at the end.", R::notNegative()},
       {"langevinTauPrime", &O::langevinTauPrime, "", "Step size of Langevin; < 0: interiorNoiseSigma^2 / 2."},
       {"verbose", &O::verbose, "", "0: silent, 1: shows the progress if it takes long."}});
  return table;
}

}  // namespace kinegraph
