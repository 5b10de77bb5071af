#pragma once

#include <string>
#include <string_view>

#include "kinegraph/gfile/parser.h"

namespace kinegraph::inline parsers_internal {

/// Reads an MJCF text (MuJoCo's XML) as the frames of a scene, parents first. q is MuJoCo's qpos, in the same order and
/// units, without the coordinates of joints that follow another:
///
///     worldbody            a frame `world`
///     body                 a frame of that name, with mass, `com` and `inertia`
///     joint                a frame of that name, moved by the joint: hinge, transX/Y/Z or free, quatBall; the body
///                          is fixed in it. A joint without a name, or with the body's, is the body's own frame if
///                          no transform lies in between, else <body>_joint. Its `q` is MuJoCo's initial value
///                          (`ref`, or the pose of a free body).
///     pose of a joint      a frame <joint>_origin before it, unless it is the identity
///     replicate, attach    the bodies that they stand for, with MuJoCo's names
///     geom                 a child frame of that name, or <body>_0, <body>_1, ... with color and contact flag: 0 if
///                          it never collides, else a flag that excludes neighboring bodies; a plane is a `quad`,
///                          20 m wide if it is infinite; geoms of the groups 3 and up are transparent red
///     site                 a child frame with a marker
///     camera               a child frame with a `camera`, rotated by 180 degrees about x: z looks forward and y
///                          down, with `heightAngle`
///     equality/joint       `mimic`, if the polynomial is linear; a constant makes the joint a fixed one
///     contact/exclude      `contact_exclude` of the first body
///
/// A geom of a body without <inertial> has a mass: its own, or computed from its density, except for meshes. A
/// duplicate name gets its element kind appended: <joint>_joint, <site>_site, ... Default classes, <include>, <frame>
/// and the options of <compiler> are applied. A height field is a mesh of convex parts. Actuators, sensors, tendons and
/// the like are ignored with one warning; a mesh with a missing file, or one that cannot be read, is skipped with one
/// warning each. Exclusions and equalities of unknown bodies and joints are left out with a warning, and a range that
/// is not ascending is no limit. If the diagnostics contain an error, there are no frames.
ParseResult readMjcf(std::string_view text, const std::string& file, const std::string& folder);

}  // namespace kinegraph::inline parsers_internal
