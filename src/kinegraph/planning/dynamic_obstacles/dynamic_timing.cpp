#include "kinegraph/planning/dynamic_obstacles/dynamic_timing.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "kinegraph/common/text.h"
#include "kinegraph/trajectories/curve_part.h"

namespace kinegraph::inline planning_internal {

namespace {

constexpr int kStations = 16,
              kSmoothStations = 8;  // besides the start; fewer with jerk limits, which make legs expensive
constexpr double kSlower[] = {1., 1.4, 2., 3., 5.};  // durations of a leg, as multiples of the shortest
constexpr double kStepShare = 1. / 40., kLeastStep = .02,
                 kMostStep = .1;  // between departures: share of the duration; s
constexpr long kMostTries = 20000;
constexpr double kStill = 1e-9;  // 1/s
constexpr double kSame = 1e-12;  // of the curve
constexpr double kSnap = 1e-6;   // of the curve: a station so close to a knot moves there
constexpr double kForever = std::numeric_limits<double>::infinity();

/// An interval during which the robot may stand at a station.
struct SafeInterval {
  double begin, end;
};

class TimeSearch {
 public:
  TimeSearch(const TimedPath& fastest, const MotionLimits& limits, DynamicCheck& check,
             const CancellationToken& cancellation)
      : curve_(fastest.curve()),
        fastest_(fastest.scaling()),
        limits_(limits),
        check_(check),
        cancellation_(cancellation),
        step_(std::clamp(kStepShare * fastest_.duration(), kLeastStep, kMostStep)) {
    const std::vector<ScalingPhase>& phases = fastest_.phases();
    start_speed_ = phases.front().begin.speed;
    const auto stop =
        std::find_if(phases.begin() + 1, phases.end(), [](const ScalingPhase& p) { return p.begin.speed < kStill; });
    first_stop_ = stop == phases.end() ? curve_.length() : stop->begin.s;
  }

  DynamicTiming run() {
    placeStations();
    const std::vector<SafeInterval>& at_goal = safeIntervals(last());
    result_.met = check_.contact(curve_, fastest_, limits_.acceleration);
    if (at_goal.empty() || at_goal.back().end < kForever) {
      const double end = check_.scene().end();
      const auto [a, b] = blockers(last(), end, end);
      result_.message = cat("at the goal, ", describeContact(a, b), ", which stays there");
      return std::move(result_);
    }
    const bool stays = fastest_.duration() >= at_goal.back().begin;
    if (!result_.met && stays) {
      result_.was_found = result_.is_fastest = true;
      result_.scaling = fastest_;
      return std::move(result_);
    }
    if (!result_.met) {  // an obstacle comes to the goal later
      const double free_from = at_goal.back().begin;
      const auto [a, b] = blockers(last(), std::max(0., free_from - step_), free_from);
      result_.met = DynamicContact{at_goal.back().begin, a, b, curve_.length()};
    }
    if (curve_.length() > 0.) search();
    if (!result_.was_found && result_.message.empty()) result_.message = failure();
    return std::move(result_);
  }

 private:
  struct Node {
    int station, interval;
    double arrival;
    int before = -1;  ///< the previous node
    int slower = 0;   ///< the leg from there takes kSlower[slower] times its shortest duration
    double departure = 0.;
  };
  struct Entry {
    double least;  ///< lower bound of the arrival at the goal
    long order;
    int node, to, slower;
    double departure;
    bool operator<(const Entry& other) const {
      return least > other.least || (least == other.least && order > other.order);
    }
  };
  struct Leg {
    bool was_made = false, is_possible = false;
    TimeScaling scaling;
    double suspect = 0.;  ///< time after the departure of its last contact
  };

  int last() const { return int(places_.size()) - 1; }

  void placeStations() {
    const int count = curve_.length() == 0. ? 0 : limits_.limitsJerk() ? kSmoothStations : kStations;
    for (int k = 0; k <= count; ++k) places_.push_back(count ? curve_.length() * k / count : 0.);
    for (int piece = 1; piece < curve_.pieces(); ++piece) {
      for (int k = 1; k < count; ++k)
        if (std::abs(curve_.begin(piece) - places_[std::size_t(k)]) < kSnap * curve_.length())
          places_[std::size_t(k)] = curve_.begin(piece);
      if (curve_.stopsAt(piece)) places_.push_back(curve_.begin(piece));
    }
    std::sort(places_.begin(), places_.end());
    places_.erase(std::unique(places_.begin(), places_.end()), places_.end());
    for (const double place : places_) {
      configurations_.push_back(curve_.eval(place));
      passes_.push_back(fastest_.timeOf(place));
    }
    safe_intervals_.resize(places_.size());
    legs_.resize(places_.size() * places_.size());
  }

  // --- safe intervals ----------------------------------------------------------------------------------------------

