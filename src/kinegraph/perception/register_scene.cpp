#include "kinegraph/perception/register_scene.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/distance/proximity.h"
#include "kinegraph/perception/fit_sensors.h"
#include "kinegraph/perception/known_points.h"
#include "kinegraph/perception/look_alikes.h"
#include "kinegraph/perception/measured_depth.h"
#include "kinegraph/perception/pose_certainty.h"
#include "kinegraph/perception/registration.h"
#include "kinegraph/perception/resting_heights.h"

namespace kinegraph {

namespace {

constexpr int kFewSamples = 12;

/// Whether the images show a thing at its best pose. `explained`: the share of the points beside its surface, and in
/// it, that it explains. Poses that explain them worse than noise are not seen.
bool isSeen(const SurfaceCounts& counts, double explained) {
  constexpr double kLeastAgree = .12, kMostThrough = .25;  // of the surface in view, of what is not hidden
  constexpr double kLeastExplained = .86, kMostOutside = .7;
  return counts.agree > kFewSamples && counts.agree >= kLeastAgree * counts.inView() &&
         counts.through <= kMostThrough * (counts.agree + counts.through) &&
         counts.outside <= kMostOutside * counts.total() && counts.score() > 0. && explained >= kLeastExplained;
}

/// The reason for which a thing was not seen. `there`: its surface at its last pose, which tells nothing if it may be
/// anywhere.
SeenStatus whyNotSeen(const Thing& thing, const SurfaceCounts& there) {
  constexpr double kMostVisible = .3;  // of the surface in view: through it, or something else is measured at its place
  if (thing.anywhere) return SeenStatus::not_found;
  if (there.outside > .7 * there.total() || there.none == there.inView()) return SeenStatus::not_in_view;
  return there.through + there.agree > kMostVisible * there.inView() ? SeenStatus::not_there : SeenStatus::occluded;
}

/// The last pose of a thing, on what it stood on.
RigidTransform lastPlace(const Thing& thing) {
  return thing.height_of_place ? restingPose(thing.shape, thing.last, *thing.height_of_place) : thing.last;
}

/// Sets the pose of a seen thing, its covariance and its alternatives.
void describePose(const std::vector<Thing>& things, std::size_t index, const Registration& registration,
                  const std::vector<int>& owners, const std::vector<ObservedView>& views, SeenFrame& result) {
  const Thing& thing = things[index];
  result.pose = Pose(thing.best.X).canonical();
  int thinning = 1;
  const FitPoints near = registration.pointsNear(thing, int(index), owners, thing.best.X.p, thing.shape.radius() + .02,
                                                 kFinePoints, &thinning);
  PoseCertainty certainty = poseCertainty(thing.shape, thing.freedom, near.measured, thinning, views, thing.best.X);
  result.covariance = std::move(certainty.covariance);
  result.free_directions = std::move(certainty.free_directions);
  for (const PoseCandidate& other : thing.others) result.alternatives.push_back(Pose(other.X).canonical());
}

/// The frame whose shape explains most of the points in front of a thing.
std::string whatIsBefore(const std::vector<Vector3d>& points, const std::vector<Thing>& things, std::size_t own,
                         const std::vector<KnownShape>& known, const Config& config) {
  constexpr double kNear = .012;  // m
  std::map<std::string, int> counts;
  for (const Vector3d& point : points) {
    std::string name;
    for (std::size_t k = 0; k < things.size() && name.empty(); ++k) {
      const RigidTransform& X = things[k].best.X;
      if (k != own && things[k].score > 0. &&
          std::abs(things[k].shape.nearest(X.R.transpose() * (point - X.p)).distance) < kNear)
        name = things[k].name;
    }
    for (std::size_t k = 0; k < known.size() && name.empty(); ++k) {
      if (mayBeWithin(*known[k].body, known[k].X_WB, point, kNear) &&
          proximity(*pointBody(), {Matrix3d::Identity(), point}, *known[k].body, known[k].X_WB).distance < kNear)
        name = config.getFrame(known[k].frame).getName();
    }
    ++counts[name];
  }
  const auto most =
      std::max_element(counts.begin(), counts.end(), [](auto& a, auto& b) { return a.second < b.second; });
  return most == counts.end() ? std::string() : most->first;
}

/// The frame on which things rest.
struct Support {
  std::string name;
  VisibleShape shape;
  RigidTransform X;
  double height;  ///< of its top, m
};

/// `solid`: the shapes of the scene that are not looked for.
void warnOfViews(const std::vector<ObservedView>& views, const Support* support, const std::vector<KnownShape>& solid,
                 std::vector<std::string>& warnings) {
  constexpr double kDoubtful = .1;        // of the points: behind shapes
  constexpr double kLookedThrough = .15;  // of the surface of the support
  constexpr double kOwnShare = .3;        // of the surface of a support too small for many pixels
  for (std::size_t k = 0; k < views.size(); ++k) {
    const ObservedView& view = views[k];
    int measured = 0, on_support = 0;
    for (int row = 0; row < view.height; row += 4) {
      for (int column = 0; column < view.width; column += 4) {
        if (view.depth[view.index(row, column)] <= 0.f) continue;
        ++measured;
        on_support += support && std::abs(view.point(row, column).z() - support->height) < .02;
      }
    }
    if (std::none_of(view.depth.begin(), view.depth.end(), isMeasured)) {
      warnings.push_back(cat("view ", k, " has no depth: all pixels are zero, negative or not finite"));
      continue;
    }
    if (!support) continue;
    const std::string advice = "'. Check the camera's pose (z forward, x to the right, y down), fxycxy, and the unit";
    const SurfaceCounts counts = countSurface(support->shape, support->X, {view}, int(support->shape.samples().size()));
    if (on_support < .01 * measured && counts.agree <= kOwnShare * counts.inView())
      warnings.push_back(cat("view ", k, ": fewer than 1 % of its pixels show the top of '", support->name, advice));
    else if (counts.through > std::max<double>(kFewSamples, kLookedThrough * counts.inView()))
      warnings.push_back(cat("view ", k, " looks through ", 100 * counts.through / counts.inView(),
                             " % of the surface of '", support->name, advice));
    else if (const double share = shareBehind(view, solid); share > kDoubtful)
      warnings.push_back(cat("view ", k, " looks through shapes of the scene at ", int(std::lround(100. * share)),
                             " % of its points. Check the camera's pose (z forward, x to the right, y down), and the ",
                             "poses of these shapes"));
  }
}

void warnOfOverlaps(const std::vector<Thing>& things, const Registration& registration,
                    std::vector<std::string>& warnings) {
  for (std::size_t a = 0; a < things.size(); ++a) {
    for (std::size_t b = a + 1; b < things.size(); ++b) {
      if (things[a].score < .2 || things[b].score < .2 ||
          !registration.overlap(things[a], things[a].best.X, things[b], things[b].best.X))
        continue;
      warnings.push_back(cat("'", things[a].name, "' overlaps '", things[b].name,
                             "'; one of their poses may be wrong, or the two are confused"));
    }
  }
}

std::optional<Support> supportOf(const Config& config, const RegisterOptions& options) {
  if (options.support.empty()) return std::nullopt;
  const Frame frame = config.getFrame(options.support);
  VisibleShape top = placeOf(frame);
  const double height = heightOf(frame, top);
  return Support{options.support, std::move(top), frame.getPose().transform(), height};
}

std::vector<Thing> thingsOf(const Config& config, const std::vector<std::string>& names, const Support* support,
                            const RegisterOptions& options) {
  constexpr double kAnyPlace = 100.;  // m
  std::set<int> listed;
  for (const std::string& name : names) listed.insert(config.getFrame(name).id());
  std::vector<Thing> things;
  for (const std::string& name : names) {
    const Frame frame = config.getFrame(name);
    if (std::any_of(things.begin(), things.end(), [&](const Thing& thing) { return thing.name == name; }))
      throw ValueError(cat("registerScene: frame '", name, "' is listed twice"));
    if (name == options.support)
      throw ValueError(cat("registerScene: '", name, "' is the support and one of the frames to look for"));
    VisibleShape shape(frame, listed);
    Thing thing{.name = name,
                .shape = std::move(shape),
                .freedom = freedomOf(frame, support != nullptr),
                .last = frame.getPose().transform(),
                .heights = {},
                .search = options.search_radius};
    const PoseFreedom& freedom = thing.freedom;
    if (options.prior == Prior::anywhere) {
      thing.anywhere = thing.is_lost = freedom.kind == PoseFreedom::Kind::resting;
      const double range = freedom.upper - freedom.lower;
      if (freedom.hasJoint() && std::isfinite(range))
        thing.search = freedom.kind == PoseFreedom::Kind::sliding ? range : 2. * thing.shape.radius();
    }
    if (support && freedom.kind == PoseFreedom::Kind::resting) {
      const double reach = thing.is_lost ? kAnyPlace : thing.shape.radius() + thing.search;
      const Frame on = config.getFrame(support->name);
      thing.heights = heightsUnder(config, frame, thing.shape, on, support->height, reach, listed);
      if (!thing.is_lost) thing.height_of_place = heightOfPlace(thing.shape, thing.last, thing.heights);
    }
    things.push_back(std::move(thing));
  }
  return things;
}

/// Balls that hold the points of interest: those around the last places, and one above the support for lost things.
std::vector<SearchBall> searchBalls(const std::vector<Thing>& things, const Support* support) {
  std::vector<SearchBall> balls;
  double tallest = 0.;
  for (const Thing& thing : things) {
    if (thing.is_lost)
      tallest = std::max(tallest, 2. * thing.shape.radius());
    else
      balls.push_back({thing.last.p, thing.shape.radius() + 2. * thing.search});
  }
  if (tallest > 0.) balls.push_back({support->X.p, support->shape.radius() + tallest});
  return balls;
}

/// Leaves out points that are neither above the support nor near a thing whose place is known.
void keepPlausible(const Support& support, const std::vector<Thing>& things, std::vector<ObservedPoint>& points) {
  constexpr double kBeside = .05;  // m
  Eigen::AlignedBox3d box;
  for (const Vector3d& sample : support.shape.samples()) box.extend(support.X * sample);
  std::erase_if(points, [&](const ObservedPoint& point) {
    const bool is_beside = (point.p.head<2>() - box.min().head<2>()).minCoeff() < -kBeside ||
                           (box.max().head<2>() - point.p.head<2>()).minCoeff() < -kBeside;
    return is_beside && std::none_of(things.begin(), things.end(), [&](const Thing& thing) {
             return !thing.is_lost && (point.p - thing.last.p).norm() < thing.shape.radius() + 2. * thing.search;
           });
  });
}

void warnOfLookAlikes(const std::vector<Thing>& things, const std::vector<std::pair<int, int>>& unclear,
                      std::vector<std::string>& warnings) {
  for (const auto& [a, b] : unclear)
    warnings.push_back(cat("'", things[std::size_t(a)].name, "' and '", things[std::size_t(b)].name,
                           "' look alike and may be exchanged: each is taken to be the one nearer to its last pose"));
}

/// Moves the frames that were seen, parents first. Things that were not seen move with their parents.
void moveSeen(Config& config, SeenScene& seen) {
  std::vector<Frame> frames = config.getFrames();
  const auto depth = [](const Frame& frame) {
    int parents = 0;
    for (auto at = frame.getParent(); at; at = at->getParent()) ++parents;
    return parents;
  };
  std::erase_if(frames, [&](const Frame& frame) { return !seen.frames.contains(frame.getName()); });
  std::ranges::stable_sort(frames, {}, depth);
  for (Frame& frame : frames) {
    SeenFrame& result = seen.frames[frame.getName()];
    if (result.status == SeenStatus::seen)
      frame.setPose(result.pose);
    else
      result.pose = frame.getPose();
  }
}

/// Finds the things with cameras and joints as they are in the scene.
SeenScene findThings(Config& config, std::span<const DepthView> given, const std::vector<std::string>& names,
                     const RegisterOptions& options) {
  const std::optional<Support> support = supportOf(config, options);
  const Support* on = support ? &*support : nullptr;
  std::vector<Thing> things = thingsOf(config, names, on, options);
  std::set<int> looked_for;
  for (const Thing& thing : things) looked_for.insert(thing.shape.frames().begin(), thing.shape.frames().end());
  const std::vector<KnownShape> solid = knownShapes(config, looked_for);
  if (on) looked_for.insert(on->shape.frames().begin(), on->shape.frames().end());
  const std::vector<KnownShape> known = knownShapes(config, looked_for);
  const std::vector<SearchBall> balls = searchBalls(things, on);
  std::vector<ObservedPoint> points;
  std::vector<ObservedView> views;
  for (std::size_t i = 0; i < given.size(); ++i)
    views.push_back(
        observe(given[i], given[i].cameraPose(config), known, on ? &on->height : nullptr, balls, points, int(i)));

  SeenScene seen;
  warnOfViews(views, on, solid, seen.warnings);
  const bool anywhere = options.prior == Prior::anywhere;
  if (anywhere) keepPlausible(*support, things, points);
  Registration registration(things, views, points);
  registration.run();
  if (anywhere) registration.findLost();
  for (Thing& thing : things) keepRotation(thing);

  const auto countsAt = [&](const Thing& thing, const RigidTransform& X) {
    return countSurface(thing.shape, X, views, int(thing.shape.samples().size()), true);
  };
  std::vector<SurfaceCounts> all_counts;
  std::vector<RigidTransform> counted_at;
  std::vector<int> owners = registration.ownersOfPoints();
  std::vector<bool> is_seen;
  for (const Thing& thing : things) {
    all_counts.push_back(countsAt(thing, thing.best.X));
    counted_at.push_back(thing.best.X);
    is_seen.push_back(!thing.is_lost && !thing.is_displaced &&
                      isSeen(all_counts.back(), registration.explainedBeside(thing, owners)));
  }
  std::vector<std::pair<int, int>> unclear;
  const std::vector<std::vector<int>> may_be = tellApart(things, registration, anywhere, is_seen, unclear);
  owners = registration.ownersOfPoints();
  for (std::size_t i = 0; i < things.size(); ++i) {
    Thing& thing = things[i];
    const RigidTransform there = is_seen[i] ? thing.best.X : lastPlace(thing);
    const bool is_counted = there.p == counted_at[i].p && there.R == counted_at[i].R;
    const SurfaceCounts counts = is_counted ? std::move(all_counts[i]) : countsAt(thing, there);
    SeenFrame result;
    result.score = counts.score();
    result.visible = double(counts.agree) / std::max(1, counts.total());
    result.status = is_seen[i] ? SeenStatus::seen : whyNotSeen(thing, counts);
    result.pose = Pose(thing.last);
    for (const int other : may_be[i]) result.may_be.push_back(things[std::size_t(other)].name);
    if (is_seen[i])
      describePose(things, i, registration, owners, views, result);
    else
      thing.score = -2.;
    if (result.status == SeenStatus::occluded) result.by = whatIsBefore(counts.before, things, i, known, config);
    seen.frames[thing.name] = std::move(result);
  }
  warnOfLookAlikes(things, unclear, seen.warnings);
  warnOfOverlaps(things, registration, seen.warnings);
  moveSeen(config, seen);
  return seen;
}

}  // namespace

void RegisterOptions::validate() const {
  if (!(search_radius > 0.) || search_radius > 1.)
    throw ValueError(cat("registerScene: search_radius is ", search_radius, "; expected m, more than 0 and at most 1"));
  if (prior == Prior::anywhere && support.empty())
    throw ValueError("registerScene: prior is 'anywhere' without a support; expected the frame on which things rest");
}

SeenScene registerScene(Config& config, std::span<const DepthView> views, const std::vector<std::string>& names,
                        const RegisterOptions& options) {
  options.validate();
  if (views.empty()) throw ValueError("registerScene: no views; expected at least one DepthView");
  for (std::size_t i = 0; i < views.size(); ++i) {
    views[i].validate(cat("registerScene: view ", i));
    views[i].cameraPose(config);  // throws FrameNotFound
  }
  if (options.estimate.empty()) return findThings(config, views, names, options);
  Config corrected = config;
  SensorFit sensors(corrected, views, names, options);
  sensors.fit({});
  sensors.fit(findThings(corrected, sensors.views(), names, options));
  SeenScene seen = findThings(corrected, sensors.views(), names, options);
  sensors.describe(seen);
  sensors.correct(config);
  moveSeen(config, seen);
  return seen;
}

}  // namespace kinegraph
