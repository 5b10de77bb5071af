#include "kinegraph/solvers/sampling/sampler_options.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"

namespace kinegraph {

namespace {

void oneOf(const char* option, const std::string& given, const std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), given) != names.end()) return;
  throw ValueError(cat("option ", option, " is '", given, "'; expected one of ", join(names)));
}

void atLeast(const char* option, double value, double least) {
  if (!(value >= least) || !std::isfinite(value))
    throw ValueError(cat("option ", option, " is ", value, "; expected a number >= ", least));
}

void positive(const char* option, double value) {
  if (!(value > 0.) || !std::isfinite(value))
    throw ValueError(cat("option ", option, " is ", value, "; expected a positive number"));
}

}  // namespace

void SamplerOptions::validate() const {
  oneOf("seedMethod", seedMethod, {"uni", "gauss", "nov", "dist"});
  oneOf("downhillMethod", downhillMethod, {"GN", "grad"});
  oneOf("downhillNoiseMethod", downhillNoiseMethod, {"none", "iso", "cov"});
  oneOf("downhillRejectMethod", downhillRejectMethod, {"none", "Wolfe", "MH"});
  oneOf("interiorMethod", interiorMethod, {"none", "HR", "MCMC", "Langevin", "manifoldRRT"});
  atLeast("seedCandidates", seedCandidates, 1);
  atLeast("seedAttempts", seedAttempts, 1);
  atLeast("downhillMaxSteps", downhillMaxSteps, 0);
  atLeast("interiorBurnInSteps", interiorBurnInSteps, 0);
  atLeast("interiorSampleSteps", interiorSampleSteps, 0);
  for (const auto& [name, value] : {std::pair{"tolerance", tolerance},
                                    {"penaltyMu", penaltyMu},
                                    {"slackStepAlpha", slackStepAlpha},
                                    {"slackMaxStep", slackMaxStep},
                                    {"slackRegLambda", slackRegLambda},
                                    {"interiorNoiseSigma", interiorNoiseSigma},
                                    {"hitRunEqMargin", hitRunEqMargin}}) {
    positive(name, value);
  }
  atLeast("downhillNoiseSigma", downhillNoiseSigma, 0.);
  atLeast("eps", eps, 0.);
  if (!std::isfinite(ineqOverstep))
    throw ValueError(cat("option ineqOverstep is ", ineqOverstep, "; expected a number, <= 1 for none"));
  if (std::isnan(langevinTauPrime))
    throw ValueError("option langevinTauPrime is nan; expected a number, < 0 for the default");
}

}  // namespace kinegraph
