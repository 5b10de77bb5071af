#include "kinegraph/solvers/algebra/local_model.h"

#include "kinegraph/solvers/algebra/band_algebra.h"
#include "kinegraph/solvers/algebra/dense_algebra.h"
#include "kinegraph/solvers/algebra/semismooth_model.h"

namespace kinegraph::inline solvers_internal {

std::unique_ptr<LocalModel> makeLocalModel(const Nlp& nlp, const Jacobian& pattern, const std::vector<int>& costs,
                                           std::vector<int> constraints) {
  constexpr int kFew = 8;  // covers the joints of one arm
  if (nlp.dimension() <= kFew)
    return std::make_unique<SemismoothModel<DenseAlgebra<kFew>>>(nlp, pattern, costs, std::move(constraints));
  return std::make_unique<SemismoothModel<BandAlgebra>>(nlp, pattern, costs, std::move(constraints));
}

}  // namespace kinegraph::inline solvers_internal
