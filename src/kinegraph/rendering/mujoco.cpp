#include "kinegraph/rendering/mujoco.h"

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"

namespace kinegraph {

namespace {

void throwErrors(const mjLogMessage* message) {
  if (message->level == mjLOG_ERROR) throw Error(cat("MuJoCo's renderer: ", message->subject));
}

}  // namespace

MujocoErrors::MujocoErrors() : before_(mju_setLogHandler(throwErrors)) {}
MujocoErrors::~MujocoErrors() { mju_setLogHandler(before_); }

MujocoModel emptyModel() {
  const std::unique_ptr<mjSpec, decltype(&mj_deleteSpec)> spec(mj_makeSpec(), mj_deleteSpec);
  MujocoModel model(mj_compile(spec.get(), nullptr), mj_deleteModel);
  if (!model) throw Error(cat("MuJoCo's renderer: ", mjs_getError(spec.get())));
  return model;
}

}  // namespace kinegraph
