#pragma once

namespace kinegraph {

/// The elementary motions; see MotionStep. This header contains no functions, because kernels for wide registers
/// include it and must not share inline functions.
enum class MotionKind : unsigned char {
  translate,    ///< 1 dof: along coordinate axis `axis`, m
  rotate,       ///< 1 dof: about coordinate axis `axis`, rad
  rotateAbout,  ///< 1 dof: about the joint's unit axis, rad
  quaternion,   ///< 4 dofs: w x y z, normalized
  circle,       ///< 2 dofs: rotation about z by the quaternion (c, 0, 0, s), normalized
  time,         ///< 1 dof without motion
};

/// Properties of the elementary motions, the only part of the code beside the formulas that depends on the kind. The
/// formulas are in place_links.h (poses and velocities, for all scalars) and joint.cpp (a single pose, and the dofs of
/// a pose).
struct MotionFacts {
  MotionKind kind;
  int dofs;
  enum class Effect : unsigned char {
    translates,  ///< the dof is a length along a fixed axis
    rotates,     ///< the dof is an angle about a fixed axis
    orients,     ///< the direction of the dofs is a rotation; their norm is normalized to 1, and the identity is (1, 0,
                 ///< ...)
    none,
  } effect;
};

/// In the order of MotionKind.
constexpr MotionFacts kMotionFacts[] = {
    {MotionKind::translate, 1, MotionFacts::Effect::translates},
    {MotionKind::rotate, 1, MotionFacts::Effect::rotates},
    {MotionKind::rotateAbout, 1, MotionFacts::Effect::rotates},
    {MotionKind::quaternion, 4, MotionFacts::Effect::orients},
    {MotionKind::circle, 2, MotionFacts::Effect::orients},
    {MotionKind::time, 1, MotionFacts::Effect::none},
};

}  // namespace kinegraph
