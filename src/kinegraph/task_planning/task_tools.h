#pragma once

#include <string>
#include <utility>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph::inline task_planning_internal {

/// Returns the center of mass of a body with everything fixed to it, in frame coordinates, m. If no part has a mass,
/// masses are proportional to surfaces, as in a simulation.
Vector3d centerOfBody(const Frame& body);

/// Whether a center of mass coincides with the origin of the frame, to 1 mm.
bool isCentered(const Vector3d& center);

/// Whether an object that touches a place rests there: its center of mass is above the area that both share, to 1 mm,
/// in the current scene. The place is a level box.
bool isSupported(const Frame& obj, const Frame& place);

/// Whether the shape of an object is a ball.
bool isBall(const Frame& obj);

/// Returns the distance of the center of mass of a standing object from the edges of that area, m: the error of its
/// position up to which it does not tip. Negative if it falls over. Of a ball, the distance from the edges of the
/// place.
double supportOf(const Frame& obj, const Frame& place);

/// The force with which hands hold objects, as planned and as executed, N.
inline constexpr double kHoldingForce = 40.;

/// Returns the mass of a body with all parts fixed to it, kg; 0 if none is said.
double massOfBody(const Frame& body);

/// Returns the level distance of a center of mass from the fingers from which on the weight of the object turns it in
/// the hand, m: the attribute `lever` of its frame, or what usual fingers withstand, whichever is less. Infinite
/// without a mass.
double leverOf(const Frame& body);

/// Returns the level distance of the center of mass of a body from a hand, m. Pads withstand twice as much along the
/// axis along which the fingers close as across it: half of the distance along it counts.
double leverIn(const Frame& hand, const Frame& body);

/// Returns the acceleration up to which usual fingers keep an object from swinging in the hand, m/s^2; infinite without
/// a mass.
double steadyAcceleration(const Frame& hand, const Frame& body);

/// Returns the pairs of frames, one of a held object and one of the robot, that overlap by more than `depth` (m). Such
/// overlaps occur because models of hands are wider than hands, and held objects rotate or slip.
using FramePairs = std::vector<std::pair<std::string, std::string>>;
FramePairs wedgedPairs(const Config& C, const std::vector<std::string>& hands, const std::vector<std::string>& objects,
                       double depth);

/// Excludes pairs from collisions, or includes them again.
void ignorePairs(Config& C, const FramePairs& pairs);
void includePairs(Config& C, const FramePairs& pairs);

/// Returns the frames with a shape of a body: its own, and those fixed to it.
std::vector<Frame> shapesOf(const Frame& body);

/// Returns the rotation that stands an object on level ground as it lies now: the side that points up stays up, and the
/// rotation about the vertical is dropped, so that its axes, or that of a lying cylinder, are along x and y. Identity
/// for upright objects and balls. The nearest side counts for boxes, cylinders, and objects in a hand.
Matrix3d restingRotation(const Frame& obj);

/// Returns the depth of the lowest point of a shape in the pose X below the origin of the world, m.
double depthOfShape(const Frame& part, const RigidTransform& X);

/// Returns the height of the origin of a body above its lowest point after a rotation, m.
double depthBelow(const Frame& obj, const Matrix3d& rotation);

/// Returns the axis of a bar (0 to 2) that points up if its tool lies flat: the one across the bar along which the tool
/// is thinner.
int flatAxis(const Frame& bar, const Frame& tool);

/// Returns the height above the ground up to which a slow pull does not tip an object: depth / (2 friction), m. `depth`
/// is that of its base along the pull. The friction is the mean of those of the object and the place, as in a
/// simulation. Infinite without friction.
double tippingHeight(const Frame& obj, const Frame& place, double depth);

}  // namespace kinegraph::inline task_planning_internal
