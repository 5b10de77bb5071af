#pragma once

#include <vector>

#include "kinegraph/komo/komo.h"
#include "kinegraph/komo/motion_problem.h"

namespace kinegraph {

struct Komo::Parts {
  Config config;
  double phases = 0., duration_per_phase = 1.;
  int slices_per_phase = 0, order = 0;
  Path::Content path;
  std::vector<Objective> objectives;
  std::vector<ContactForce> contacts;
};

}  // namespace kinegraph
