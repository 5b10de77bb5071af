#include "kinegraph/task_planning/motions/motion_checks.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "kinegraph/common/text.h"
#include "kinegraph/features/eval.h"
#include "kinegraph/task_planning/grasps.h"
#include "kinegraph/task_planning/task_actions.h"
#include "kinegraph/task_planning/task_tools.h"

namespace kinegraph::inline task_planning_internal {

namespace {

constexpr double kCollinear = 1e-10;  ///< rad or m: deviation up to which three waypoints are collinear

/// The cosine of the angle of the rotation between two orientations.
double turnCosine(const Matrix3d& a, const Matrix3d& b) { return .5 * ((a.transpose() * b).trace() - 1.); }

bool movesWithJoints(const Frame& frame) {
  for (std::optional<Frame> up = frame; up; up = up->getParent())
    if (up->data().moves() && dofSource(up->data()).joint->active) return true;
  return false;
}

double lengthOf(const Vector3d& v) { return std::sqrt(v.x() * v.x() + v.y() * v.y() + v.z() * v.z()); }

}  // namespace

double gapOf(const Config& scene, const std::string& a, const std::string& b) {
  return -eval(scene, FeatureSymbol::distance, {a, b}).y[0];
}

double standingGap(const Config& scene, const std::string& obj, const std::string& place) {
  double gap = gapOf(scene, obj, place);
  for (const Frame& part : shapesOf(scene.getFrame(obj)))
    if (part.data().shape->contact) gap = std::min(gap, gapOf(scene, part.getName(), place));
  return gap;
}

double handGap(const Config& scene, const std::string& obj, const std::string& hand) {
  const Frame body = scene.getFrame(obj);
  double gap = gapOf(scene, obj, hand);
  for (const Frame& part : heldShapes(body)) gap = std::min(gap, gapOf(scene, part.getName(), hand));
  if (isCompound(body)) {  // a hand may close across a hollow body
    const Vector3d at = body.getPose().inverse().transform() * scene.getFrame(hand).getPosition();
    gap = std::min(gap, boxOfBody(body).exteriorDistance(at));
  }
  return gap > 0. ? std::max(gap - fingerReach(scene, hand), 0.) : gap;
}

void hang(Config& scene, const std::string& obj, const std::string& parent) {
  scene.getFrame(obj).setParent(scene.getFrame(parent), true);
  scene.getFrame(obj).setJoint(JointType::rigid);
}

std::vector<std::string> pickBefore(const Config& scene, const std::vector<std::string>& hands,
                                    const std::vector<std::string>& objects) {
  for (const std::string& obj : objects) {
    const std::string hand = holderOf(scene, obj, hands);
    if (hand.empty()) continue;
    const std::vector<Frame> parts = shapesOf(scene.getFrame(obj));
    const auto isPart = [&](int id) {
      return std::ranges::any_of(parts, [&](const Frame& part) { return part.id() == id; });
    };
    for (const Config::NearPair& pair : scene.getCollisions(kOverlap)) {
      if (isPart(pair.a) == isPart(pair.b)) continue;
      const Frame other = scene.getFrame(isPart(pair.a) ? pair.b : pair.a);
      if (!movesWithJoints(other)) return {"pick", obj, other.getName(), hand};
    }
  }
  return {};
}

double levelCosine() {
  static const double cosine = std::cos(.5 * std::numbers::pi / 180.);
  return cosine;
}

std::string firstContact(const Config& scene, const MatrixXd& path, double margin) {
  const MatrixXd corners = cornersOf(path);
  for (Eigen::Index i = 0; i + 1 < corners.rows(); ++i) {
    const auto contact = scene.checkMotion(corners.row(i), corners.row(i + 1), margin);
    if (!contact) continue;
    if (contact->dof >= 0)
      return cat("joint ", scene.getJointNames()[std::size_t(contact->dof)], " is beyond its limits");
    const std::string pair = cat(scene.getFrame(contact->a).getName(), " and ", scene.getFrame(contact->b).getName());
    if (margin > 0. && contact->distance >= 0.)
      return cat(pair, " are ", fixed(1e3 * contact->distance, 1), " mm apart on the way, less than ",
                 fixed(1e3 * margin, 1), " mm");
    return cat(pair, " overlap by ", fixed(-contact->distance, 4), " m on the way");
  }
  return "";
}

bool isFree(const Config& scene, const MatrixXd& path) { return firstContact(scene, path).empty(); }

MatrixXd cornersOf(const MatrixXd& path) {
  if (path.rows() < 2) return path;
  std::vector<Eigen::Index> kept = {0};
  for (Eigen::Index row = 1; row + 1 < path.rows(); ++row) {
    const VectorXd chord = path.row(row + 1) - path.row(kept.back()), offset = path.row(row) - path.row(kept.back());
    const double share = offset.dot(chord) / std::max(chord.dot(chord), 1e-300);
    if (!(share >= 0. && share <= 1.) || (offset - share * chord).cwiseAbs().maxCoeff() > kCollinear)
      kept.push_back(row);
  }
  kept.push_back(path.rows() - 1);
  return path(kept, Eigen::all);
}

std::vector<Vector3d> positionsAlong(const Config& scene, const MatrixXd& path, const std::string& frame) {
  Config C = scene;
  const Frame moved = C.getFrame(frame);
  std::vector<Vector3d> at;
  for (Eigen::Index row = 0; row < path.rows(); ++row) {
    C.setJointState(path.row(row));
    at.push_back(moved.getPosition());
  }
  return at;
}

bool slidesStraight(const Config& scene, const MatrixXd& path, const std::string& obj) {
  const std::vector<Vector3d> at = positionsAlong(scene, path, obj);
  const Vector3d chord = at.back() - at.front();
  const double length = std::max(chord.norm(), 1e-9);
  Config C = scene;
  C.setJointState(path.row(0));
  const Frame moved = C.getFrame(obj);
  const Matrix3d first = moved.getRotationMatrix();
  double before = 0.;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double share = (at[i] - at[0]).dot(chord) / length;
    const double aside = (at[i] - at[0] - share * chord / length).norm();
    if (aside > kOffPlace || std::abs(at[i].z() - at[0].z()) > kOffPlace) return false;
    if (i > 0 && share - before <= -kOffPlace) return false;
    before = share;
    C.setJointState(path.row(Eigen::Index(i)));
    if (turnCosine(first, moved.getRotationMatrix()) < levelCosine()) return false;
  }
  return true;
}

double accelerationOf(const Config& scene, const MatrixXd& path, const VectorXd& times, const std::string& frame) {
  const std::vector<Vector3d> at = positionsAlong(scene, path, frame);
  std::vector<double> steps;
  std::vector<Vector3d> velocity;
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    const double step = times[Eigen::Index(i) + 1] - times[Eigen::Index(i)];
    if (!(step > 0.)) continue;
    steps.push_back(step);
    velocity.push_back((at[i + 1] - at[i]) / step);
  }
  if (velocity.size() < 2) return 0.;
  double most =
      std::max(lengthOf(2. * velocity.front() / steps.front()), lengthOf(2. * velocity.back() / steps.back()));
  for (std::size_t i = 0; i + 1 < velocity.size(); ++i)
    most = std::max(most, lengthOf((velocity[i + 1] - velocity[i]) / (.5 * (steps[i + 1] + steps[i]))));
  return most;
}

}  // namespace kinegraph::inline task_planning_internal
