#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// What only stands on something that is carried is accelerated by no more, m/s^2.
inline constexpr double kSteady = 2.;

/// How deep shapes may overlap in a plan, and by how much things may miss where they should be, m.
inline constexpr double kOverlap = 1e-3, kOffPlace = 1e-3;

/// Between the surfaces of two frames, m; negative where they overlap.
double gapOf(const Config& scene, const std::string& a, const std::string& b);

/// Hangs an object below a frame where it is, as what is held or stands there.
void hang(Config& scene, const std::string& obj, const std::string& parent);

/// What is level: the cosine of half a degree.
double levelCosine();

/// What the straight motions between rows of a path (T x n) first run into: the limits of a joint, or a pair that overlaps
/// by more than 1 mm; looked at at all times. "" if nothing. The scene's q does not matter.
std::string firstContact(const Config& scene, const MatrixXd& path);
bool isFree(const Config& scene, const MatrixXd& path);

/// The rows of a path at which it turns, with its ends: those inside of a straight piece are left out.
MatrixXd cornersOf(const MatrixXd& path);

/// Where a frame is in each row.
std::vector<Vector3d> positionsAlong(const Config& scene, const MatrixXd& path, const std::string& frame);

/// Does an object move on a level line to 1 mm, without going back or turning, as rows tell?
bool slidesStraight(const Config& scene, const MatrixXd& path, const std::string& obj);

/// The largest acceleration of a frame in a motion that starts and ends at rest, m/s^2, as rows tell.
double accelerationOf(const Config& scene, const MatrixXd& path, const VectorXd& times, const std::string& frame);

}  // namespace kinegraph
