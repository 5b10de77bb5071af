#include "kinegraph/parsers/mjcf/mjcf_values.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kinegraph/common/guessed_units.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline parsers_internal {

namespace {

constexpr double kTiny = 1e-10;  // shorter directions count as zero

struct Rotation {
  const char* name;
  std::size_t numbers;
};
constexpr Rotation kRotations[] = {{"quat", 4}, {"axisangle", 4}, {"xyaxes", 6}, {"zaxis", 3}, {"euler", 3}};

constexpr double kTurn = 2. * std::numbers::pi + .01;
constexpr double kRounding = 2e-3;  // of 1.57 and 3.14

/// Whether a number is a multiple of a quarter turn in radians, such as 1.57.
bool isQuarterTurn(double angle) {
  const double quarters = std::round(angle / (.5 * std::numbers::pi));
  return quarters != 0. && std::abs(quarters) <= 4. && std::abs(angle - quarters * .5 * std::numbers::pi) < kRounding;
}

/// An attribute with its value, shortened.
std::string shown(const MjcfElement& element, const XmlAttribute& attribute) {
  constexpr std::size_t kLongest = 60;
  const std::string& value = attribute.value;
  return cat(element.describe(), " ", attribute.name, "=\"", value.substr(0, kLongest),
             value.size() > kLongest ? "..." : "", "\"");
}

}  // namespace

void MjcfAngleUnits::addRange(const SourcePosition& where, const std::vector<double>& range, bool degrees) {
  if (!degrees) return;  // the reader of scenes asks about large angles in radians
  const bool is_round = std::ranges::all_of(range, [](double v) { return mayBeDegrees(v, 0.); });
  all_within_turn_ = all_within_turn_ && std::ranges::all_of(range, [](double v) { return std::abs(v) <= kTurn; });
  if (is_round || !range_.empty()) return;
  where_ = where;
  range_ = cat(range[0], " ", range[1]);
}

void MjcfAngleUnits::addRotation(const SourcePosition& where, double angle, bool degrees) {
  if (asked_ || !(degrees ? isQuarterTurn(angle) : mayBeDegrees(angle, kTurn))) return;
  findings_.warn(where, degrees ? cat("a rotation by ", angle, " degrees; did you mean radians? <compiler angle> is ",
                                      "\"degree\" unless the file says angle=\"radian\"")
                                : cat("a rotation by ", angle, " rad; ", askForRadians(angle)));
  asked_ = true;
}

void MjcfAngleUnits::ask() {
  if (range_.empty() || !all_within_turn_) return;
  findings_.warn(where_, cat("the range ", range_,
                             " is in degrees; did you mean radians? <compiler angle> is "
                             "\"degree\" unless the file says angle=\"radian\""));
}

Quaterniond rotationOfZTo(const Vector3d& v) {
  const Vector3d direction = v.normalized(), axis = Vector3d::UnitZ().cross(direction);
  if (axis.norm() < kTiny) return direction[2] > 0. ? Quaterniond::Identity() : Quaterniond(0., 1., 0., 0.);
  return Quaterniond(Eigen::AngleAxisd(std::atan2(axis.norm(), direction[2]), axis.normalized()));
}

std::optional<std::vector<double>> MjcfValues::parse(const MjcfElement& element, const XmlAttribute& attribute,
                                                     std::size_t least, std::size_t most) {
  const auto fits = [&](const auto& found) { return found && found->size() >= least && found->size() <= most; };
  if (auto found = numbersIn(attribute.value); fits(found)) return found;
  const bool may_be_listed = least == most && least > 1;  // otherwise "0,8" may be the decimal number 0.8
  if (auto listed = numbersBetweenCommas(attribute.value); may_be_listed && fits(listed)) {
    findings_.warn(attribute.where, cat(shown(element, attribute), ": the commas are read as blanks"));
    return listed;
  }
  findings_.error(attribute.where,
                  cat(shown(element, attribute), ": expected ", least == most ? "" : cat(least, " to "), most,
                      most == 1 ? " number" : " numbers"));
  return std::nullopt;
}

std::vector<double> MjcfValues::numbers(const MjcfElement& element, const char* name, std::size_t count) {
  const XmlAttribute* attribute = element.attribute(name);
  return attribute ? parse(element, *attribute, count, count).value_or(std::vector<double>{}) : std::vector<double>{};
}

std::vector<double> MjcfValues::limits(const MjcfElement& element, const char* name) {
  const XmlAttribute* attribute = element.attribute(name);
  const auto found = attribute ? limitsIn(attribute->value) : std::nullopt;
  return found && found->size() == 2 ? *found : numbers(element, name, 2);
}

std::vector<double> MjcfValues::color(const MjcfElement& element) {
  const XmlAttribute* attribute = element.attribute("rgba");
  if (!attribute) return {};
  std::vector<double> given = numbersIn(attribute->value).value_or(std::vector<double>{});
  if (given.size() == 4) return given;
  const bool enough = given.size() >= 3;
  findings_.warn(attribute->where, cat(shown(element, *attribute), ": expected 4 numbers; ",
                                       !enough             ? "the color is left out"
                                       : given.size() == 3 ? "the alpha is read as 1"
                                                           : "the first 4 are read"));
  given.resize(enough ? 4 : 0, 1.);
  return given;
}

