#include "kinegraph/perception/register_scene.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/distance/proximity.h"
#include "kinegraph/perception/pose_certainty.h"
#include "kinegraph/perception/resting_heights.h"

namespace kinegraph {

namespace {

constexpr int kCoarsePoints = 150, kFinePoints = 500;
constexpr int kCoarseSamples = 150, kFineSamples = 300;
constexpr double kExplained = .005;    // m, distance of a point from the surface that explains it
constexpr double kSure = 3.;           // standard deviations for agreement
constexpr double kSameResult = .0007;  // m, mean distance of two poses of one shape that look the same
constexpr double kSimilarScore = .12;  // scores of two poses that explain the images about as well
constexpr double kSureScore = .6;      // from here on a pose is only refined
constexpr double kWrongScore = .35;    // below, other resting poses and rotations are tried
constexpr double kOverlap = .05;       // share of a surface inside of another thing
constexpr int kFewSamples = 12;

const std::vector<double> kAllWidths{.015, .012, .009, .006, .004, .003, .002, .002, .002};  // m, of robust weights
const std::vector<double> kCoarseWidths(kAllWidths.begin(), kAllWidths.begin() + 6);
const std::vector<double> kFineWidths(kAllWidths.begin() + 5, kAllWidths.end());

struct Candidate {
  RigidTransform X;
  double value = -2.;
};

/// A frame to be found.
struct Thing {
  std::string name;
  VisibleShape shape;
  PoseFreedom freedom;
  RigidTransform last;
  std::vector<double> heights;  ///< m: of the tops on which it may rest
  Candidate best = {};
  std::vector<Candidate> others = {};
  double score = -2.;
};

PoseFreedom freedomOf(const Frame& frame, bool may_rest) {
  PoseFreedom freedom;
  freedom.start = frame.getPose().transform();
  const std::optional<Joint>& joint = frame.data().joint;
  if (joint && joint->dofs() == 1 && joint->steps.size() == 1 && joint->steps[0].moves()) {
    const MotionStep& step = joint->steps[0];
    freedom.kind = step.translates() ? PoseFreedom::Kind::sliding : PoseFreedom::Kind::turning;
    const double direction = step.sign * joint->scale;
    freedom.axis = freedom.start.R * step.direction(joint->axis);
    if (joint->lower.size() == 1) {
      const double at = frame.getJointState()[0];
      const double a = direction * (joint->lower[0] - at), b = direction * (joint->upper[0] - at);
      freedom.lower = std::min(a, b);
      freedom.upper = std::max(a, b);
    }
    return freedom;
  }
  const std::optional<Frame> parent = frame.getParent();
  const bool in_hand = parent && isMoved(*parent);
  if (may_rest && !in_hand) freedom.kind = PoseFreedom::Kind::resting;
  return freedom;
}

class Registration {
 public:
  Registration(std::vector<Thing>& things, const std::vector<ObservedView>& views,
               const std::vector<ObservedPoint>& points, double search_radius)
      : things_(things), views_(views), points_(points), search_(search_radius) {}

  void run() {
    std::vector<int> free_for_all(points_.size(), -1);
    for (Thing& thing : things_) find(thing, -1, free_for_all);
    const std::vector<int> owners = ownersOfPoints();
    for (std::size_t i = 0; i < things_.size(); ++i) find(things_[i], int(i), owners);
    separate();
  }

  /// The share of a thing's surface in pose X inside of another one.
  double overlap(const Thing& thing, const RigidTransform& X, const Thing& other) const {
    constexpr double kDeep = -.006;  // m
    if ((X.p - other.best.X.p).norm() > thing.shape.radius() + other.shape.radius()) return 0.;
    double inside = 0.;
    for (const Vector3d& point : thing.shape.samples())
      inside += other.shape.nearest(other.best.X.R.transpose() * (X * point - other.best.X.p)).distance < kDeep;
    return inside / double(thing.shape.samples().size());
  }

  bool overlap(const Thing& a, const Thing& b) const {
    return std::max(overlap(a, a.best.X, b), overlap(b, b.best.X, a)) > kOverlap;
  }

