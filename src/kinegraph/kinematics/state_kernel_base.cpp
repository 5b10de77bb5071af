#include "kinegraph/kinematics/state_kernel_body.h"

namespace kinegraph::lanes {

void updateStateBase(const StateArrays& state) { updateState<Packed3, 2>(state); }

}  // namespace kinegraph::lanes
