#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph::inline task_planning_internal {

/// Maximum acceleration of objects that stand on a carried object, m/s^2.
inline constexpr double kSteady = 2.;

/// Maximum overlap of shapes in a plan, and tolerance of the positions of objects, m.
inline constexpr double kOverlap = 1e-3, kOffPlace = 1e-3;

/// Returns the signed distance between the surfaces of two frames, m.
double gapOf(const Config& scene, const std::string& a, const std::string& b);

/// The same between an object, with all parts fixed to it, and what it stands on.
double standingGap(const Config& scene, const std::string& obj, const std::string& place);

/// The same between an object and the nearest point that the fingers of a hand reach: none is farther from its frame.
double handGap(const Config& scene, const std::string& obj, const std::string& hand);

/// Attaches an object to a frame in its current pose, as a held or standing object.
void hang(Config& scene, const std::string& obj, const std::string& parent);

/// Returns the action pick after which a hand holds an object that still touches what it stood on at the q of the
/// scene; empty if there is none.
std::vector<std::string> pickBefore(const Config& scene, const std::vector<std::string>& hands,
                                    const std::vector<std::string>& objects);

/// The cosine of half a degree, the tolerance of level axes.
double levelCosine();

/// Returns the first violation along the piecewise linear path (T, n): a joint limit, or a pair that is closer than
/// `margin`, checked continuously; "" if there is none. Without a margin, pairs may overlap by 1 mm. The scene's q does
/// not matter.
std::string firstContact(const Config& scene, const MatrixXd& path, double margin = -kOverlap);
bool isFree(const Config& scene, const MatrixXd& path);

/// Returns the corners of a path, (K, n), ends included: waypoints inside of straight pieces are dropped.
MatrixXd cornersOf(const MatrixXd& path);

/// Returns the position of a frame at each waypoint.
std::vector<Vector3d> positionsAlong(const Config& scene, const MatrixXd& path, const std::string& frame);

/// Whether an object moves along a level line to 1 mm, without reversal or rotation, at the waypoints.
bool slidesStraight(const Config& scene, const MatrixXd& path, const std::string& obj);

/// Returns the largest acceleration of a frame in a motion from rest to rest, m/s^2, by differences of waypoints.
double accelerationOf(const Config& scene, const MatrixXd& path, const VectorXd& times, const std::string& frame);

}  // namespace kinegraph::inline task_planning_internal