  /// Points near a pose that no other thing owns, at most `most`.
  FitPoints pointsNear(const Thing& thing, int index, const std::vector<int>& owners, const Vector3d& center,
                       double reach, int most, int* thinning = nullptr) const {
    std::vector<std::size_t> inside;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const bool allowed = index < 0 || owners[i] < 0 || owners[i] == index;
      if (allowed && (points_[i].p - center).squaredNorm() < reach * reach) inside.push_back(i);
    }
    const std::size_t step = (inside.size() + std::size_t(most) - 1) / std::size_t(most);
    FitPoints out;
    for (std::size_t i = 0; i < inside.size(); i += std::max<std::size_t>(step, 1))
      out.measured.push_back(points_[inside[i]]);
    if (thinning) *thinning = std::max(1, int(step));
    if (index >= 0) addNeighbors(thing, index, center, out);
    return out;
  }

  std::vector<int> ownersOfPoints() const {
    std::vector<int> owners(points_.size(), -1);
    std::vector<double> least;
    for (const ObservedPoint& point : points_) least.push_back(std::max(.006, kSure * point.sigma));
    for (std::size_t k = 0; k < things_.size(); ++k) {
      const Thing& thing = things_[k];
      if (thing.score < .2) continue;
      const double reach = thing.shape.radius() + .02;
      for (std::size_t i = 0; i < points_.size(); ++i) {
        if ((points_[i].p - thing.best.X.p).squaredNorm() > reach * reach) continue;
        const double d =
            std::abs(thing.shape.nearest(thing.best.X.R.transpose() * (points_[i].p - thing.best.X.p)).distance);
        if (d >= least[i]) continue;
        least[i] = d;
        owners[i] = int(k);
      }
    }
    return owners;
  }

 private:
  void addNeighbors(const Thing& thing, int index, const Vector3d& center, FitPoints& out) const {
    for (std::size_t k = 0; k < things_.size(); ++k) {
      const Thing& other = things_[k];
      const double gap = (other.best.X.p - center).norm() - other.shape.radius() - thing.shape.radius();
      if (int(k) == index || other.score < kSureScore || gap > 0.) continue;
      for (std::size_t i = 0; i < other.shape.samples().size(); i += 4)
        out.keep_out.push_back(other.best.X * other.shape.samples()[i]);
    }
  }

  double explained(const Thing& thing, const FitPoints& points, const RigidTransform& X) const {
    if (points.measured.empty()) return 0.;
    double count = 0.;
    for (const ObservedPoint& point : points.measured)
      count += std::abs(thing.shape.nearest(X.R.transpose() * (point.p - X.p)).distance) <
               std::max(kExplained, kSure * point.sigma);
    return count / double(points.measured.size());
  }

  /// `index` < 0: other things do not count.
  double valueOf(const Thing& thing, int index, const FitPoints& points, const RigidTransform& X) const {
    double value = countSurface(thing.shape, X, views_, kFineSamples).score() + 2. * explained(thing, points, X);
    for (const Thing& other : things_) {
      if (index >= 0 && &other != &thing && other.score >= kSureScore) value -= 2. * overlap(thing, X, other);
    }
    return value;
  }

  /// Looks again for the worse one of two things that overlap, without the points of the other.
  void separate() {
    for (std::size_t a = 0; a < things_.size(); ++a) {
      for (std::size_t b = a + 1; b < things_.size(); ++b) {
        if (std::min(things_[a].score, things_[b].score) < .2 || !overlap(things_[a], things_[b])) continue;
        const std::size_t worse = things_[a].best.value < things_[b].best.value ? a : b;
        things_[worse].score = -2.;
        find(things_[worse], int(worse), ownersOfPoints());
      }
    }
  }

