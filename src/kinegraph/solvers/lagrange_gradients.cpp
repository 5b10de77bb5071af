#include "kinegraph/solvers/lagrange_gradients.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline solvers_internal {

std::vector<LagrangeGradient> lagrangeGradients(Nlp& nlp, const VectorXd& x, const VectorXd& dual,
                                                const std::vector<std::string>& names) {
  const int rows = int(nlp.types().size());
  if (x.size() != nlp.dimension())
    throw ValueError(
        cat("lagrangeGradients: x has ", x.size(), " entries; the problem has ", nlp.dimension(), " variables"));
  if (dual.size() != 0 && dual.size() != rows)
    throw ValueError(cat("lagrangeGradients: got ", dual.size(), " multipliers; the problem has ", rows, " residuals"));
  if (!names.empty() && int(names.size()) != rows)
    throw ValueError(cat("lagrangeGradients: got ", names.size(), " names; the problem has ", rows, " residuals"));
  Jacobian J = nlp.makeJacobian();
  VectorXd phi(rows);
  nlp.evaluate(x, phi, &J);
  std::map<std::pair<std::string, ObjectiveType>, std::pair<double, VectorXd>> groups;
  std::set<std::pair<std::string, ObjectiveType>> active;
  for (int row = 0; row < rows; ++row) {
    const ObjectiveType type = nlp.types()[row];
    if (type == ObjectiveType::none) continue;
    const std::string key = names.empty() ? nlp.describeRow(row).objective : names[row];
    const double y = phi[row], outside = std::max(0., y);
    auto& [error, gradient] = groups[{key, type}];
    if (gradient.size() == 0) gradient.setZero(x.size());
    double weight = dual.size() > 0 ? dual[row] : 0.;
    switch (type) {
      case ObjectiveType::f:
        error += y, weight = 1.;
        break;
      case ObjectiveType::sos:
        error += y * y, weight = 2. * y;
        break;
      case ObjectiveType::ineqP:
        error += outside * outside, weight = 2. * outside;
        break;
      default:
        error += violation(type, y);
    }
    if (weight != 0.) active.insert({key, type});
    J.addRowTo(row, weight, gradient);
  }
  std::vector<LagrangeGradient> list;
  for (const auto& [key, sums] : groups) {
    if (sums.first != 0. || active.contains(key))
      list.push_back({key.first, key.second, sums.first, sums.second.norm()});
  }
  std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.gradient > b.gradient; });
  return list;
}

}  // namespace kinegraph::inline solvers_internal
