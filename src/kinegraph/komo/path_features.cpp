#include "kinegraph/komo/path_features.h"

namespace kinegraph {

JointsOfFrames::JointsOfFrames(std::vector<Part> parts) : parts_(std::move(parts)) {
  for (const Part& part : parts_) rows_ += part.count;
}

void JointsOfFrames::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  const State& state = *states[0];
  int row = 0;
  for (const Part& part : parts_) {
    const int first = state.program().frame_dofs[part.frame].first + part.first;
    for (int i = 0; i < part.count; ++i, ++row) {
      y[row] = state.q()[first + i];
      if (J) (*J)(row, first + i) += 1.;
    }
  }
}

void FreeFlight::eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  VectorXd before(6), now(6);
  const int n = J ? int(J->cols()) / 3 : 0;
  const auto velocity = [&](int first, VectorXd& V, double sign) {
    if (!J) {
      linear_.eval(states.subspan(first, 2), tau, V.head(3), nullptr);
      angular_.eval(states.subspan(first, 2), tau, V.tail(3), nullptr);
      return;
    }
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Rows columns = Rows::Zero(6, 2 * n);
    JacobianRows top = columns.topRows(3), bottom = columns.bottomRows(3);
    linear_.eval(states.subspan(first, 2), tau, V.head(3), &top);
    angular_.eval(states.subspan(first, 2), tau, V.tail(3), &bottom);
    J->middleCols(first * n, 2 * n) += sign * columns;
  };
  velocity(0, before, -1.);
  velocity(1, now, 1.);
  y = now - before;
  y[2] += gravity_ * tau;
}

}  // namespace kinegraph
