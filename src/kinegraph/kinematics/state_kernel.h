#pragma once

#include "kinegraph/kinematics/lane_model.h"

namespace kinegraph {

/// What forward kinematics of one configuration reads and writes, as State has it. Kernels write from the first to the
/// last pose and twist, and may write one number behind the last one.
struct StateArrays {
  const LaneModel::Link* links;
  int link_count;
  const LaneModel::Step* steps;
  const int* turn_dof;
  const double* turn_factor;
  int turns;  ///< an even number
  const double* q;
  double* turned;  ///< per turn: sine and cosine
  double* poses;   ///< per link: the columns of R, then p; that of the world is there already
  double* twists;  ///< per column: angular, then linear
};

/// Computes poses and twists; the same bits on all processors.
using UpdateState = void (*)(const StateArrays& state);

/// The quickest for this processor.
UpdateState stateKernel();

namespace lanes {
void updateStateBase(const StateArrays& state);
void updateStateAvx2(const StateArrays& state);
}  // namespace lanes

}  // namespace kinegraph
