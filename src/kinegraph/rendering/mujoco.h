#pragma once

#include <mujoco/mujoco.h>

#include <memory>

#include "kinegraph/common/dynamic_library.h"

namespace kinegraph::inline rendering_internal {

// clang-format off
# define KINEGRAPH_MUJOCO_FUNCTIONS(X) \
  X(mj_makeSpec) X(mj_deleteSpec) X(mj_compile) X(mj_deleteModel) X(mjs_getError) X(mju_setLogHandler) \
  X(mjv_defaultScene) X(mjv_makeScene) X(mjv_freeScene) X(mjv_initGeom) X(mjr_defaultContext) X(mjr_makeContext) \
  X(mjr_freeContext) X(mjr_resizeOffscreen) X(mjr_setBuffer) X(mjr_render) X(mjr_readPixels) X(mjr_rectangle) \
  X(mjr_text)
// clang-format on

/// The used functions of MuJoCo, by their own names.
struct Mujoco {
  KINEGRAPH_MUJOCO_FUNCTIONS(KINEGRAPH_LIBRARY_MEMBER)
};

/// Returns MuJoCo's functions. The first call loads the library, so programs without camera images do not need it.
/// Throws FileError with the library's name if it is missing.
const Mujoco& mujoco();

/// While an object exists, errors of MuJoCo are thrown as Error instead of ending the process, and warnings write no
/// log file. Each thread may have its own.
class MujocoErrors {
 public:
  MujocoErrors();
  ~MujocoErrors();
  MujocoErrors(const MujocoErrors&) = delete;
  MujocoErrors& operator=(const MujocoErrors&) = delete;
};

using MujocoModel = std::unique_ptr<mjModel, decltype(&mj_deleteModel)>;

/// Returns an empty model, from which a rendering context is created.
MujocoModel emptyModel();

}  // namespace kinegraph::inline rendering_internal
