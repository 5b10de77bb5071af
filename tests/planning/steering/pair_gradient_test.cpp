#include "kinegraph/planning/steering/pair_gradient.h"

#include <gtest/gtest.h>

#include "kinegraph/common/random.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {
namespace {

TEST(PairGradient, EqualsCentralDifferences) {
  Config C;
  C.addText(R"(
world: {}
a(world): {joint: hingeZ}
base(a): {Q: [0.4, 0, 0.1]}
b(base): {joint: hingeX}
tip(b): {shape: capsule, size: [0.3, 0.05], Q: [0.3, 0.1, 0], contact: 1}
c(world): {joint: transZ}
ball(c): {shape: ssBox, size: [0.2, 0.3, 0.2, 0.02], Q: [0.9, 0.5, 0.4], contact: 1}
)");
  Rng rng(0);
  const int a = C.getFrame("tip").id(), b = C.getFrame("ball").id();
  State state = C.state();
  const auto at = [&](const VectorXd& q) {
    state.setJoints(q.data());
    return pairGradient(state, a, b);
  };
  for (int i = 0; i < 20; ++i) {
    const VectorXd q{{rng.uniform(-1., 1.), rng.uniform(-1., 1.), rng.uniform(-.5, .5)}};
    const PairGradient pair = at(q);
    for (int dof = 0; dof < 3; ++dof) {
      constexpr double h = 1e-6;
      VectorXd less = q, more = q;
      less[dof] -= h;
      more[dof] += h;
      EXPECT_NEAR(pair.gradient[dof], (at(more).distance - at(less).distance) / (2. * h), 1e-5) << i << " " << dof;
    }
  }
}

}  // namespace
}  // namespace kinegraph