  const std::vector<SafeInterval>& safeIntervals(int station) {
    std::optional<std::vector<SafeInterval>>& known = safe_intervals_[std::size_t(station)];
    if (known) return *known;
    known.emplace();
    const VectorXd& q = configurations_[std::size_t(station)];
    const std::vector<double>& breaks = check_.scene().breaks();
    for (std::size_t i = 1; i < breaks.size(); ++i) addSafeIntervals(q, breaks[i - 1], breaks[i], *known);
    if (check_.isFree(q, breaks.back())) add({breaks.back(), kForever}, *known);
    return *known;
  }

  static void add(SafeInterval more, std::vector<SafeInterval>& times) {
    if (!times.empty() && times.back().end == more.begin) {
      times.back().end = more.end;
    } else {
      times.push_back(more);
    }
  }

  void addSafeIntervals(const VectorXd& q, double begin, double end, std::vector<SafeInterval>& times) {
    if (check_.staysFree(q, begin, end)) {
      add({begin, end}, times);
    } else if (end - begin > .5 * step_) {
      const double middle = .5 * (begin + end);
      addSafeIntervals(q, begin, middle, times);
      addSafeIntervals(q, middle, end, times);
    }
  }

  /// The index of the first safe interval of a station that ends after t.
  int intervalAfter(int station, double t) {
    const std::vector<SafeInterval>& times = safeIntervals(station);
    return int(std::partition_point(times.begin(), times.end(), [&](const SafeInterval& f) { return f.end < t; }) -
               times.begin());
  }

  bool wasVisited(int station, int interval) const {
    return std::ranges::any_of(nodes_, [&](const Node& n) { return n.station == station && n.interval == interval; });
  }

  // --- legs --------------------------------------------------------------------------------------------------------

  Leg& legOf(int from, int to) {
    Leg& leg = legs_[std::size_t(from) * places_.size() + std::size_t(to)];
    if (!leg.was_made) leg = makeLeg(places_[std::size_t(from)], places_[std::size_t(to)]);
    return leg;
  }

  Leg makeLeg(double from, double to) const {
    Leg leg;
    leg.was_made = true;
    const CurvePart part = partOf(curve_, from, to);
    RetimeOptions options;
    options.intervals = 20 + int(80. * part.curve.length() / curve_.length());
    if (from == 0. && start_speed_ > 0.) {
      const MotionState start = motionAt(curve_, fastest_, 0.);
      options.start_velocity = start.velocity;
      if (limits_.limitsJerk()) options.start_acceleration = start.acceleration;
    }
    const TimedPath timed = retime(MatrixXd(), part.curve, limits_, options);
    leg.is_possible = timed.feasible();
    if (leg.is_possible) {
      leg.scaling = part.onWhole(timed.scaling());
    } else if (from == 0. && std::abs(to - first_stop_) <= kSame * curve_.length()) {
      leg.scaling = part.onWhole(part.restOf(fastest_, 0.));  // the fastest scaling stops there
      leg.is_possible = true;
    }
    return leg;
  }

  /// The shortest duration from rest at a station to the goal.
  double restOf(int station) {
    if (station == last()) return 0.;
    const Leg& leg = legOf(station, last());
    return leg.is_possible ? leg.scaling.duration() : fastest_.duration() - passes_[std::size_t(station)];
  }

  void expand(int index) {
    const Node node = nodes_[std::size_t(index)];
    const bool moves = node.station == 0 && start_speed_ > 0.;
    for (int to = node.station + 1; to <= last(); ++to) {
      const double least = passes_[std::size_t(to)] - passes_[std::size_t(node.station)];
      for (int slower = 0; slower < (moves ? 1 : int(std::size(kSlower))); ++slower)
        push({node.arrival + kSlower[slower] * least, 0, index, to, slower, node.arrival});
    }
  }

  void push(Entry entry) {
    entry.order = order_++;
    queue_.push(entry);
  }

  bool isFree(Leg& leg, int slower, double departure) {
    const double factor = kSlower[slower];
    ++result_.tries;
    if (!check_.isFree(motionAt(curve_, leg.scaling, leg.suspect).q, departure + factor * leg.suspect)) return false;
    TimeScaling scaling = leg.scaling;
    if (factor != 1.) scaling.slowDown(factor);
    const auto contact = check_.contact(curve_, scaling, limits_.acceleration, departure);
    if (contact) leg.suspect = (contact->time - departure) / factor;
    return !contact;
  }

  // --- the search --------------------------------------------------------------------------------------------------

  void search() {
    const int interval = intervalAfter(0, 0.);
    const bool moves = start_speed_ > 0.;
    if (!moves && (interval == int(safeIntervals(0).size()) || safeIntervals(0)[std::size_t(interval)].begin > 0.)) {
      const auto [a, b] = blockers(0, 0., 0.);
      result_.message = cat("at the start and at time 0, ", describeContact(a, b));
      return;
    }
    nodes_.push_back({0, interval, 0.});
    expand(0);
    while (!queue_.empty() && result_.tries < kMostTries) {
      if (cancellation_ && cancellation_()) return;
      const Entry entry = queue_.top();
      queue_.pop();
      if (!take(entry)) continue;
      result_.was_found = true;
      assemble(int(nodes_.size()) - 1);
      return;
    }
  }

