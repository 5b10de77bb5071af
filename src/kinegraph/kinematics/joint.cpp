#include "kinegraph/kinematics/joint.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cctype>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

using Kind = MotionStep::Kind;

std::vector<MotionStep> genericSteps(std::string_view code) {
  std::vector<MotionStep> steps;
  for (std::size_t i = 0; i < code.size(); ++i) {
    if (code.substr(i) == "wxyz") {
      steps.push_back({Kind::quaternion});
      return steps;
    }
    const char letter = char(std::tolower(static_cast<unsigned char>(code[i])));
    const double sign = letter == code[i] ? 1. : -1.;
    if (letter >= 'x' && letter <= 'z') {
      steps.push_back({Kind::translate, letter - 'x', sign});
    } else if (letter >= 'a' && letter <= 'c') {
      steps.push_back({Kind::rotate, letter - 'a', sign});
    } else if (code[i] == 't') {
      steps.push_back({Kind::time});
    } else {
      throw ValueError(cat("generic joint code '", code, "': '", code[i],
                           "' is not one of x y z a b c (capitals negate), t, or a final wxyz"));
    }
  }
  return steps;
}

Quaterniond aboutAxis(int axis, double angle) {
  Quaterniond q(std::cos(.5 * angle), 0., 0., 0.);
  q.vec()[axis] = std::sin(.5 * angle);
  return q;
}

/// Returns the rotation angle about the unit axis `a` whose rotation is closest to `q`, in (-pi, pi].
double twistAngle(const Quaterniond& q, const Vector3d& a) {
  const double along = q.vec().dot(a);
  if (std::abs(along) + std::abs(q.w()) < 1e-12) return 0.;
  const double angle = 2. * std::atan2(along, q.w());
  return std::remainder(angle, 2. * M_PI) == -M_PI ? M_PI : std::remainder(angle, 2. * M_PI);
}

/// A joint type. A new type needs an entry here and its number in joint.h.
struct JointInfo {
  std::string_view name;
  JointType type;
  std::vector<MotionStep> steps;
  bool has_inverses = false;  ///< see hasInverses
};

/// The types in the order of their numbers.
const std::vector<JointInfo>& jointTable() {
  static constexpr MotionStep x{Kind::translate, 0}, y{Kind::translate, 1}, z{Kind::translate, 2};
  static constexpr MotionStep rotate_x{Kind::rotate, 0}, rotate_y{Kind::rotate, 1}, rotate_z{Kind::rotate, 2};
  static constexpr MotionStep rotate_about{Kind::rotateAbout}, quaternion{Kind::quaternion}, circle{Kind::circle, 2};
  static const std::vector<JointInfo> table = {
      {"none", JointType::none, {}},
      {"hingeX", JointType::hingeX, {rotate_x}, true},
      {"hingeY", JointType::hingeY, {rotate_y}, true},
      {"hingeZ", JointType::hingeZ, {rotate_z}, true},
      {"transX", JointType::transX, {x}, true},
      {"transY", JointType::transY, {y}, true},
      {"transZ", JointType::transZ, {z}, true},
      {"hinge", JointType::hinge, {rotate_about}, true},
      {"circleZ", JointType::circleZ, {circle}, true},
      {"transXY", JointType::transXY, {x, y}, true},
      {"trans3", JointType::trans3, {x, y, z}, true},
      {"transXYPhi", JointType::transXYPhi, {x, y, rotate_z}, true},
      {"transYPhi", JointType::transYPhi, {y, rotate_z}},
      {"universal", JointType::universal, {rotate_x, rotate_y}},
      {"rigid", JointType::rigid, {}, true},
      {"quatBall", JointType::quatBall, {quaternion}, true},
      {"phiTransXY", JointType::phiTransXY, {rotate_z, x, y}, true},
      {"XBall", JointType::XBall, {x, quaternion}},
      {"free", JointType::free, {x, y, z, quaternion}, true},
      {"generic", JointType::generic, {}},  // its steps follow from its code
      {"tau", JointType::tau, {{Kind::time}}},
  };
  return table;
}

const JointInfo& jointInfo(JointType type) {
  const auto index = std::size_t(type);
  if (index >= jointTable().size()) throw ValueError(cat("joint type ", int(type), " does not exist"));
  return jointTable()[index];
}

/// Names of joint types in other formats.
constexpr std::pair<std::string_view, std::string_view> kForeignNames[] = {
    {"revolute", "hingeX, hingeY or hingeZ, or hinge with axis: [x y z]"},
    {"continuous", "hingeX, hingeY or hingeZ without limits"},
    {"prismatic", "transX, transY or transZ"},
    {"slide", "transX, transY or transZ"},
    {"slider", "transX, transY or transZ"},
    {"fixed", "rigid"},
    {"floating", "free"},
    {"ball", "quatBall"},
    {"spherical", "quatBall"},
    {"planar", "transXYPhi"}};

}  // namespace

const std::vector<std::pair<std::string, JointType>>& jointTypeNames() {
  static const std::vector<std::pair<std::string, JointType>> names = [] {
    std::vector<std::pair<std::string, JointType>> all;
    for (const JointInfo& info : jointTable()) all.emplace_back(info.name, info.type);
    return all;
  }();
  return names;
}

std::string jointTypeName(JointType type) {
  const bool known = std::size_t(type) < jointTable().size();
  return known ? std::string(jointInfo(type).name) : cat("joint type ", int(type));
}

