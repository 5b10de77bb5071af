#pragma once

#include <string>
#include <string_view>

#include "kinegraph/gfile/parser.h"

namespace kinegraph {

/// Reads a URDF text as the frames of a scene, parents first:
///
///     link                 a frame of that name, with mass, `com` and `inertia`
///     joint                a frame of that name at the joint's origin, moved by the joint; the child link sits in it.
///                          Named <joint>_joint if there is a link of that name.
///     origin of a joint    a frame <joint>_origin between parent link and joint, if it is not the identity
///     visual, collision    child frames <link>_0, <link>_1, ...; collisions are transparent red, with contact -2
///
/// revolute and continuous are hingeX, hingeY, hingeZ, or hinge with an axis; prismatic is transX, transY or transZ
/// with a joint_scale of 1 or -1; planar is transXYPhi and floating is free. A fixed joint is a frame without a joint,
/// so that what is fixed together counts as one link. For a prismatic or planar joint about any other axis the joint
/// frame is turned so that its x (z) axis is that axis, and the child link is turned back. Effort and velocity limits
/// are kept as `ctrl_limits: [velocity effort -1]`. A mesh whose file is missing is left out with a warning.
///
/// With an error among the diagnostics (unknown links, several roots, loops, and what parseUrdf finds) there are no
/// frames.
ParseResult readUrdf(std::string_view text, const std::string& file, const std::string& folder);

}  // namespace kinegraph
