#include "kinegraph/nlp/nlp.h"

#include <algorithm>

namespace kinegraph {

VectorXd Separation::joined(const VectorXd& phi, Eigen::Index rows) const {
  VectorXd out = VectorXd::Zero(rows);
  const std::size_t count = row_of.size();
  for (std::size_t begin = 0, end; begin < count; begin = end) {  // terms of one residual are consecutive
    const int row = row_of[begin];
    end = begin + 1;
    while (is_term[begin] && end < count && row_of[end] == row) ++end;
    const auto values = phi.segment(Eigen::Index(begin), Eigen::Index(end - begin));
    out[row] += is_term[begin] ? values.cwiseMax(0.).sum() : values[0];
  }
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
