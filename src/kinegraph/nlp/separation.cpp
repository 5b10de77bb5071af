#include "kinegraph/nlp/separation.h"

#include <algorithm>

namespace kinegraph {

VectorXd Separation::joined(const VectorXd& phi, Eigen::Index rows) const {
  VectorXd out = VectorXd::Zero(rows);
  for (std::size_t i = 0; i < row_of.size(); ++i) out[row_of[i]] += is_term[i] ? std::max(0., phi[Eigen::Index(i)]) : phi[Eigen::Index(i)];
  return out;
}

VectorXd Separation::joinedDual(const VectorXd& dual, Eigen::Index rows) const {
  VectorXd out = VectorXd::Zero(rows);
  for (std::size_t i = 0; i < row_of.size(); ++i) {
    const double value = dual[Eigen::Index(i)];
    out[row_of[i]] = is_term[i] ? std::max(out[row_of[i]], value) : value;
  }
  return out;
}

}  // namespace kinegraph
