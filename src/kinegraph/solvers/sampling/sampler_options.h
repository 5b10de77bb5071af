#pragma once

#include <string>

#include "kinegraph/common/option_table.h"

namespace kinegraph {

/// Options of NlpSampler; samplerOptionTable() documents each field. The names are those of the package robotic.
struct SamplerOptions {
  std::string seedMethod = "uni";
  int seedCandidates = 10;
  int seedAttempts = 10;
  double tolerance = 1e-3;
  std::string downhillMethod = "GN";
  int downhillMaxSteps = 50;
  double penaltyMu = 1.;
  double slackStepAlpha = 1.;
  double slackMaxStep = .1;
  double slackRegLambda = 1e-2;
  double ineqOverstep = -1.;
  std::string downhillNoiseMethod = "none";
  double downhillNoiseSigma = .1;
  std::string downhillRejectMethod = "Wolfe";
  std::string interiorMethod = "HR";
  int interiorBurnInSteps = 0;
  int interiorSampleSteps = 1;
  double interiorNoiseSigma = .5;
  double hitRunEqMargin = .1;
  double eps = 0.;
  double langevinTauPrime = -1.;
  int verbose = 0;

  /// Throws ValueError with the first invalid field.
  void validate() const;
};

/// Returns name, unit, meaning and range of each field, for messages, bindings and documents.
const OptionTable<SamplerOptions>& samplerOptionTable();

}  // namespace kinegraph