  std::vector<RigidTransform> starts(const Thing& thing, bool wide) const {
    std::vector<RigidTransform> starts;
    const PoseFreedom& freedom = thing.freedom;
    Vector6d move = Vector6d::Zero();
    if (freedom.hasJoint()) {
      for (const double part : {0., -.8, .8, -1.6, 1.6}) {
        move << search_ * part * freedom.axis, 6. * search_ * part * freedom.axis;
        starts.push_back(freedom.moved(thing.last, move));
      }
      return starts;
    }
    const auto around = [&](const RigidTransform& X, std::initializer_list<double> angles) {
      for (const double angle : angles)
        starts.push_back({Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix() * X.R, X.p});
    };
    if (!wide) {
      around(thing.last, {0., .4, -.4, .8, -.8, 1.571});
      return starts;
    }
    if (freedom.kind != PoseFreedom::Kind::resting) {
      around(thing.last, {1.2, -1.2, 1.8, -1.8, 2.4, -2.4, 3.1});
      return starts;
    }
    std::vector<Vector3d> tried;
    for (const Vector3d& down : thing.shape.restingDirections()) {
      const bool is_new = std::none_of(tried.begin(), tried.end(), [&](const Vector3d& t) { return t.dot(down) > .8; });
      if (!is_new || tried.size() > 8) continue;
      tried.push_back(down);
      const Matrix3d R =
          Quaterniond::FromTwoVectors(thing.last.R * down, -Vector3d::UnitZ()).toRotationMatrix() * thing.last.R;
      around({R, thing.last.p}, {0., .785, 1.571, 2.356, 3.142, -.785, -1.571, -2.356});
    }
    return starts;
  }

  bool looksTheSame(const Thing& thing, const RigidTransform& a, const RigidTransform& b) const {
    double sum = 0.;
    for (std::size_t i = 0; i < 100 && i < thing.shape.samples().size(); ++i)
      sum += std::abs(thing.shape.nearest(a.R.transpose() * (b * thing.shape.samples()[i] - a.p)).distance);
    return sum / 100. < kSameResult;
  }

  void find(Thing& thing, int index, const std::vector<int>& owners) {
    std::vector<Candidate> candidates;
    const bool again = index >= 0;
    if (again) {
      const FitPoints near =
          pointsNear(thing, index, owners, thing.last.p, thing.shape.radius() + search_, kFinePoints);
      candidates.push_back({thing.best.X, valueOf(thing, index, near, thing.best.X)});
    }
    if (!again || thing.score < kSureScore) tryStarts(thing, index, owners, false, candidates);
    std::sort(candidates.begin(), candidates.end(), [](auto& a, auto& b) { return a.value > b.value; });
    refine(thing, index, owners, candidates);
    if (!again || thing.score >= kWrongScore || thing.freedom.hasJoint()) return;
    candidates.assign(1, thing.best);
    tryStarts(thing, index, owners, true, candidates);
    std::sort(candidates.begin(), candidates.end(), [](auto& a, auto& b) { return a.value > b.value; });
    refine(thing, index, owners, candidates);
  }

  void tryStarts(const Thing& thing, int index, const std::vector<int>& owners, bool wide,
                 std::vector<Candidate>& candidates) const {
    const FitPoints fine = pointsNear(thing, index, owners, thing.last.p, thing.shape.radius() + search_, kFinePoints);
    FitPoints coarse{{}, fine.keep_out};
    const std::size_t step = std::max<std::size_t>(1, fine.measured.size() / kCoarsePoints);
    for (std::size_t i = 0; i < fine.measured.size(); i += step) coarse.measured.push_back(fine.measured[i]);
    const auto tryStart = [&](RigidTransform X) {
      fitPose(thing.shape, thing.freedom, coarse, views_, kCoarseWidths, kCoarseSamples, X);
      candidates.push_back({X, valueOf(thing, index, fine, X)});
    };
    for (const RigidTransform& X : starts(thing, wide)) {
      if (thing.freedom.kind != PoseFreedom::Kind::resting)
        tryStart(X);
      else
        for (const double height : thing.heights) tryStart(restingPose(thing.shape, X, height));
    }
  }

