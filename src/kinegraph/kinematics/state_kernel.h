#pragma once

#include "kinegraph/kinematics/lane_model.h"

namespace kinegraph::inline kinematics_internal {

/// Input and output of forward kinematics of one configuration, in the layout of State. Kernels write poses and twists
/// in order, and may write one number after the last one.
struct StateArrays {
  const LaneModel::Link* links;
  int link_count;
  const LaneModel::Step* steps;
  const int* angle_dof;
  const double* angle_factor;
  int angles;  ///< an even number
  const double* q;
  double* sines_cosines;  ///< per angle: sine and cosine
  double* poses;          ///< per link: the columns of R, then p; the caller sets the world's
  double* twists;         ///< per column: angular, then linear
};

/// Computes poses and twists, with the same bits on all processors.
using UpdateState = void (*)(const StateArrays& state);

/// Returns the fastest kernel for this processor.
UpdateState stateKernel();

}  // namespace kinegraph::inline kinematics_internal

namespace kinegraph::lanes {
void updateStateBase(const StateArrays& state);
void updateStateAvx2(const StateArrays& state);
}  // namespace kinegraph::lanes
