#pragma once

#include <string>
#include <string_view>

#include "kinegraph/gfile/parser.h"

namespace kinegraph::inline parsers_internal {

/// Reads a URDF text as the frames of a scene, parents first:
///
///     link                 a frame of that name, with mass, `com` and `inertia`
///     joint                a frame of that name at the joint's origin, moved by the joint; the child link is fixed
///     in
///                          it. Named <joint>_joint if a link has that name.
///     origin of a joint    a frame <joint>_origin between parent link and joint, unless it is the identity
///     visual, collision    child frames <link>_0, <link>_1, ...; collisions are transparent red, with contact -2
///
/// revolute and continuous become hingeX, hingeY, hingeZ, or hinge with an axis; prismatic becomes transX, transY or
/// transZ with a joint_scale of 1 or -1; planar becomes transXYPhi, and floating free. A fixed joint becomes a frame
/// without a joint, which merges the connected links. For a prismatic or planar joint along any other axis the joint
/// frame is rotated to make its x (z) axis that axis, and the child link is rotated back. Effort and velocity limits
/// are stored as `ctrl_limits: [velocity effort -1]`.
///
/// Flaws are mended with a warning: a mesh that is missing or cannot be read is skipped, reversed limits are none, a
/// mimic of multiplier 0 fixes the joint, further links without a joint above them are roots of their own.
/// If the diagnostics contain an error (unknown links, loops, errors of parseUrdf), there are no frames.
ParseResult readUrdf(std::string_view text, const std::string& file, const std::string& folder);

}  // namespace kinegraph::inline parsers_internal