  /// Refines the best candidates that differ; `thing.others` are those about as good that look different.
  void refine(Thing& thing, int index, const std::vector<int>& owners, const std::vector<Candidate>& candidates) {
    constexpr std::size_t kRefined = 3;
    constexpr double kApart = .12, kGiveUp = .6;  // rad; value below that of the best
    std::vector<Candidate> refined;
    for (const Candidate& candidate : candidates) {
      if (candidate.value < candidates[0].value - kGiveUp || refined.size() == kRefined) break;
      const bool is_new = std::none_of(refined.begin(), refined.end(), [&](const Candidate& other) {
        return Quaterniond(other.X.R).angularDistance(Quaterniond(candidate.X.R)) < kApart &&
               (other.X.p - candidate.X.p).norm() < .01;
      });
      if (!is_new) continue;
      Candidate fine = candidate;
      const FitPoints points = pointsNear(thing, index, owners, candidate.X.p, thing.shape.radius() + .02, kFinePoints);
      fitPose(thing.shape, thing.freedom, points, views_, kFineWidths, kFineSamples, fine.X);
      fine.value = valueOf(thing, index, points, fine.X);
      refined.push_back(fine);
    }
    std::stable_sort(refined.begin(), refined.end(), [](auto& a, auto& b) { return a.value > b.value; });
    const auto rotation = [&](const Candidate& c) {
      return Quaterniond(c.X.R).angularDistance(Quaterniond(thing.last.R));
    };
    for (Candidate& other : refined) {  // of the poses of a symmetric shape, the one nearest to the last
      const bool same = other.value > refined[0].value - kSimilarScore && looksTheSame(thing, refined[0].X, other.X);
      if (same && rotation(other) < rotation(refined[0])) std::swap(other, refined[0]);
    }
    thing.best = refined[0];
    thing.score = countSurface(thing.shape, thing.best.X, views_, kFineSamples).score();
    thing.others.clear();
    for (std::size_t i = 1; i < refined.size(); ++i) {
      if (refined[i].value > refined[0].value - kSimilarScore && !looksTheSame(thing, refined[0].X, refined[i].X))
        thing.others.push_back(refined[i]);
    }
  }

