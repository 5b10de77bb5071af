#pragma once

#include <string>
#include <vector>

#include "kinegraph/features/eval.h"
#include "kinegraph/features/forces.h"
#include "kinegraph/features/residual.h"
#include "kinegraph/komo/collision/collision_sample.h"
#include "kinegraph/komo/path/path.h"
#include "kinegraph/nlp/nlp.h"

namespace kinegraph::inline komo_internal {

/// One term of a trajectory optimization problem: scale * (d^order feature / dt^order - target), in some of its slices.
struct Objective {
  FeatureSource feature;
  std::vector<std::string> frames{};
  ObjectiveType type;
  MatrixXd scale{};
  VectorXd target{};
  int order = -1;  ///< number of preceding slices it depends on; -1 for the feature's own order
  std::vector<double> times{};
  int from = 0, to = -1;  ///< slices, inclusive; empty if from > to
  bool time_integral = false;
  bool without_gravity = false;  ///< for physics
  bool damped = false;           ///< for physics: forces balance friction instead of inertia
  double margin = 0.;            ///< for collisions: pairs farther apart do not count, m
  double slack = 0.;             ///< for collisions: additional distance that a solver aims for, m
  bool between_slices =
      false;              ///< for collisions: constrains samples of the motions to the slices, instead of the slices
                          ///< themselves
  int frames_known = -1;  ///< for qQuaternionNorms: only the first so many frames count; -1 for all

  /// Per motion, starting with the one to slice `from`.
  std::vector<std::vector<CollisionSample>> samples{};

  const std::string& name() const { return feature.name(); }
};

/// Returns the residual of an objective in a slice of a path, given the contact forces. It is the same in all slices
/// unless it depends on the dofs. Joint features without frames use the joints of the initial configuration.
Residual residualIn(const Objective& objective, const Path& path, const std::vector<ContactForce>& forces, int slice);

}  // namespace kinegraph::inline komo_internal
