#pragma once

#include "kinegraph/perception/register_scene.h"
#include "kinegraph/rendering/camera_renderer.h"

namespace kinegraph {

/// Points the frame "cam" at the middle of the table from above its front edge.
inline void aimCamera(Config& C) {
  const Vector3d eye(0., -.8, 1.3), z = (Vector3d(0., .05, .65) - eye).normalized();
  const Vector3d x = z.cross(Vector3d::UnitZ()).normalized();
  Matrix3d R;
  R << x, z.cross(x), z;
  C.getFrame("cam").setPose(Pose(eye, Quaterniond(R)));
}

/// The depth image of the frame "cam".
inline DepthView imageOf(const Config& C) {
  CameraRenderer renderer;
  const Camera from = cameraOf(C.getFrame("cam"));
  DepthView view;
  view.depth = renderer.render(*C.scene(), from, true).depth;
  view.width = from.width;
  view.height = from.height;
  view.fxycxy = from.fxycxy();
  view.camera = "cam";
  return view;
}

}  // namespace kinegraph
