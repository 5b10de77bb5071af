#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinegraph/math/pose.h"
#include "kinegraph/parsers/mjcf/mjcf_document.h"
#include "kinegraph/parsers/xml/findings.h"

namespace kinegraph::inline parsers_internal {

/// Guesses whether the angles of a model are in the other unit than `<compiler angle>` says, and asks once per kind.
class MjcfAngleUnits {
 public:
  explicit MjcfAngleUnits(Findings& findings) : findings_(findings) {}

  /// Checks the range of a hinge, in the unit of the model.
  void addRange(const SourcePosition& where, const std::vector<double>& range, bool degrees);

  /// Checks an Euler angle or the angle about an axis.
  void addRotation(const SourcePosition& where, double angle, bool degrees);

  /// Asks about the ranges, after all have been read: in a model in radians, all are within a turn of 6.28.
  void ask();

 private:
  Findings& findings_;
  SourcePosition where_;  ///< of the first range that is no round number
  std::string range_;
  bool all_within_turn_ = true, asked_ = false;
};

/// Reads the attributes of MJCF elements as numbers, keywords and poses. Invalid values are reported and replaced by
/// the default.
class MjcfValues {
 public:
  MjcfValues(const MjcfDocument& document, Findings& findings)
      : document_(document), findings_(findings), angle_units_(findings) {}

  double number(const MjcfElement& element, const char* name, double fallback);
  Vector3d vector(const MjcfElement& element, const char* name, const Vector3d& fallback);

  /// Returns `count` numbers, or none.
  std::vector<double> numbers(const MjcfElement& element, const char* name, std::size_t count);

  /// Returns lower and upper limit, which may be infinite, or none.
  std::vector<double> limits(const MjcfElement& element, const char* name);

  /// Returns the 4 numbers of `rgba`, or none. Other counts are read with a warning: looks are no reason to refuse.
  std::vector<double> color(const MjcfElement& element);

  /// Returns up to `most` numbers, or none. If an element gives fewer than its defaults, the defaults supply the
  /// rest.
  std::vector<double> upTo(const MjcfElement& element, const char* name, std::size_t most);

  /// Returns one of `keywords`; `fallback` if the attribute is missing.
  std::string keyword(const MjcfElement& element, const char* name, const std::vector<std::string>& keywords,
                      const std::string& fallback);

  /// An angle of an element, in the units of its model.
  double radians(const MjcfElement& element, double angle) const;

  /// Guesses of the units of all angles read.
  MjcfAngleUnits& angleUnits() { return angle_units_; }

  /// Pose from `pos` and one of quat, axisangle, xyaxes, zaxis, euler.
  Pose pose(const MjcfElement& element);

  /// From `fromto`: a pose with the z axis along the line and the origin at its midpoint, and the length of the line.
  std::optional<std::pair<Pose, double>> line(const MjcfElement& element);

 private:
  std::optional<std::vector<double>> parse(const MjcfElement& element, const XmlAttribute& attribute, std::size_t least,
                                           std::size_t most);
  std::optional<Quaterniond> rotation(const MjcfElement& element, const XmlAttribute& attribute);

  const MjcfDocument& document_;
  Findings& findings_;
  MjcfAngleUnits angle_units_;
};

/// The shortest rotation of the z axis to the direction of `v`.
Quaterniond rotationOfZTo(const Vector3d& v);

}  // namespace kinegraph::inline parsers_internal
