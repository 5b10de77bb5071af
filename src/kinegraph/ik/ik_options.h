#pragma once

#include <cstdint>

#include "kinegraph/common/option_table.h"

namespace kinegraph {

/// Settings of solveIk; ikOptionTable() documents each one.
struct IkOptions {
  double position_tolerance = 1e-6;
  double rotation_tolerance = 1e-6;
  int attempts = 100;
  int steps = 25;
  bool best = false;
  bool collisions = true;
  double margin = 0.;
  double max_start_penetration = .005;
  double start_weight = 0.;
  double home_weight = 0.;
  std::uint64_t seed = 0;

  /// Throws ValueError that names the first invalid field.
  void validate() const;
};

/// Name, unit, description and range of each field, for messages, bindings and documents.
const OptionTable<IkOptions>& ikOptionTable();

}  // namespace kinegraph
