// Shows plans of tool paths in the viewer.
#include "kinegraph/api/tool_path_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/tool_paths/tool_curve.h"
#include "kinegraph/tool_paths/tool_kinematics.h"
#include "kinegraph/viewer/config_viewer.h"

namespace kinegraph {

namespace {

constexpr double kCurveSpacing = 2e-3;  // m
constexpr int kMostPoints = 5000, kMostSlices = 600, kSlicesPerSecond = 25;
constexpr double kSecondsOfReached = 2.;                                 // playback of configurations without times
constexpr double kAxesSize = .05, kConeSize = .05, kFailureSize = .015;  // m
constexpr double kToleranceOfRows = 1e-4;                                // m, of drawn curves
constexpr const char* kDrawing = "tool path";
const Vector4d kAsked(.55, .55, .55, 1.), kFailed(.85, .1, .1, 1.), kConeColor(.15, .39, .82, 1.);

using Rgba = std::array<std::uint8_t, 4>;

/// Green at full speed, yellow at half of it, red at rest.
Rgba colorOfSpeed(double share) {
  const double u = std::clamp(share, 0., 1.);
  return {std::uint8_t(std::lround(220. * std::min(1., 2. - 2. * u))),
          std::uint8_t(std::lround(180. * std::min(1., 2. * u))), 30, 255};
}

/// The cone around an axis of a target: its rim, and four lines from its tip.
std::vector<Vector3d> coneLines(const ToolTarget& target, int axis, double angle, double side) {
  const Vector3d z = side * target.axis(axis), x = target.axis((axis + 1) % 3), y = z.cross(x);
  const auto rim = [&](int k) {
    const double turn = 2. * std::numbers::pi * k / 32.;
    return Vector3d(target.p +
                    kConeSize * (std::cos(angle) * z + std::sin(angle) * (std::cos(turn) * x + std::sin(turn) * y)));
  };
  std::vector<Vector3d> points;
  for (int k = 0; k <= 32; ++k) {
    points.push_back(rim(k));
    if (k % 8 == 0) points.push_back(target.p), points.push_back(rim(k));
  }
  return points;
}

/// False if nothing has that name.
bool removeIfDrawn(ProgrammableViewer& viewer, const std::string& name) {
  try {
    viewer.remove(name);
  } catch (const ValueError&) {
    return false;
  }
  return true;
}

/// Draws one path.
class ToolPathDrawing {
 public:
  ToolPathDrawing(ProgrammableViewer& viewer, const Config& config, const ToolPath& path, int number)
      : viewer_(viewer),
        tool_(config, path),
        curve_(path, Pose(tool_.pose(config.getJointState())),
               {kToleranceOfRows, kToleranceOfRows / ToolCurve::kOnTheSpot}),
        options_{.frame = path.relativeTo()},
        name_(cat(kDrawing, " ", number)) {}

  void drawCurve() {
    const int count = std::clamp(int(std::ceil(curve_.length() / kCurveSpacing)), 2, kMostPoints);
    std::vector<Vector3d> points;
    for (int k = 0; k <= count; ++k) points.push_back(curve_.at(curve_.length() * k / count).p);
    DrawOptions options = options_;
    options.color = kAsked, options.width = 2.;
    viewer_.line(cat(name_, ", asked"), points, options);
    options = options_;
    options.size = kAxesSize;
    viewer_.axes(cat(name_, ", start"), curve_.at(0.).pose(), options);
    viewer_.axes(cat(name_, ", end"), curve_.at(curve_.length()).pose(), options);
    if (tool_.cone() == 0.) return;
    options = options_;
    options.color = kConeColor, options.width = 1.;
    const ToolTarget start = curve_.at(0.);
    viewer_.line(cat(name_, ", cone"), coneLines(start, tool_.freeAxis(), tool_.cone(), tool_.side(start.pose())),
                 options);
  }

