#include "kinegraph/rendering/mujoco.h"

#include <mutex>

#include "kinegraph/base/dynamic_library.h"
#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"

namespace kinegraph {

namespace {

void throwErrors(const mjLogMessage* message) {
  if (message->level == mjLOG_ERROR) throw Error(cat("MuJoCo: ", message->subject));
}

/// MuJoCo has one handler for all threads: the first that asks sets ours, the last one takes it back.
struct HandlerUse {
  std::mutex mutex;
  int users = 0;
  mjfLogHandler before = nullptr;
};

HandlerUse& handlerUse() {
  static HandlerUse use;
  return use;
}

Mujoco loadMujoco() {
  const DynamicLibrary library(KINEGRAPH_MUJOCO_LIBRARY, "a camera image");
  Mujoco functions;
  library.load(functions.mj_makeSpec, "mj_makeSpec");
  library.load(functions.mj_deleteSpec, "mj_deleteSpec");
  library.load(functions.mj_compile, "mj_compile");
  library.load(functions.mj_deleteModel, "mj_deleteModel");
  library.load(functions.mjs_getError, "mjs_getError");
  library.load(functions.mju_setLogHandler, "mju_setLogHandler");
  library.load(functions.mjv_defaultScene, "mjv_defaultScene");
  library.load(functions.mjv_makeScene, "mjv_makeScene");
  library.load(functions.mjv_freeScene, "mjv_freeScene");
  library.load(functions.mjv_initGeom, "mjv_initGeom");
  library.load(functions.mjr_defaultContext, "mjr_defaultContext");
  library.load(functions.mjr_makeContext, "mjr_makeContext");
  library.load(functions.mjr_freeContext, "mjr_freeContext");
  library.load(functions.mjr_resizeOffscreen, "mjr_resizeOffscreen");
  library.load(functions.mjr_setBuffer, "mjr_setBuffer");
  library.load(functions.mjr_render, "mjr_render");
  library.load(functions.mjr_readPixels, "mjr_readPixels");
  library.load(functions.mjr_rectangle, "mjr_rectangle");
  library.load(functions.mjr_text, "mjr_text");
  return functions;
}

}  // namespace

const Mujoco& mujoco() {
  static const Mujoco functions = loadMujoco();
  return functions;
}

MujocoErrors::MujocoErrors() {
  HandlerUse& use = handlerUse();
  const std::lock_guard lock(use.mutex);
  if (use.users++ == 0) use.before = mujoco().mju_setLogHandler(throwErrors);
}

MujocoErrors::~MujocoErrors() {
  HandlerUse& use = handlerUse();
  const std::lock_guard lock(use.mutex);
  if (--use.users == 0) mujoco().mju_setLogHandler(use.before);
}

MujocoModel emptyModel() {
  const Mujoco& mj = mujoco();
  const std::unique_ptr<mjSpec, decltype(mj.mj_deleteSpec)> spec(mj.mj_makeSpec(), mj.mj_deleteSpec);
  MujocoModel model(mj.mj_compile(spec.get(), nullptr), mj.mj_deleteModel);
  if (!model) throw Error(cat("MuJoCo: ", mj.mjs_getError(spec.get())));
  return model;
}

}  // namespace kinegraph
