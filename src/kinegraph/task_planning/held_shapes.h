#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph::inline task_planning_internal {

/// Distance of a grasp from the ends of an object, m.
inline constexpr double kGraspInside = .012;

/// The words of variants "x of knob", "y of all parts".
inline constexpr std::string_view kOfPart = " of ", kAllParts = "all parts";

/// A variant of graspVariants: a way to close the fingers, and the shape that they hold.
struct GraspWords {
  std::string way;   ///< x y z, around, center, off center, or touch
  std::string part;  ///< a frame, or kAllParts

  int axis() const;  ///< 0 to 2 for x y z, else -1
  bool isOfAllParts() const { return part == kAllParts; }
};

GraspWords graspWords(const std::string& obj, const std::string& variant);

/// Returns the shapes of a body that a hand can hold: those that collide, or all if none does.
std::vector<Frame> heldShapes(const Frame& obj);

/// Whether a body has more than the shape of its own frame.
bool isCompound(const Frame& obj);

/// Whether a shape is a cylinder or a capsule.
bool isRoundBody(const Frame& frame);

/// Returns the box around a shape, or around all shapes of a body, in its axes.
Eigen::AlignedBox3d boxOfShape(const Frame& part);
Eigen::AlignedBox3d boxOfBody(const Frame& obj);

/// The part of that box in which fingers that close along an axis meet the body on both sides: that of the parts that
/// reach to both ends. Empty if there is none, as for an L.
Eigen::AlignedBox3d boxAcross(const Frame& obj, int axis);

/// A shape that a variant holds: a box in the axes of a frame.
struct HeldShape {
  Frame frame;
  Eigen::AlignedBox3d box;
};

HeldShape heldShape(const Config& C, const std::string& obj, const GraspWords& words);

/// Heights of a held shape, m.
struct HeldHeights {
  double below = 0.;   ///< of its lowest point above the lowest point of the body, which stands on its ground
  double height = 0.;  ///< of the shape
};

HeldHeights heldHeights(const Config& C, const std::string& obj, const GraspWords& words);

/// An initial guess of a grasp, in the axes of the object.
struct GraspGuess {
  Vector3d at;       ///< position of the hand, m
  Vector3d closing;  ///< the axis along which the fingers close
  Vector3d back;     ///< from the object to the arm
};

/// Finds whether fingers get around the shapes of a body that stands on its ground, with boxes in place of all shapes.
class PartAccess {
 public:
  /// `wide`: the opening of the fingers, m.
  PartAccess(const Config& C, const std::string& obj, double wide);

  /// Returns a guess for a variant, from above if possible; none if fingers or palm do not get there.
  std::optional<GraspGuess> guess(const std::string& variant) const;

 private:
  /// A shape in the axes of the body.
  struct Part {
    RigidTransform X;
    Eigen::AlignedBox3d box;
    double distance(const Vector3d& point) const { return box.exteriorDistance(X.inverse() * point); }
  };

  bool isFree(const GraspGuess& grasp, double half) const;
  bool hasRoom(const Vector3d& point, double room) const;

  const Config& C_;
  const Frame body_;
  const std::string obj_;
  const double wide_;
  std::vector<Part> parts_;
  Vector3d up_;
  double ground_;
};

}  // namespace kinegraph::inline task_planning_internal
