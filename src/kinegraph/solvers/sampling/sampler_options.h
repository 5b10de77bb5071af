#pragma once

#include <string>

namespace kinegraph {

/// Settings of NlpSampler. Names are those that scripts know.
struct SamplerOptions {
  std::string seedMethod = "uni";  ///< where a sample starts: uni in the bounds, gauss at the problem's initial point,
                                   ///< nov far from earlier samples, dist by chance more likely far from them
  int seedCandidates = 10;         ///< points that nov and dist choose from
  int seedAttempts = 10;  ///< seeds that are tried, one after the other, until the way down reaches the constraints

  double tolerance = 1e-3;            ///< sum of all violations that a sample may have
  std::string downhillMethod = "GN";  ///< to the constraints by Gauss-Newton steps (GN) or along the gradient (grad)
  int downhillMaxSteps = 50;
  double penaltyMu = 1.;                     ///< weight of the squared violation
  double slackStepAlpha = 1.;                ///< part of a step that is taken
  double slackMaxStep = .1;                  ///< its largest length
  double slackRegLambda = 1e-2;              ///< regularization of GN
  double ineqOverstep = -1.;                 ///< > 1: steps go that much too far for inequalities, into their interior
  std::string downhillNoiseMethod = "none";  ///< none, iso, or cov: noise of the covariance that GN has
  double downhillNoiseSigma = .1;
  std::string downhillRejectMethod =
      "Wolfe";  ///< steps that do not help are taken (none), not taken (Wolfe), or by chance (MH)

  std::string interiorMethod =
      "HR";  ///< how a sample moves within the constraints: none, HR, MCMC, Langevin, manifoldRRT
  int interiorBurnInSteps = 0;
  int interiorSampleSteps = 1;
  double interiorNoiseSigma = .5;  ///< length of steps
  double hitRunEqMargin = .1;      ///< HR walks where |eq| is below it, and goes back to eq = 0 at the end
  double eps = 0.;                 ///< violation that HR may have on its way, to be removed at the end
  double langevinTauPrime = -1.;   ///< step size of Langevin; < 0: interiorNoiseSigma^2 / 2

  int verbose = 0;

  /// Throws ValueError naming the first field that makes no sense.
  void validate() const;
};

}  // namespace kinegraph
