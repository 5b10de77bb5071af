#pragma once

#include <string>
#include <vector>

#include "kinegraph/features/eval.h"
#include "kinegraph/features/forces.h"
#include "kinegraph/komo/collision/collision_sample.h"
#include "kinegraph/komo/path/path.h"
#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// What is wanted of a path: scale * (d^order feature / dt^order - target), in some of its slices.
struct Objective {
  FeatureSource feature;
  std::vector<std::string> frames{};
  ObjectiveType type;
  MatrixXd scale{};
  VectorXd target{};
  int order = -1;  ///< number of slices it looks at, minus one; -1: the feature's own
  std::vector<double> times{};
  int from = 0, to = -1;  ///< slices, inclusive; none if from > to
  bool time_integral = false;
  bool without_gravity = false;  ///< of physics
  bool damped = false;           ///< of physics: forces balance friction, not inertia
  double margin = 0.;            ///< of collisions: pairs that are farther apart do not count, m
  double slack = 0.;             ///< of collisions: by so much more a solver aims to keep pairs apart, m
  bool on_the_way = false;       ///< of collisions: not in the slices, but at instants of the motions that lead to them
  int frames_known = -1;         ///< of qQuaternionNorms: only the first so many frames count; -1: all

  /// Of those motions, from that to slice `from` on.
  std::vector<std::vector<CollisionSample>> samples{};

  const std::string& name() const { return feature.name(); }
};

/// An objective's residual in a slice of a path, where these forces count. Where the dofs do not matter it is the same
/// in all slices. Joint features without frames are of the given configuration's joints.
Residual residualIn(const Objective& objective, const Path& path, const std::vector<ContactForce>& forces, int slice);

}  // namespace kinegraph
