#include "kinegraph/tool_paths/path_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "kinegraph/common/text.h"
#include "kinegraph/ik/low_discrepancy.h"
#include "kinegraph/ik/target_questions.h"
#include "kinegraph/kinematics/state.h"
#include "kinegraph/planning/steering/joint_space.h"

namespace kinegraph::inline tool_paths_internal {

namespace {

constexpr double kSpacing = .015;          // m between the places of the search
constexpr int kStartsFixed[] = {40, 200};  // for arms without freedom on the path
constexpr int kStartsFree[] = {12, 48, 150};
constexpr int kMaxTries = 12;  // strands or chains that are refined
constexpr int kChainRounds = 40;
constexpr double kChainSteps[] = {.3, .7, 1.5};  // largest change of a joint between places
constexpr double kSamePath = .05;                // rad or m, between solutions
constexpr double kFarMiddle = .1, kFarMiddleShare = .4;
constexpr int kPlacesOfSeeds = 4;  // besides the start, for the graph
constexpr int kDiagnosisStarts = 60;
constexpr int kPlacesAhead = 3;
constexpr double kWidest = 4.;           // rad or m, from which the diagnosis starts
constexpr double kPlaceAccuracy = 5e-4;  // m, of a failure
constexpr double kBeyond = 1e-3;         // m behind the place of a failure
constexpr double kExtensionStep = 8e-3;  // m
constexpr int kExtensionSteps = 60;
constexpr double kLargestExtension = .6;  // rad or m

/// The search along one curve.
class PathSearch {
 public:
  PathSearch(ToolKinematics& tool, const ToolCurve& curve, EdgeChecker& checker, const PathSearchSettings& settings)
      : tool_(tool),
        curve_(curve),
        checker_(checker),
        settings_(settings),
        tracker_(tool, curve, searchPlaces(curve, kSpacing), settings.limits),
        home_(tool.state().q()) {}

  PathSolutions run() {
    const int rows = tool_.rows() == ToolRows::pose ? 6 : tool_.rows() == ToolRows::axis ? 5 : 3;
    const bool is_free = tool_.movingDofs() > rows;
    std::vector<int> stages = is_free ? std::vector<int>(std::begin(kStartsFree), std::end(kStartsFree))
                                      : std::vector<int>(std::begin(kStartsFixed), std::end(kStartsFixed));
    if (settings_.only_first) stages = {0};
    if (tool_.preferred() && !settings_.only_first) {
      tracker_.holdPreferred(true);
      follow(stages[0], settings_.seed);
      tryStrands();
      tracker_.holdPreferred(false);
      if (!result_.curves.empty()) return std::move(result_);
      strands_.clear(), tried_.clear();
      has_failure_ = false;
    }
    for (std::size_t stage = 0; stage < stages.size(); ++stage) {
      follow(stages[stage], settings_.seed + stage);
      tryStrands();
      if (isDone()) break;
      if (is_free && result_.curves.empty()) {
        if (!settings_.only_first) followFromWithin(stages[stage] / 4, settings_.seed + 100 + stage);
        searchGraph();
      }
      if (!result_.curves.empty()) break;
      // More starts cannot help where no configuration is there at all.
      if (stage == 0 && farthestIndex() + 1 < int(places().size()) && isHopeless()) break;
    }
    if (result_.curves.empty()) explain();
    return std::move(result_);
  }

 private:
  const std::vector<double>& places() const { return tracker_.places(); }
  bool isDone() const { return int(result_.curves.size()) >= settings_.wanted; }

  void follow(int starts, std::uint64_t seed) {
    for (StrandTracker::Seed& seed_at : tracker_.seeds(0, settings_.first, starts, seed)) {
      if (settings_.cancellation) settings_.cancellation.check();
      const bool known = std::any_of(strands_.begin(), strands_.end(), [&](const Strand& other) {
        return other.first == 0 && tool_.difference(other.q[0], seed_at.q).cwiseAbs().maxCoeff() < kSamePath;
      });
      if (!known) strands_.push_back(tracker_.follow(seed_at));
    }
  }