  std::vector<Thing>& things_;
  const std::vector<ObservedView>& views_;
  const std::vector<ObservedPoint>& points_;
  double search_;
};

SeenStatus statusOf(const SurfaceCounts& counts, double score) {
  if (counts.total() == 0 || counts.outside > .7 * counts.total()) return SeenStatus::not_in_view;
  if (counts.agree >= .5 * (counts.agree + counts.through) && counts.agree > kFewSamples && score > 0.)
    return SeenStatus::seen;
  if (counts.through > .3 * counts.inView()) return SeenStatus::not_there;
  return counts.none == counts.inView() ? SeenStatus::not_in_view : SeenStatus::occluded;
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

void warnOfViews(const std::vector<ObservedView>& views, const double* height, const std::string& support,
                 std::vector<std::string>& warnings) {
  for (std::size_t k = 0; k < views.size(); ++k) {
    const ObservedView& view = views[k];
    int measured = 0, on_support = 0;
    for (int row = 0; row < view.height; row += 4) {
      for (int column = 0; column < view.width; column += 4) {
        if (view.depth[view.index(row, column)] <= 0.f) continue;
        ++measured;
        on_support += height && std::abs(view.point(row, column).z() - *height) < .02;
      }
    }
    if (measured == 0)
      warnings.push_back(cat("view ", k, " has no depth: all pixels are zero, negative or not finite"));
    else if (height && on_support < .01 * measured)
      warnings.push_back(cat("view ", k, ": fewer than 1 % of its pixels show the top of '", support,
                             "'. Check the camera's pose (z forward, x to the right, y down), fxycxy, and the unit"));
  }
}

void warnOfOverlaps(const std::vector<Thing>& things, const Registration& registration,
                    std::vector<std::string>& warnings) {
  for (std::size_t a = 0; a < things.size(); ++a) {
    for (std::size_t b = a + 1; b < things.size(); ++b) {
      if (things[a].score < .2 || things[b].score < .2 || !registration.overlap(things[a], things[b])) continue;
      warnings.push_back(cat("'", things[a].name, "' overlaps '", things[b].name,
                             "'; one of their poses may be wrong, or the two are confused"));
    }
  }
}

}  // namespace

void RegisterOptions::validate() const {
  if (!(search_radius > 0.) || search_radius > 1.)
    throw ValueError(cat("registerScene: search_radius is ", search_radius, "; expected m, more than 0 and at most 1"));
}

SeenScene registerScene(Config& config, std::span<const DepthView> given, const std::vector<std::string>& names,
                        const RegisterOptions& options) {
  options.validate();
  if (given.empty()) throw ValueError("registerScene: no views; expected at least one DepthView");
  std::vector<Pose> cameras;
  for (std::size_t i = 0; i < given.size(); ++i) {
    given[i].validate(cat("registerScene: view ", i));
    cameras.push_back(given[i].cameraPose(config));
  }
  std::optional<double> height;
  std::set<int> looked_for;
  if (!options.support.empty()) {
    const Frame support = config.getFrame(options.support);
    const VisibleShape top = placeOf(support);
    height = heightOf(support, top);
    looked_for.insert(top.frames().begin(), top.frames().end());
  }
  std::set<int> listed;
  for (const std::string& name : names) listed.insert(config.getFrame(name).id());
  std::vector<Thing> things;
  std::vector<SearchBall> balls;
  for (const std::string& name : names) {
    const Frame frame = config.getFrame(name);
    if (std::any_of(things.begin(), things.end(), [&](const Thing& thing) { return thing.name == name; }))
      throw ValueError(cat("registerScene: frame '", name, "' is listed twice"));
    Thing thing{
        name, VisibleShape(frame, listed), freedomOf(frame, height.has_value()), frame.getPose().transform(), {}};
    if (height)
      thing.heights = heightsUnder(frame, config.getFrame(options.support), *height,
                                   thing.shape.radius() + options.search_radius, listed);
    looked_for.insert(thing.shape.frames().begin(), thing.shape.frames().end());
    balls.push_back({thing.last.p, thing.shape.radius() + 2. * options.search_radius});
    things.push_back(std::move(thing));
  }
  const std::vector<KnownShape> known = knownShapes(config, looked_for);
  const double* support_height = height ? &*height : nullptr;
  std::vector<ObservedPoint> points;
  std::vector<ObservedView> views;
  for (std::size_t i = 0; i < given.size(); ++i)
    views.push_back(observe(given[i], cameras[i], known, support_height, balls, points, int(i)));

  SeenScene seen;
  warnOfViews(views, support_height, options.support, seen.warnings);
  Registration registration(things, views, points, options.search_radius);
  registration.run();
  const std::vector<int> owners = registration.ownersOfPoints();
  for (std::size_t i = 0; i < things.size(); ++i) {
    Thing& thing = things[i];
    const SurfaceCounts counts =
        countSurface(thing.shape, thing.best.X, views, int(thing.shape.samples().size()), true);
    SeenFrame result;
    result.score = counts.score();
    result.visible = double(counts.agree) / std::max(1, counts.total());
    result.status = statusOf(counts, result.score);
    result.pose = Pose(thing.last);
    if (result.status == SeenStatus::seen) {
      result.pose = Pose(thing.best.X).canonical();
      int thinning = 1;
      const FitPoints near = registration.pointsNear(thing, int(i), owners, thing.best.X.p, thing.shape.radius() + .02,
                                                     kFinePoints, &thinning);
      PoseCertainty certainty = poseCertainty(thing.shape, thing.freedom, near.measured, thinning, views, thing.best.X);
      result.covariance = std::move(certainty.covariance);
      result.free_directions = std::move(certainty.free_directions);
      for (const Candidate& other : thing.others) result.alternatives.push_back(Pose(other.X).canonical());
    } else {
      thing.score = -2.;
    }
    if (result.status == SeenStatus::occluded) result.by = whatIsBefore(counts.before, things, i, known, config);
    seen.frames[thing.name] = std::move(result);
  }
  warnOfOverlaps(things, registration, seen.warnings);
  for (const Thing& thing : things) {
    const SeenFrame& result = seen.frames[thing.name];
    if (result.status == SeenStatus::seen) config.getFrame(thing.name).setPose(result.pose);
  }
  return seen;
}

}  // namespace kinegraph
