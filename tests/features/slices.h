#pragma once

#include <gtest/gtest.h>

#include "kinegraph/features/residual.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

/// Value of a residual over consecutive joint vectors of a scene, oldest first, `tau` seconds apart.
inline VectorXd overSlices(const Config& config, Residual& residual, const std::vector<VectorXd>& q, double tau) {
  EXPECT_EQ(residual.order() + 1, int(q.size()));
  std::vector<State> states(q.size(), config.state());
  std::vector<const State*> view;
  for (std::size_t t = 0; t < q.size(); ++t) {
    states[t].setJoints(q[t].data());
    view.push_back(&states[t]);
  }
  VectorXd y(residual.rows());
  residual.eval(view, tau, y, nullptr);
  return y;
}

}  // namespace kinegraph
