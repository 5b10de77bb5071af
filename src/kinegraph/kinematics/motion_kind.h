#pragma once

namespace kinegraph {

/// The elementary motions; see MotionStep. Alone in this file, because kernels for wide registers include nothing else.
enum class MotionKind : unsigned char {
  translate,    ///< 1 dof: along coordinate axis `axis`, m
  rotate,       ///< 1 dof: about coordinate axis `axis`, rad
  rotateAbout,  ///< 1 dof: about the joint's own unit axis, rad
  quaternion,   ///< 4 dofs: w x y z, normalized
  circle,       ///< 2 dofs: rotation about z by the quaternion (c, 0, 0, s), normalized
  time,         ///< 1 dof without motion
};

}  // namespace kinegraph
