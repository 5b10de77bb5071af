#pragma once

#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph::inline features_internal {
class Feature;
class Feature;
struct FeatureRecipe;
}

namespace kinegraph::inline kinematics_internal {
struct KinematicModel;
class State;
}

namespace kinegraph {

/// Names of features. The numbers are those of the Python enum `ry.FS`.
enum class FeatureSymbol : int {
  position = 0,
  positionDiff = 1,
  positionRel = 2,
  quaternion = 3,
  quaternionDiff = 4,
  quaternionRel = 5,
  pose = 6,
  poseDiff = 7,
  poseRel = 8,
  vectorX = 9,
  vectorXDiff = 10,
  vectorXRel = 11,
  vectorY = 12,
  vectorYDiff = 13,
  vectorYRel = 14,
  vectorZ = 15,
  vectorZDiff = 16,
  vectorZRel = 17,
  scalarProductXX = 18,
  scalarProductXY = 19,
  scalarProductXZ = 20,
  scalarProductYX = 21,
  scalarProductYY = 22,
  scalarProductYZ = 23,
  scalarProductZZ = 24,
  gazeAt = 25,
  angularVel = 26,
  accumulatedCollisions = 27,
  jointLimits = 28,
  distance = 29,
  oppose = 30,
  qItself = 31,
  aboveBox = 33,
  insideBox = 34,
  pairCollision_negScalar = 35,
  pairCollision_vector = 36,
  pairCollision_normal = 37,
  pairCollision_p1 = 38,
  pairCollision_p2 = 39,
  standingAbove = 40,
  totalForce = 41,
  physics = 42,
  contactConstraints = 43,
  energy = 44,
  EqCenterOfMass = 45,
  transAccelerations = 46,
  transVelocities = 47,
  qQuaternionNorms = 48,
  opposeCentral = 49,
  linangVel = 50,
  AlignXWithDiff = 51,
  AlignYWithDiff = 52,
  scalarProductZX = 53,
  scalarProductZY = 54,
  pairCollisions = 55,
  negDistance = distance,  ///< aliases
  jointState = qItself,
};

/// Unit of a component of a feature.
enum class FeatureUnit {
  none,               ///< dimensionless number
  meter,              ///< a length
  radian,             ///< an angle
  joint,              ///< m or rad, depending on the joint of the component
  quaternion,         ///< component of a unit quaternion, or of the difference of two
  direction,          ///< component of a unit vector, or of the difference of two
  cosine,             ///< product of two unit vectors
  meter_per_second,   ///< a velocity
  radian_per_second,  ///< an angular velocity
  newton,             ///< a force
  newton_meter,       ///< a torque
  joule,              ///< an energy
};

/// Returns "m", "rad/s", ...; "-" for none.
const char* unitName(FeatureUnit unit);

/// The joints on which a feature depends.
enum class FeatureDofs {
  of_frames,  ///< joints that move its frames
  of_joints,  ///< joints of its frames; all joints if it has no frames
  of_scene,   ///< joints of all bodies that may collide, or all quaternions
};

/// An entry of the table of features, with everything that is known about a feature.
struct FeatureInfo {
  using Make = std::unique_ptr<Feature> (*)(const FeatureInfo& info, const std::vector<int>& frames,
                                            const KinematicModel& model);

  FeatureSymbol symbol;
  std::string name;
  const char* alias;           ///< another name; null if there is none
  const char* frames;          ///< roles of the frames, one word each
  int min_frames, max_frames;  ///< max -1 for any number
  const char* rows;            ///< number of components, or the quantity that determines it
  FeatureUnit unit;            ///< of the first three components, ...
  FeatureUnit later_unit;      ///< ... and of those after them
  int order;                   ///< order of its own time derivative
  bool second_derivatives;     ///< Feature::hasCurvature may be true, at least for some frames
  FeatureDofs dofs;
  const char* reported_as;  ///< name in reports
  const char* value;        ///< description for users
  Make make;                ///< null for unavailable features, whose `value` says why