std::vector<double> MjcfValues::upTo(const MjcfElement& element, const char* name, std::size_t most) {
  std::vector<double> all;
  for (const XmlAttribute* layer : element.layers(name)) {
    const std::vector<double> some = parse(element, *layer, 1, most).value_or(std::vector<double>{});
    all.resize(std::max(all.size(), some.size()));
    std::copy(some.begin(), some.end(), all.begin());
  }
  return all;
}

double MjcfValues::number(const MjcfElement& element, const char* name, double fallback) {
  const std::vector<double> v = numbers(element, name, 1);
  return v.empty() ? fallback : v[0];
}

Vector3d MjcfValues::vector(const MjcfElement& element, const char* name, const Vector3d& fallback) {
  const std::vector<double> v = numbers(element, name, 3);
  return v.empty() ? fallback : Vector3d(v[0], v[1], v[2]);
}

std::string MjcfValues::keyword(const MjcfElement& element, const char* name, const std::vector<std::string>& keywords,
                                const std::string& fallback) {
  const XmlAttribute* attribute = element.attribute(name);
  if (!attribute) return fallback;
  if (std::find(keywords.begin(), keywords.end(), attribute->value) != keywords.end()) return attribute->value;
  findings_.error(attribute->where, cat(element.describe(), " ", name, "=\"", attribute->value, "\": expected one of ",
                                        join(keywords), similarHint(attribute->value, keywords)));
  return fallback;
}

double MjcfValues::radians(const MjcfElement& element, double angle) const {
  return document_.settingsAt(element.where()).degrees ? angle / 180. * M_PI : angle;
}

std::optional<Quaterniond> MjcfValues::rotation(const MjcfElement& element, const XmlAttribute& attribute) {
  const std::string& name = attribute.name;
  const auto* kind =
      std::find_if(std::begin(kRotations), std::end(kRotations), [&](const Rotation& r) { return name == r.name; });
  const auto v = parse(element, attribute, kind->numbers, kind->numbers);
  if (!v) return std::nullopt;
  const auto refuse = [&](const char* message) {
    findings_.error(attribute.where, cat(element.describe(), " ", name, "=\"", attribute.value, "\": ", message));
    return std::nullopt;
  };
  if (name == "quat") {
    const Quaterniond q((*v)[0], (*v)[1], (*v)[2], (*v)[3]);
    if (!(q.norm() > kTiny)) return refuse("the quaternion is zero");
    return q.normalized();
  }
  const MjcfSettings& settings = document_.settingsAt(attribute.where);
  if (name == "euler") {
    for (const double angle : *v) angle_units_.addRotation(attribute.where, angle, settings.degrees);
    return mjcfEuler(*v, settings);
  }
  const Vector3d first((*v)[0], (*v)[1], (*v)[2]);
  if (!(first.norm() > kTiny)) return refuse("the axis is zero");
  if (name == "axisangle") {
    angle_units_.addRotation(attribute.where, (*v)[3], settings.degrees);
    return Quaterniond(Eigen::AngleAxisd(radians(element, (*v)[3]), first.normalized()));
  }
  if (name == "zaxis") return rotationOfZTo(first);
  Matrix3d R;
  R.col(0) = first.normalized();
  const Vector3d second((*v)[3], (*v)[4], (*v)[5]);
  R.col(1) = second - R.col(0).dot(second) * R.col(0);
  if (!(R.col(1).norm() > kTiny)) return refuse("the two axes are parallel");
  R.col(1).normalize();
  R.col(2) = R.col(0).cross(R.col(1));
  return Quaterniond(R).normalized();
}

Pose MjcfValues::pose(const MjcfElement& element) {
  Pose pose;
  pose.p = vector(element, "pos", Vector3d::Zero());
  const XmlAttribute* given = nullptr;
  for (const Rotation& kind : kRotations) {
    const XmlAttribute* own = element.own(kind.name);
    if (own && given) {
      findings_.error(own->where, cat(element.describe(), ": '", kind.name, "' and '", given->name,
                                      "' both give the rotation; expected one of them"));
    }
    if (own) given = own;
  }
  for (const Rotation& kind : kRotations) {
    if (!given) given = element.attribute(kind.name);
  }
  if (given) pose.q = rotation(element, *given).value_or(Quaterniond::Identity());
  return pose;
}

std::optional<std::pair<Pose, double>> MjcfValues::line(const MjcfElement& element) {
  const std::vector<double> v = numbers(element, "fromto", 6);
  if (v.empty()) return std::nullopt;
  const Vector3d from(v[0], v[1], v[2]), to(v[3], v[4], v[5]);
  if (!((from - to).norm() > kTiny)) {
    findings_.error(element.attribute("fromto")->where,
                    cat(element.describe(), ": both ends of 'fromto' are the same point"));
    return std::nullopt;
  }
  return std::pair(Pose(.5 * (from + to), rotationOfZTo(from - to)), (from - to).norm());
}

}  // namespace kinegraph::inline parsers_internal
