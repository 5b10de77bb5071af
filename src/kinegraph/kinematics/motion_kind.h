#pragma once

namespace kinegraph {

/// The elementary motions; see MotionStep. Alone in this file with what is known of them, because kernels for wide
/// registers include nothing else, and without functions, because kernels must not share any.
enum class MotionKind : unsigned char {
  translate,    ///< 1 dof: along coordinate axis `axis`, m
  rotate,       ///< 1 dof: about coordinate axis `axis`, rad
  rotateAbout,  ///< 1 dof: about the joint's own unit axis, rad
  quaternion,   ///< 4 dofs: w x y z, normalized
  circle,       ///< 2 dofs: rotation about z by the quaternion (c, 0, 0, s), normalized
  time,         ///< 1 dof without motion
};

/// What all code but the formulas goes by. The formulas are in place_links.h (poses and velocities, for all scalars)
/// and joint.cpp (one pose, and the dofs that make a pose).
struct MotionFacts {
  MotionKind kind;
  int dofs;
  enum class Effect : unsigned char {
    slides,   ///< the dof is a length along a fixed axis
    turns,    ///< the dof is an angle about a fixed axis
    orients,  ///< the dofs make a rotation by their direction; their length is brought to 1, and at rest the first is 1
    none,
  } effect;
};

/// In the order of MotionKind.
constexpr MotionFacts kMotionFacts[] = {
    {MotionKind::translate, 1, MotionFacts::Effect::slides},  {MotionKind::rotate, 1, MotionFacts::Effect::turns},
    {MotionKind::rotateAbout, 1, MotionFacts::Effect::turns}, {MotionKind::quaternion, 4, MotionFacts::Effect::orients},
    {MotionKind::circle, 2, MotionFacts::Effect::orients},    {MotionKind::time, 1, MotionFacts::Effect::none},
};

}  // namespace kinegraph