JointType jointTypeFromName(std::string_view name) {
  const std::string_view bare_name = name.starts_with("JT_") ? name.substr(3) : name;
  for (const JointInfo& info : jointTable()) {
    if (info.name == bare_name) return info.type;
  }
  std::vector<std::string> names;
  for (const JointInfo& info : jointTable()) names.emplace_back(info.name);
  const auto meant = std::find_if(std::begin(kForeignNames), std::end(kForeignNames),
                                  [&](const auto& entry) { return entry.first == bare_name; });
  const std::string hint = meant != std::end(kForeignNames) ? cat("; use ", meant->second, " for ", bare_name)
                                                            : similarHint(bare_name, names);
  throw ValueError(cat("unknown joint type '", name, "'; expected one of ", join(names), hint));
}

bool hasInverses(JointType type) { return jointInfo(type).has_inverses; }

std::vector<MotionStep> motionSteps(JointType type, std::string_view code) {
  return type == JointType::generic ? genericSteps(code) : jointInfo(type).steps;
}

int motionDofs(const std::vector<MotionStep>& steps) {
  int dofs = 0;
  for (const MotionStep& step : steps) dofs += step.dofs();
  return dofs;
}

VectorXd motionIdentity(const std::vector<MotionStep>& steps) {
  VectorXd q = VectorXd::Zero(motionDofs(steps));
  int i = 0;
  for (const MotionStep& step : steps) {
    if (step.orients()) q[i] = 1.;
    i += step.dofs();
  }
  return q;
}

Pose motionPose(const std::vector<MotionStep>& steps, const Vector3d& axis, double scale, const double* q) {
  Pose X;
  for (const MotionStep& step : steps) {
    const double value = step.sign * scale * q[0];
    switch (step.kind) {
      case Kind::translate:
        X.p += X.q * (value * Vector3d::Unit(step.axis));
        break;
      case Kind::rotate:
        X.q = X.q * aboutAxis(step.axis, value);
        break;
      case Kind::rotateAbout:
        X.q = X.q * Quaterniond(Eigen::AngleAxisd(value, axis));
        break;
      case Kind::quaternion:
        X.q = X.q * unitQuaternion({q[0], q[1], q[2], q[3]}, "quaternion of a joint");
        break;
      case Kind::circle:
        X.q = X.q * unitQuaternion({q[0], 0., 0., q[1]}, "(c, s) of a circleZ joint");
        break;
      case Kind::time:
        break;
    }
    q += step.dofs();
  }
  return X;
}

namespace {

/// Lets each step in rotate_about absorb its part of the pose. Exact for all types except generic ones with several
/// rotations.
VectorXd projectInSequence(const std::vector<MotionStep>& steps, const Vector3d& axis, double scale, const Pose& X) {
  VectorXd q = motionIdentity(steps);
  Pose rest = X;  // the pose that the remaining steps must produce
  int i = 0;
  for (const MotionStep& step : steps) {
    const double factor = step.sign * (scale == 0. ? 1. : scale);
    switch (step.kind) {
      case Kind::translate:
        q[i] = rest.p[step.axis] / factor;
        rest.p[step.axis] = 0.;
        break;
      case Kind::rotate:
      case Kind::rotateAbout: {
        const Vector3d a = step.direction(axis);
        const double angle = twistAngle(rest.q, a);
        q[i] = angle / factor;
        rest = Pose(Vector3d::Zero(), Quaterniond(Eigen::AngleAxisd(-angle, a))) * rest;
        break;
      }
      case Kind::quaternion:
        q.segment<4>(i) = wxyz(rest.q);
        rest.q.setIdentity();
        break;
      case Kind::circle: {
        const double norm = std::hypot(rest.q.w(), rest.q.z());
        q[i] = norm > 1e-12 ? rest.q.w() / norm : 1.;
        q[i + 1] = norm > 1e-12 ? rest.q.z() / norm : 0.;
        break;
      }
      case Kind::time:
        break;
    }
    i += step.dofs();
  }
  return q;
}

}  // namespace

VectorXd motionProject(const std::vector<MotionStep>& steps, const Vector3d& axis, double scale, const Pose& X) {
  VectorXd q = projectInSequence(steps, axis, scale, X);
  const auto rotates = [](const MotionStep& step) { return step.rotates(); };
  if (std::count_if(steps.begin(), steps.end(), rotates) < 2) return q;
  const auto error = [&](const VectorXd& at) {
    const Pose E = X.inverse() * motionPose(steps, axis, scale, at.data());
    Vector6d e;
    e << E.p, 2. * (E.q.w() < 0. ? -1. : 1.) * E.q.vec();
    return e;
  };
  for (int iteration = 0; iteration < 30; ++iteration) {  // refines the result by Levenberg's method
    const Vector6d e = error(q);
    if (e.norm() < 1e-14) break;
    MatrixXd J(6, q.size());
    for (int i = 0; i < q.size(); ++i) {
      const VectorXd h = 1e-6 * VectorXd::Unit(q.size(), i);
      J.col(i) = (error(q + h) - error(q - h)) / 2e-6;
    }
    const MatrixXd H = J.transpose() * J + 1e-12 * MatrixXd::Identity(q.size(), q.size());
    const VectorXd step = H.ldlt().solve(J.transpose() * e);
    if (error(q - step).norm() >= e.norm()) break;
    q -= step;
  }
  return q;
}

}  // namespace kinegraph
