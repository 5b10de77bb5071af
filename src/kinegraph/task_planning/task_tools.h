#pragma once

#include <string>
#include <utility>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// The center of mass of a body, with all that is fixed to it, in the coordinates of its frame, m. Where no part has a mass,
/// each has that of its surface, as in a simulation.
Vector3d centerOfBody(const Frame& body);

/// Whether that is so near to the frame that it can be taken for its center: to 1 mm.
bool isCentered(const Vector3d& center);

/// Does what touches a place along its lower side rest there: is its center of mass above what both share? To 1 mm, as the
/// scene is. The place is a box that is level.
bool isSupported(const Frame& obj, const Frame& place);

/// Pairs of frames that overlap by more than `depth` (m) where hands hold objects: a part of what is held, and one of the robot.
/// Models of hands are wider than hands, and what is held may have turned or slipped.
using FramePairs = std::vector<std::pair<std::string, std::string>>;
FramePairs wedgedPairs(const Config& C, const std::vector<std::string>& hands, const std::vector<std::string>& objects,
                       double depth);

/// Lets pairs never collide, or again.
void ignorePairs(Config& C, const FramePairs& pairs);
void mindPairs(Config& C, const FramePairs& pairs);

/// The frames of a body that have a shape: its own, and those that are fixed to it.
std::vector<Frame> shapesOf(const Frame& body);

/// The axis of a bar (0 to 2) that points up where its tool lies flat: of the two across it that along which the tool is
/// thinner.
int flatAxis(const Frame& bar, const Frame& tool);

/// Up to which height above the ground an object can be pulled, without acceleration, and does not tip: depth / (2 friction),
/// m. `depth` is that of its base along the pull; the friction is the mean of that of the object and that of the place, as in
/// a simulation. Infinite without friction.
double tippingHeight(const Frame& obj, const Frame& place, double depth);

}  // namespace kinegraph
