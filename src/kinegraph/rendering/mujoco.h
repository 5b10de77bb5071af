#pragma once

#include <mujoco/mujoco.h>

#include <memory>

namespace kinegraph {

/// The functions of MuJoCo that are used here, by their own names.
struct Mujoco {
  decltype(&::mj_makeSpec) mj_makeSpec;
  decltype(&::mj_deleteSpec) mj_deleteSpec;
  decltype(&::mj_compile) mj_compile;
  decltype(&::mj_deleteModel) mj_deleteModel;
  decltype(&::mjs_getError) mjs_getError;
  decltype(&::mju_setLogHandler) mju_setLogHandler;
  decltype(&::mjv_defaultScene) mjv_defaultScene;
  decltype(&::mjv_makeScene) mjv_makeScene;
  decltype(&::mjv_freeScene) mjv_freeScene;
  decltype(&::mjv_initGeom) mjv_initGeom;
  decltype(&::mjr_defaultContext) mjr_defaultContext;
  decltype(&::mjr_makeContext) mjr_makeContext;
  decltype(&::mjr_freeContext) mjr_freeContext;
  decltype(&::mjr_resizeOffscreen) mjr_resizeOffscreen;
  decltype(&::mjr_setBuffer) mjr_setBuffer;
  decltype(&::mjr_render) mjr_render;
  decltype(&::mjr_readPixels) mjr_readPixels;
  decltype(&::mjr_rectangle) mjr_rectangle;
  decltype(&::mjr_text) mjr_text;
};

/// MuJoCo, loaded by the first call: a program that draws no camera images does without. Throws FileError, which names
/// the library, if it is missing.
const Mujoco& mujoco();

/// While one lives, errors of MuJoCo are thrown as Error instead of ending the process, and warnings write no log file.
/// Threads may have one each.
class MujocoErrors {
 public:
  MujocoErrors();
  ~MujocoErrors();
  MujocoErrors(const MujocoErrors&) = delete;
  MujocoErrors& operator=(const MujocoErrors&) = delete;
};

using MujocoModel = std::unique_ptr<mjModel, decltype(&mj_deleteModel)>;

/// A model of nothing: what a rendering context is made from.
MujocoModel emptyModel();

}  // namespace kinegraph
