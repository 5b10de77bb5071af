#include "kinegraph/komo/komo.h"

#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

void addStepLimit(Komo& komo, double step, const std::vector<double>& times) {
  if (!(step > 0.) || !std::isfinite(step))
    throw ValueError(cat("addStepLimit: step is ", step, "; expected a number > 0, rad or m"));
  const double tau = komo.tau(), speed = step / tau;
  for (const double sign : {1., -1.}) {
    const VectorXd target = VectorXd::Constant(1, sign * speed);
    komo.addObjective(times, FeatureSymbol::qItself, {}, ObjectiveType::ineq, sign * tau, target, 1);
  }
}

}  // namespace kinegraph