  /// Strands from places within the path, in both directions.
  void followFromWithin(int starts, std::uint64_t seed) {
    for (int part = 1; part <= kPlacesOfSeeds; ++part) {
      const int index = int(places().size() - 1) * part / kPlacesOfSeeds;
      for (const StrandTracker::Seed& seed_at : tracker_.seeds(index, {}, starts, seed + std::uint64_t(part))) {
        if (settings_.cancellation) settings_.cancellation.check();
        for (const int direction : {-1, 1}) strands_.push_back(tracker_.follow(seed_at, index, direction));
      }
    }
  }

  bool isWhole(const Strand& strand) const { return strand.first == 0 && strand.q.size() == places().size(); }

  void tryStrands() {
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < strands_.size(); ++k)
      if (isWhole(strands_[k]) && !tried_[k]) order.push_back(k);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return strands_[a].cost < strands_[b].cost; });
    int tries = 0;
    for (const std::size_t k : order) {
      if (isDone() || tries == kMaxTries) return;
      Strand& strand = strands_[k];
      checkStrand(checker_, strand);
      if (strand.collides >= 0) continue;
      if (!edgesAreFree(strand)) continue;
      ++tries;
      tried_[k] = true;
      double place = 0.;
      finish(places(), strand.q, place);
    }
  }

  bool edgesAreFree(const Strand& strand) {
    for (std::size_t i = 1; i < strand.q.size(); ++i) {
      if (checker_.isFree(strand.q[i - 1].data(), strand.q[i].data())) continue;
      if (const std::optional<MotionContact> hit = checker_.lastHit())
        note(ToolPathStatus::in_collision, places()[i - 1], "", {nameOf(hit->a), nameOf(hit->b)}, -1);
      return false;
    }
    return true;
  }

  /// Makes a joint curve of configurations at places; adds it to the solutions if it is free.
  bool finish(const std::vector<double>& at, std::vector<VectorXd> q, double& place) {
    int dof = -1;
    if (!fitTurns(tool_, q, settings_.first.empty() ? home_ : settings_.first[0], dof)) {
      note(ToolPathStatus::no_branch, at.back(), "the joint would pass its limits", {}, dof);
      place = at.back();
      return false;
    }
    JointCurve joints = jointCurveAlong(tool_, curve_, at, std::move(q), settings_.tolerance, settings_.cancellation);
    if (!joints.feasible()) {
      note(ToolPathStatus::no_branch, joints.place, joints.message, {}, joints.blocked);
      place = joints.place;
      return false;
    }
    if (const std::optional<CurveContact> contact = firstContactAlong(checker_, joints.pieces)) {
      note(ToolPathStatus::in_collision, contact->place, "", {nameOf(contact->contact.a), nameOf(contact->contact.b)},
           -1);
      place = contact->place;
      return false;
    }
    result_.curves.push_back(std::move(joints));
    return true;
  }

  std::string nameOf(int frame) const { return tool_.model().frame_name[std::size_t(frame)]; }

  /// Remembers the failure that is farthest along the path.
  void note(ToolPathStatus status, double place, std::string text, std::vector<std::string> frames, int dof) {
    if (has_failure_ && place <= result_.failure.place) return;
    has_failure_ = true;
    result_.failure = {
        status, place, std::move(text), std::move(frames), dof >= 0 ? dofNames(tool_.model())[std::size_t(dof)] : "",
        {}};
  }

  void searchGraph() {
    std::vector<std::vector<VectorXd>> nodes(places().size());
    std::vector<const double*> rows;
    std::vector<std::pair<std::size_t, const VectorXd*>> all;
    for (const Strand& strand : strands_)
      for (std::size_t k = 0; k < strand.q.size(); ++k)
        all.emplace_back(std::size_t(strand.first + int(k) * strand.direction), &strand.q[k]);
    for (std::size_t k = 0; k < all.size(); k += EdgeChecker::kLanes) {
      bool free[EdgeChecker::kLanes];
      rows.clear();
      for (std::size_t i = k; i < std::min(all.size(), k + EdgeChecker::kLanes); ++i)
        rows.push_back(all[i].second->data());
      checker_.areFree(rows, free);
      for (std::size_t i = 0; i < rows.size(); ++i)
        if (free[i]) nodes[all[k + i].first].push_back(*all[k + i].second);
    }
    std::vector<std::vector<std::pair<int, int>>> barred(places().size());
    int tries = 0;
    for (int round = 0; round < kChainRounds && tries < kMaxTries; ++round) {
      if (settings_.cancellation) settings_.cancellation.check();
      std::vector<int> chosen;
      std::vector<VectorXd> chain;
      for (const double step : kChainSteps) {
        chain = cheapestChain(tool_, nodes, barred, step, chosen, stuck_);
        if (!chain.empty()) break;
      }
      if (chain.empty()) return;
      stuck_ = -1;
      if (bar(chain, chosen, barred)) continue;
      ++tries;
      smoothChain(tool_, curve_, places(), checker_, chain);
      double place = 0.;
      if (finish(places(), chain, place)) return;
      const int at = std::clamp(int(std::lower_bound(places().begin(), places().end(), place) - places().begin()), 1,
                                int(places().size()) - 1);
      for (int k = std::max(1, at - 1); k <= std::min(int(places().size()) - 1, at + 1); ++k)
        barred[std::size_t(k)].emplace_back(chosen[std::size_t(k) - 1], chosen[std::size_t(k)]);
    }
  }

  /// Bars the edges of a chain whose middle is not near, or not free. True if there are any.
  bool bar(const std::vector<VectorXd>& chain, const std::vector<int>& chosen,
           std::vector<std::vector<std::pair<int, int>>>& barred) {
    bool any = false;
    for (std::size_t k = 1; k < chain.size(); ++k) {
      const VectorXd middle = .5 * (chain[k - 1] + chain[k]);
      VectorXd q = middle;
      const double size = (chain[k] - chain[k - 1]).cwiseAbs().maxCoeff();
      const bool near = tool_.project(q, curve_.at(.5 * (places()[k - 1] + places()[k])), tool_.rows(), 8).met &&
                        (q - middle).cwiseAbs().maxCoeff() < kFarMiddle + kFarMiddleShare * size;
      if (near && checker_.isFree(chain[k - 1].data(), chain[k].data())) continue;
      any = true;
      barred[k].emplace_back(chosen[k - 1], chosen[k]);
    }
    return any;
  }

  /// The last place that a strand from the start gets to without collision.
  int freeIndex(Strand& strand) {
    if (strand.first != 0 || strand.direction < 0) return -1;
    checkStrand(checker_, strand);
    return strand.collides >= 0 ? strand.collides - 1 : int(strand.q.size()) - 1;
  }

  int farthestIndex() {
    int farthest = -1;
    for (Strand& strand : strands_) farthest = std::max(farthest, freeIndex(strand));
    return farthest;
  }

  /// Solutions at s, without regard to collisions.
  std::vector<VectorXd> solutionsAt(double s) {
    StrandTracker there(tool_, curve_, {s}, settings_.limits);
    std::vector<VectorXd> all;
    for (StrandTracker::Seed& seed : there.seeds(0, {}, kDiagnosisStarts, settings_.seed)) all.push_back(seed.q);
    return all;
  }

  bool anyFree(const std::vector<VectorXd>& all) {
    return std::any_of(all.begin(), all.end(), [&](const VectorXd& q) { return checker_.isFree(q.data()); });
  }

  /// Whether no free configuration is found at one of the first places that no strand reaches.
  bool isHopeless() {
    const int next = std::max(farthestIndex() + 1, 0);
    for (int k = next; k < std::min(next + kPlacesAhead, int(places().size())); ++k)
      if (!anyFree(solutionsAt(places()[std::size_t(k)]))) return true;
    return false;
  }

  /// Sets the failure: the farthest place that a motion reaches, and what ends it there.
  void explain() {
    PathFailure& failure = result_.failure;
    if (strands_.empty()) return explainAt(0.);
    double farthest = 0.;
    for (Strand& strand : strands_) {
      const int last = freeIndex(strand);
      if (last < 0) continue;
      double place = strand.collides >= 0 ? contactPlace(strand, last) : strand.reached;
      if (place < farthest || (place == farthest && !failure.reached.empty())) continue;
      farthest = place;
      failure.reached.assign(strand.q.begin(), strand.q.begin() + last + 1);
      in_the_way_.clear();
      if (strand.collides >= 0 && !checker_.isFree(strand.q[std::size_t(strand.collides)].data()) && checker_.lastHit())
        in_the_way_ = {nameOf(checker_.lastHit()->a), nameOf(checker_.lastHit()->b)};
      blocked_ = strand.collides >= 0 ? -1 : strand.blocked;
      const bool goes_on = strand.collides < 0 && (strand.blocked < 0 || !tool_.isWide(strand.blocked));
      end_ = goes_on ? strand.q[std::size_t(last)] : VectorXd();
      end_place_ = places()[std::size_t(last)];
    }
    if (has_failure_ && farthest >= curve_.length() - kBeyond) {  // only the proof between the places failed
      const auto end = std::upper_bound(places().begin(), places().end(), failure.place);
      const std::size_t reached = std::size_t(std::max<std::ptrdiff_t>(1, end - places().begin()));
      failure.reached.resize(std::min(failure.reached.size(), reached));
      return finishText();
    }
    std::vector<VectorXd> reached = std::move(failure.reached);
    if (end_.size() > 0) farthest = std::max(farthest, farthestFrom(end_, end_place_));
    explainAt(farthest);
    result_.failure.reached = std::move(reached);
  }

  /// The place at which the motion of a strand from its free configuration `last` to the next one collides.
  double contactPlace(const Strand& strand, int last) {
    double low = places()[std::size_t(last)], high = places()[std::size_t(last) + 1];
    const double from = low, width = high - low;
    while (high - low > kPlaceAccuracy) {
      const double middle = .5 * (low + high), share = (middle - from) / width;
      VectorXd q = (1. - share) * strand.q[std::size_t(last)] + share * strand.q[std::size_t(last) + 1];
      tool_.project(q, curve_.at(middle), tool_.rows(), 8);
      (checker_.isFree(q.data()) ? low : high) = middle;
    }
    return low;
  }

  /// The farthest place to which the motion continues from a configuration with all the freedom that the path leaves.
  double farthestFrom(VectorXd q, double place) {
    for (double step = kExtensionStep; step > kPlaceAccuracy;) {
      VectorXd next = q;
      const double to = std::min(place + step, curve_.length());
      const bool goes = to > place && tool_.project(next, curve_.at(to), tool_.rows(), kExtensionSteps, {}, 1.).met &&
                        (next - q).cwiseAbs().maxCoeff() < kLargestExtension && checker_.isFree(next.data());
      if (goes)
        q = next, place = to;
      else
        step *= .5;
    }
    return place;
  }

  /// By how much the tool misses a target that it cannot reach: "; the nearest misses its position by 0.2 m".
  std::string nearestTo(const ToolTarget& target) {
    const LowDiscrepancy sequence(tool_.dofs(), settings_.seed);
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kDiagnosisStarts; ++i) {
      VectorXd q = home_;
      for (int j = 0; i > 0 && j < tool_.dofs(); ++j) {
        const double low = std::max(tool_.model().lower[j], -kWidest), high = std::min(tool_.model().upper[j], kWidest);
        if (tool_.moving()[std::size_t(j)]) q[j] = low + (high - low) * sequence.at(i, j);
      }
      tool_.project(q, target, ToolRows::position, kExtensionSteps);
      least = std::min(least, tool_.miss(q, target).p.norm());
    }
    if (least < kPlaceAccuracy) return "; the tool reaches its position, but not with this direction";
    const std::string question = askAboutLength(target.p, least);
    return cat("; the nearest misses its position by ", numberText(least, 3), " m",
               question.empty() ? "" : cat("; ", question));
  }

  void explainAt(double place) {
    PathFailure& failure = result_.failure;
    const double beyond = std::min(place + kBeyond, curve_.length());
    const std::vector<VectorXd> there = solutionsAt(beyond);
    failure.place = place;
    failure.frames.clear(), failure.joint.clear(), failure.text.clear();
    if (there.empty()) {
      failure.status = ToolPathStatus::out_of_reach;
      nearest_ = nearestTo(curve_.at(beyond));
    } else if (!anyFree(there)) {
      failure.status = ToolPathStatus::in_collision;
      // The pair that is least too close, over all solutions.
      double best = -1e9;
      for (const VectorXd& q : there) {
        if (checker_.isFree(q.data()) || !checker_.lastHit()) continue;
        const MotionContact hit = *checker_.lastHit();
        if (hit.distance <= best) continue;
        best = hit.distance;
        failure.frames = {nameOf(hit.a), nameOf(hit.b)};
      }
      depth_ = -best;
    } else if (!in_the_way_.empty()) {
      failure.status = ToolPathStatus::in_collision;
      failure.frames = in_the_way_;
      failure.text = cat("'", in_the_way_[0], "' and '", in_the_way_[1],
                         "' end the motion, and no other one continues without a jump");
      return;
    } else {
      failure.status = ToolPathStatus::no_branch;
      if (blocked_ >= 0) failure.joint = dofNames(tool_.model())[std::size_t(blocked_)];
    }
    finishText();
  }

  void finishText() {
    PathFailure& failure = result_.failure;
    switch (failure.status) {
      case ToolPathStatus::out_of_reach:
        failure.text = cat("no configuration reaches the path", nearest_);
        break;
      case ToolPathStatus::in_collision:
        failure.text = failure.frames.empty()
                           ? "all configurations are in collision"
                           : cat("'", failure.frames[0], "' and '", failure.frames[1], "' ",
                                 depth_ > 0. ? cat("overlap by ", 1e3 * depth_, " mm") : "are too close",
                                 " in the best configuration");
        break;
      default:
        failure.text = failure.joint.empty() ? cat("no configuration continues the motion without a jump",
                                                   failure.text.empty() ? "" : cat(" (", failure.text, ")"))
                                             : cat("the limit of joint '", failure.joint, "' ends the motion");
    }
  }

  ToolKinematics& tool_;
  const ToolCurve& curve_;
  EdgeChecker& checker_;
  const PathSearchSettings& settings_;
  StrandTracker tracker_;
  VectorXd home_;
  std::vector<Strand> strands_;
  std::map<std::size_t, bool> tried_;
  PathSolutions result_;
  bool has_failure_ = false;
  std::string nearest_;  ///< of a place out of reach
  int stuck_ = -1, blocked_ = -1;
  VectorXd end_;  ///< of the strand that gets farthest, if neither a collision nor a turn ends it
  double end_place_ = 0.;
  std::vector<std::string> in_the_way_;  ///< the pair in collision that ends this strand, or none
  double depth_ = 0.;
};

}  // namespace

PathSolutions searchPath(ToolKinematics& tool, const ToolCurve& curve, EdgeChecker& checker,
                         const PathSearchSettings& settings) {
  return PathSearch(tool, curve, checker, settings).run();
}

}  // namespace kinegraph::inline tool_paths_internal
