#include "kinegraph/nlp/evaluation_sizes.h"

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline nlp_internal {

void prepareEvaluation(const Nlp& nlp, const VectorXd& x, VectorXd& phi, const Jacobian* J) {
  const auto rows = Eigen::Index(nlp.types().size());
  if (phi.size() != rows) phi.resize(rows);
  if (x.size() != nlp.dimension())
    throw ValueError(
        cat("Nlp::evaluate: x has ", x.size(), " entries; the problem has ", nlp.dimension(), " variables"));
  if (J && (J->rows() != int(rows) || J->columns != nlp.dimension()))
    throw ValueError(cat("Nlp::evaluate: J is ", J->rows(), " x ", J->columns, "; expected ", rows, " x ",
                         nlp.dimension(), ", the sizes of makeJacobian()"));
}

}  // namespace kinegraph::inline nlp_internal