  bool available() const { return make != nullptr; }
  FeatureUnit unitOf(int row) const { return row < 3 ? unit : later_unit; }
};

/// Returns the table in reading order. Each symbol occurs once.
const std::vector<FeatureInfo>& featureRegistry();

/// Throws NameError for a number that is not a symbol.
const FeatureInfo& featureInfo(FeatureSymbol symbol);

/// Returns all names with their symbols, including aliases (`negDistance`, `jointState`).
const std::vector<std::pair<std::string, FeatureSymbol>>& featureNames();

/// Throws NameError with similar names.
FeatureSymbol featureSymbolFromName(std::string_view name);

/// Returns the table of features as it is in docs/features.md.
std::string featureTable();

/// Makes the feature of a symbol for the frames with these ids. Throws ValueError for a wrong number of frames, and for
/// frames that lack a box or joint that the feature needs.
std::unique_ptr<Feature> makeFeature(FeatureSymbol symbol, const std::vector<int>& frames, const KinematicModel& model);

/// Source of a feature: a symbol of the registry, a recipe, or a custom function that makes it.
class FeatureSource {
 public:
  /// Makes a feature for the frames with these ids. `state` is any State of the scene.
  using Make = std::function<std::unique_ptr<Feature>(const std::vector<int>& frames, const State& state)>;

  FeatureSource(FeatureSymbol symbol) : source_(symbol) {}
  FeatureSource(FeatureRecipe recipe);
  FeatureSource(std::string name, Make make)
      : source_(std::make_shared<const Custom>(Custom{std::move(name), std::move(make)})) {}

  bool operator==(FeatureSymbol symbol) const { return this->symbol() == symbol; }
  std::optional<FeatureSymbol> symbol() const;  ///< empty for other sources
  const std::string& name() const;              ///< for messages
  const FeatureRecipe* recipe() const;          ///< null for other sources
  const Make* maker() const;                    ///< custom function; null for other sources

  /// Makes the feature. Throws ValueError for invalid frames, as makeFeature does; the message ends with the frames'
  /// names.
  std::unique_ptr<Feature> make(const std::vector<int>& frames, const State& state) const;

 private:
  struct Custom {
    std::string name;
    Make make;
  };
  std::variant<FeatureSymbol, std::shared_ptr<const FeatureRecipe>, std::shared_ptr<const Custom>> source_;
};

/// Factor of a residual: nothing (1), a number, one number per row of the feature, or a matrix that mixes rows.
/// Converts from `10.`, `{1., 1., .1}`, `Vector3d(1., 1., .1)`, or a matrix.
class Scale {
 public:
  Scale() = default;
  Scale(double number) : matrix_(MatrixXd::Constant(1, 1, number)) {}
  Scale(std::initializer_list<double> per_row)
      : matrix_(Eigen::Map<const VectorXd>(per_row.begin(), Eigen::Index(per_row.size()))) {}
  Scale(MatrixXd matrix) : matrix_(std::move(matrix)) {}
  template <class Derived>
  Scale(const Eigen::MatrixBase<Derived>& matrix) : matrix_(matrix) {}

  /// Empty, 1 x 1, a column, or rows x columns.
  const MatrixXd& matrix() const { return matrix_; }

 private:
  MatrixXd matrix_;
};

/// Target of a feature: nothing (0), a number for all rows, or one number per row.
class Target {
 public:
  Target() = default;
  Target(double number) : vector_(VectorXd::Constant(1, number)) {}
  Target(std::initializer_list<double> per_row)
      : vector_(Eigen::Map<const VectorXd>(per_row.begin(), Eigen::Index(per_row.size()))) {}
  Target(VectorXd vector) : vector_(std::move(vector)) {}
  template <class Derived>
  Target(const Eigen::MatrixBase<Derived>& vector) : vector_(vector) {}

  const VectorXd& vector() const { return vector_; }  ///< empty, 1 number, or one per row

 private:
  VectorXd vector_;
};

}  // namespace kinegraph
