#pragma once

#include <string>

#include "kinegraph/common/option_table.h"

namespace kinegraph {

/// Settings of NlpSampler; samplerOptionTable() says what each one means. Names are those that scripts know.
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

  /// Throws ValueError naming the first field that makes no sense.
  void validate() const;
};

/// Name, unit, meaning and range of each field, for messages, bindings and documents.
const OptionTable<SamplerOptions>& samplerOptionTable();

}  // namespace kinegraph
