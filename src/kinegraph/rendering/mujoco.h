#pragma once

#include <mujoco/mujoco.h>

#include <memory>

namespace kinegraph {

/// While it lives, errors of MuJoCo are thrown as Error instead of ending the process, and warnings write no log file.
class MujocoErrors {
 public:
  MujocoErrors();
  ~MujocoErrors();
  MujocoErrors(const MujocoErrors&) = delete;
  MujocoErrors& operator=(const MujocoErrors&) = delete;

 private:
  mjfLogHandler before_;
};

using MujocoModel = std::unique_ptr<mjModel, decltype(&mj_deleteModel)>;

/// A model of nothing: what a rendering context is made from.
MujocoModel emptyModel();

}  // namespace kinegraph
