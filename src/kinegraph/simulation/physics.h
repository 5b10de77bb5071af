#pragma once

#include <mujoco/mujoco.h>

#include "kinegraph/common/dynamic_library.h"

extern "C" void mj_updateSleep(const mjModel* m, mjData* d);  ///< exported, but in none of MuJoCo's headers

namespace kinegraph::inline simulation_internal {

// clang-format off
#define KINEGRAPH_PHYSICS_FUNCTIONS(X) \
  X(mj_makeSpec) X(mj_deleteSpec) X(mj_compile) X(mj_copyModel) X(mj_deleteModel) X(mj_makeData) X(mj_copyData) \
  X(mj_deleteData) X(mj_forward) X(mj_checkPos) X(mj_checkVel) X(mj_fwdPosition) X(mj_comVel) X(mj_sensorPos) \
  X(mj_fwdVelocity) X(mj_sensorVel) X(mj_step2) X(mj_mulM) X(mj_setConst) X(mj_stateSize) X(mj_getState) \
  X(mj_setState) X(mj_contactForce) X(mj_applyFT) X(mj_kinematics) X(mjs_getError) X(mjs_findBody) X(mjs_addBody) \
  X(mjs_addJoint) X(mjs_addFreeJoint) X(mjs_addGeom) X(mjs_addSite) X(mjs_addMesh) X(mjs_addActuator) \
  X(mjs_addTendon) X(mjs_wrapJoint) X(mjs_addEquality) X(mjs_addExclude) X(mjs_addPair) X(mjs_addSensor) X(mjs_setName) \
  X(mjs_setString) X(mjs_setFloat) X(mjs_getId) X(mj_rne) X(mj_solveM) X(mj_jac) X(mj_updateSleep) X(mj_geomDistance)
// clang-format on

/// The functions of MuJoCo that simulation steps call, by their own names.
struct Physics {
  KINEGRAPH_PHYSICS_FUNCTIONS(KINEGRAPH_LIBRARY_MEMBER)
};

/// Returns MuJoCo's functions. The first call loads the library, so programs without simulation do not need it. Throws
/// FileError with the library's name if it is missing.
const Physics& physics();

}  // namespace kinegraph::inline simulation_internal