  /// The way of the tool on segments of this path.
  void drawWay(const ToolPathPlan& plan, int number) {
    std::vector<double> times, speeds;
    for (const ToolSegment& segment : plan.segments) {
      if (segment.path != number || segment.kind != ToolSegment::Kind::path) continue;
      const double fastest = std::max(curve_.length() / std::max(segment.to - segment.from, 1e-6), 1e-6);
      const int count =
          std::clamp(int(std::ceil(2. * fastest * (segment.to - segment.from) / kCurveSpacing)), 100, kMostPoints);
      for (int k = 0; k <= count; ++k) times.push_back(segment.from + (segment.to - segment.from) * k / count);
    }
    if (times.empty()) return;
    for (const double t : times) speeds.push_back(plan.speed(t));
    const double largest = std::max(*std::max_element(speeds.begin(), speeds.end()), 1e-9);
    DrawOptions options = options_;
    options.width = 4.;
    std::vector<Vector3d> points;
    for (std::size_t k = 0; k < times.size(); ++k) {
      points.push_back(tool_.pose(plan.eval(times[k]).q).p);
      options.colors.push_back(colorOfSpeed(speeds[k] / largest));
    }
    viewer_.line(cat(name_, ", speed"), points, options);
  }

  void drawFailure(const ToolPathPlan& plan) {
    const Vector3d at = curve_.at(std::clamp(plan.where.place, 0., curve_.length())).p;
    DrawOptions options = options_;
    options.color = kFailed, options.size = kFailureSize;
    viewer_.points(cat(kDrawing, ", failure"), {at}, options);
    viewer_.label(cat(kDrawing, ", cause"), at, plan.message, options_);
  }

 private:
  ProgrammableViewer& viewer_;
  ToolKinematics tool_;
  ToolCurve curve_;
  DrawOptions options_;
  std::string name_;
};

}  // namespace

void api_internal::drawToolPaths(ProgrammableViewer& viewer, const Config& config, const std::vector<ToolPath>& paths,
                                 const ToolPathPlan& plan) {
  for (const char* what : {"failure", "cause"}) removeIfDrawn(viewer, cat(kDrawing, ", ", what));
  for (int k = 0; removeIfDrawn(viewer, cat(kDrawing, " ", k, ", asked")); ++k)
    for (const char* what : {"start", "end", "cone", "speed"}) removeIfDrawn(viewer, cat(kDrawing, " ", k, ", ", what));
  for (int k = 0; k < int(paths.size()); ++k) {
    ToolPathDrawing drawing(viewer, config, paths[std::size_t(k)], k);
    drawing.drawCurve();
    if (plan.feasible()) drawing.drawWay(plan, k);
    if (plan.where.path == k) drawing.drawFailure(plan);
  }
}

ShownMotion api_internal::shownToolPath(const ToolPathPlan& plan, const Config& config) {
  MatrixXd rows = plan.reached;
  double seconds = kSecondsOfReached;
  if (plan.feasible()) {
    seconds = std::max(plan.duration(), 1e-3);
    const int count = std::clamp(int(std::ceil(kSlicesPerSecond * seconds)), 2, kMostSlices);
    rows.resize(count + 1, plan.dimension());
    for (int k = 0; k <= count; ++k) rows.row(k) = plan.eval(seconds * k / count).q.transpose();
  }
  if (rows.rows() == 0) return {};
  ShownMotion motion = motionAlong(config, rows, seconds);
  motion.start = ShownMotion::Start::play;
  return motion;
}

int ToolPathPlan::view(const Config& config, const std::vector<ToolPath>& paths, bool pause) const {
  Config shown(config);
  ConfigViewer& viewer = Config(config.scene()).viewer();  // config's own page
  drawToolPaths(viewer, config, paths, *this);
  const auto never = [] { return false; };
  const ShownMotion motion = shownToolPath(*this, shown);
  if (motion.poses.empty()) return viewer.view(shown, pause, message, never);
  return viewer.showMotion(shown, motion, pause, str(), never);
}

}  // namespace kinegraph