  /// Expands an entry of the queue. True if it reaches the goal.
  bool take(Entry entry) {
    const Node node = nodes_[std::size_t(entry.node)];
    Leg& leg = legOf(node.station, entry.to);
    if (!leg.is_possible) return false;
    const double duration = kSlower[entry.slower] * leg.scaling.duration(), arrival = entry.departure + duration,
                 least = arrival + restOf(entry.to);
    if (least > entry.least) {  // `least` used an estimate of the duration
      entry.least = least;
      push(entry);
      return false;
    }
    const int interval = intervalAfter(entry.to, arrival);
    const std::vector<SafeInterval>& times = safeIntervals(entry.to);
    if (interval == int(times.size())) return false;
    const SafeInterval there = times[std::size_t(interval)];
    const bool stays = entry.to != last() || there.end == kForever;
    if (there.begin > arrival) {
      delay(entry, node, there.begin - arrival);
    } else if (!stays || wasVisited(entry.to, interval)) {
      delay(entry, node, there.end - arrival);
    } else if (!isFree(leg, entry.slower, entry.departure)) {
      delay(entry, node, 0.);
    } else {
      nodes_.push_back({entry.to, interval, arrival, entry.node, entry.slower, entry.departure});
      if (entry.to == last()) return true;
      expand(int(nodes_.size()) - 1);
      delay(entry, node, there.end - arrival);
    }
    return false;
  }

  /// Pushes the entry again with a departure that is later by at least `least`.
  void delay(Entry entry, const Node& node, double least) {
    const bool moves = node.station == 0 && start_speed_ > 0., changes = entry.departure < check_.scene().end();
    if (moves || !changes || least == kForever) return;
    const double by = std::max(step_, least);
    if (entry.departure + by > safeIntervals(node.station)[std::size_t(node.interval)].end) return;
    entry.departure += by;
    entry.least += by;
    push(entry);
  }

  void assemble(int goal) {
    std::vector<int> chain;
    for (int i = goal; i > 0; i = nodes_[std::size_t(i)].before) chain.push_back(i);
    std::reverse(chain.begin(), chain.end());
    for (const int i : chain) {
      const Node &node = nodes_[std::size_t(i)], &before = nodes_[std::size_t(node.before)];
      const double place = places_[std::size_t(before.station)], wait = node.departure - before.arrival;
      if (wait > 0.) {
        result_.waits.push_back({before.arrival, wait, place});
        result_.scaling.add({0., {place, 0., 0., 0.}, 0., place, curve_.pieceAt(place)}, wait);
      }
      TimeScaling scaling = legOf(before.station, node.station).scaling;
      if (node.slower) scaling.slowDown(kSlower[node.slower]);
      result_.scaling.append(scaling);
    }
  }

  // --- messages ----------------------------------------------------------------------------------------------------

  /// The pair in collision at a station during an interval.
  std::pair<int, int> blockers(int station, double begin, double end) {
    check_.staysFree(configurations_[std::size_t(station)], begin, end);
    return check_.lastPair();
  }

  std::string describeContact(int a, int b) const {
    const KinematicModel& model = check_.scene().state().model();
    if (check_.scene().isObstacle(a)) std::swap(a, b);
    return cat("'", model.frame_name[std::size_t(a)], "' meets '", model.frame_name[std::size_t(b)], "'");
  }

  std::string failure() const {
    if (cancellation_ && cancellation_()) return "stopped before a timing was found";
    const DynamicContact& met = *result_.met;
    return cat("no timing along the path was found in ", result_.tries, " tries; without waiting, ",
               describeContact(met.a, met.b), " at ", met.time, " s, at ",
               std::lround(100. * met.place / std::max(curve_.length(), 1e-300)), " % of the path");
  }

  const PathCurve& curve_;
  const TimeScaling& fastest_;
  const MotionLimits& limits_;
  DynamicCheck& check_;
  const CancellationToken& cancellation_;
  const double step_;  ///< between departures, s
  double start_speed_, first_stop_;
  std::vector<double> places_, passes_;  ///< of stations: s, and the time of the fastest scaling
  std::vector<VectorXd> configurations_;
  std::vector<std::optional<std::vector<SafeInterval>>> safe_intervals_;
  std::vector<Leg> legs_;
  std::vector<Node> nodes_;
  std::priority_queue<Entry> queue_;
  long order_ = 0;
  DynamicTiming result_;
};

}  // namespace

DynamicTiming timeAmongObstacles(const TimedPath& fastest, const MotionLimits& limits, DynamicCheck& check,
                                 const CancellationToken& cancellation) {
  return TimeSearch(fastest, limits, check, cancellation).run();
}

}  // namespace kinegraph::inline planning_internal
