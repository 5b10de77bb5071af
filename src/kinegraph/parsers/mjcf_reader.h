#pragma once

#include <string>
#include <string_view>

#include "kinegraph/gfile/parser.h"

namespace kinegraph {

/// Reads an MJCF text (MuJoCo's XML) as the frames of a scene, parents first. q is MuJoCo's qpos, in the same order and
/// units, but for joints that follow another:
///
///     worldbody            a frame `world`
///     body                 a frame of that name, with mass, `com` and `inertia`
///     joint                a frame of that name, moved by the joint: hinge, transX/Y/Z or free, quatBall; the body
///                          sits in it. A joint without a name, or with the body's, is the body's own frame if nothing
///                          lies in between, else <body>_joint. Its `q` is what MuJoCo starts with (`ref`, or the pose
///                          of a free body).
///     ... its place        a frame <joint>_origin before it, if it is not the identity
///     geom                 a child frame of that name, or <body>_0, <body>_1, ... with color and contact flag: 0 if
///                          it never collides, else such that neighboring bodies do not collide; a plane is a `quad`,
///                          20 m wide where it has no end; geoms of the groups 3 and up are transparent red
///     site                 a child frame with a marker
///     camera               a child frame with a `camera`: turned by 180 degrees about x, so that z looks forward and y
///                          down, with `heightAngle`
///     equality/joint       `mimic`, if the polynomial is linear; a constant makes the joint a fixed one
///     contact/exclude      `contact_exclude` of the first body
///
/// A geom of a body without <inertial> has a mass: its own, or by its density, but for meshes.
/// A name that is taken gets what it names behind it: <joint>_joint, <site>_site, ... Default classes, <include>,
/// <frame> and the options of <compiler> are carried out. Actuators, sensors, tendons and the like are left out with
/// one warning, a mesh whose file is missing with one each. With an error among the diagnostics there are no frames.
ParseResult readMjcf(std::string_view text, const std::string& file, const std::string& folder);

}  // namespace kinegraph
