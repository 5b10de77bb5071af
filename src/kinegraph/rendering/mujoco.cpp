#include "kinegraph/rendering/mujoco.h"

#include <mutex>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline rendering_internal {

namespace {

void throwErrors(const mjLogMessage* message) {
  if (message->level == mjLOG_ERROR) throw Error(cat("MuJoCo: ", message->subject));
}

/// Installs our error handler for the first user and restores the former with the last: MuJoCo has one for all threads.
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
  const DynamicLibrary library(KINEGRAPH_MUJOCO_LIBRARY, "a camera image", "mj_step");
  Mujoco functions;
  KINEGRAPH_MUJOCO_FUNCTIONS(KINEGRAPH_LIBRARY_LOAD)
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

}  // namespace kinegraph::inline rendering_internal
