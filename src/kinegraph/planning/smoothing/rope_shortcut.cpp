#include "kinegraph/planning/smoothing/rope_shortcut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "kinegraph/planning/steering/pair_gradient.h"

namespace kinegraph {

namespace {

constexpr int kPieces = 20;          // of a path, about
constexpr double kShortest = .05;    // piece
constexpr double kLeastGain = 3e-3;  // of a round, as a share of the length
constexpr double kFiner = .25;       // is what a refinement gains, of what the one before did
constexpr double kFinest = .01;      // piece that is refined
constexpr double kSpare = 1e-3;      // m, that rows keep above what is needed, where the path does
constexpr double kNearRow = .25;     // pieces: a new row of the same pair as near as that takes the old one's place
constexpr double kDeepest = .03;     // m: what overlaps more has a direction that says little
constexpr int kTrials = 4;           // of a round, each with what the one before met
constexpr int kKept = 4;             // rounds that a row stays without a pull
constexpr double kFirstStep = .5, kLongestStep = 4., kShortestStep = .03;  // of a point in a round
constexpr int kSweeps = 200;
constexpr double kPullAccuracy = 1e-3;  // of the largest pull
constexpr double kStraight = 1e-3;      // rad or m that a path may change by where a posture is left out

/// What keeps the path from being shorter: at one place of it, a pair of bodies.
struct Row {
  int a, b;             ///< frames
  double place;         ///< in pieces
  VectorXd slope = {};  ///< slope . x(place) >= least
  double least = 0.;
  double pull = 0.;  ///< >= 0
  int idle = 0;      ///< rounds without a pull
};

class RopeShortcut {
 public:
  RopeShortcut(Steering& steering, const std::vector<VectorXd>& path, const RopeShortcutOptions& options)
      : steering_(steering), options_(options), state_(steering.check().scene()) {
    weight_ = options.weight.size() > 0 ? options.weight : VectorXd::Ones(steering.space().dofs());
    divide(path);
  }

  std::vector<VectorXd> run() {
    settle();
    for (int i = 0; i < options_.refinements && !stopped() && refine(); ++i) {
      least_gain_ *= kFiner;
      step_ = kFirstStep;
      settle();
    }
    dropStraight();
    return std::move(points_);
  }

 private:
  using Points = std::vector<VectorXd>;

  bool stopped() const { return options_.cancellation && options_.cancellation(); }
  double distance(const VectorXd& a, const VectorXd& b) const { return (b - a).cwiseProduct(weight_).norm(); }

  double length(const Points& points) const {
    double sum = 0.;
    for (std::size_t i = 1; i < points.size(); ++i) sum += distance(points[i - 1], points[i]);
    return sum;
  }

  /// Rounds until little is gained.
  void settle() {
    int small = 0;  // gains in a row
    for (; rounds_ < options_.rounds && !stopped(); ++rounds_) {
      const double before = length(points_);
      const Outcome outcome = improve(before);
      if (outcome == Outcome::nothing_to_gain || step_ < kShortestStep) break;
      if (outcome == Outcome::blocked) continue;
      small = length(points_) > (1. - least_gain_) * before ? small + 1 : 0;
      if (small > 0 && (outcome == Outcome::whole || small > 1)) break;
    }
  }

  /// Halves the pieces at which something pulls: around a corner the path is a polygon, and the more sides it has, the
  /// shorter it may be. False if there are none.
  bool refine() {
    std::vector<char> touches(points_.size() - 1, false);
    for (const Row& row : rows_)
      if (row.pull > 0.) touches[std::min(std::size_t(row.place), touches.size() - 1)] = true;
    Points finer = {points_.front()};
    std::vector<double> places;  // of the old points among the new ones
    for (std::size_t i = 0; i < touches.size(); ++i) {
      touches[i] = touches[i] && distance(points_[i], points_[i + 1]) > kFinest;
      places.push_back(double(finer.size()) - 1.);
      if (touches[i]) finer.push_back(.5 * (points_[i] + points_[i + 1]));
      finer.push_back(points_[i + 1]);
    }
    for (Row& row : rows_) {
      const std::size_t i = std::min(std::size_t(row.place), touches.size() - 1);
      row.place = places[i] + (touches[i] ? 2. : 1.) * (row.place - double(i));
    }
    const bool is_finer = finer.size() > points_.size();
    points_ = std::move(finer);
    return is_finer;
  }

  /// Postures of the path become points, with others between them such that no piece is long.
  void divide(const Points& path) {
    const Points corners = unrolled(path);
    const double piece = std::max(length(corners) / kPieces, kShortest);
    points_ = {corners.front()};
    for (std::size_t k = 1; k < corners.size(); ++k) {
      const int parts = std::max(1, int(std::lround(distance(corners[k - 1], corners[k]) / piece)));
      for (int i = 1; i < parts; ++i)
        points_.push_back(corners[k - 1] + double(i) / parts * (corners[k] - corners[k - 1]));
      points_.push_back(corners[k]);
    }
  }

  VectorXd at(const Points& points, double place) const {
    const auto i = std::min(std::size_t(place), points.size() - 2);
    return points[i] + (place - double(i)) * (points[i + 1] - points[i]);
  }

  // --- the string between its rows ---------------------------------------------------------------------------------

  /// How far the string goes at place u when it is pulled with 1 at place v.
  double give(double u, double v) const {
    double sum = 0.;
    for (const auto& [i, of_i] : ends(u)) {
      for (const auto& [j, of_j] : ends(v))
        sum += of_i * of_j * std::min(along_[i], along_[j]) * (1. - std::max(along_[i], along_[j]) / along_.back());
    }
    return sum;
  }

  using Ends = std::array<std::pair<std::size_t, double>, 2>;
  Ends ends(double place) const {
    const auto i = std::min(std::size_t(place), points_.size() - 2);
    const double share = place - double(i);
    return {{{i, 1. - share}, {i + 1, share}}};
  }

  PairGradient gradientAt(const Row& row, const VectorXd& q) {
    state_.setJoints(q.data());
    return pairGradient(state_, row.a, row.b);
  }

  /// The row as it is where a path has its place: the distance there, linearized, is to be what is needed, and a little
  /// more where the path that is free has more.
  void linearize(Row& row, const Points& path) {
    const VectorXd q = at(path, row.place);
    PairGradient pair = gradientAt(row, q);
    const VectorXd free_q = at(points_, row.place);
    const double free = &path == &points_ ? pair.distance : gradientAt(row, free_q).distance,
                 needed = steering_.check().marginAt(free_q);
    row.slope = std::move(pair.gradient);
    row.least = row.slope.dot(q) + needed + std::clamp(free - needed, 0., kSpare) - pair.distance;
  }

  /// The string of least energy, by one pull after the other.
  Points solve() {
    along_.assign(1, 0.);
    for (std::size_t i = 1; i < points_.size(); ++i)
      along_.push_back(along_.back() + std::max(distance(points_[i - 1], points_[i]), 1e-9));
    const VectorXd compliance = weight_.cwiseAbs2().cwiseInverse();
    const VectorXd all = points_.back() - points_.front();
    const auto count = Eigen::Index(rows_.size());
    MatrixXd G(count, count);
    VectorXd missing(count);  // of what a row needs, on the straight line
    for (Eigen::Index r = 0; r < count; ++r) {
      const Row& row = rows_[std::size_t(r)];
      double share = 0.;
      for (const auto& [i, of_i] : ends(row.place)) share += of_i * along_[i] / along_.back();
      missing[r] = row.least - row.slope.dot(points_.front() + share * all);
      const VectorXd pulled = row.slope.cwiseProduct(compliance);
      for (Eigen::Index c = 0; c <= r; ++c)
        G(r, c) = G(c, r) = pulled.dot(rows_[std::size_t(c)].slope) * give(row.place, rows_[std::size_t(c)].place);
    }
    pull(G, missing);
    Points points;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      VectorXd q = points_.front() + along_[i] / along_.back() * all;
      for (const Row& row : rows_)
        if (row.pull > 0.) q += row.pull * give(double(i), row.place) * row.slope.cwiseProduct(compliance);
      points.push_back(std::move(q));
    }
    points.front() = points_.front();
    points.back() = points_.back();
    return points;
  }

  /// G pull >= missing, pull >= 0, and one of both is an equality.
  void pull(const MatrixXd& G, const VectorXd& missing) {
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      double most = 0., change = 0.;
      for (std::size_t r = 0; r < rows_.size(); ++r) {
        const auto row = Eigen::Index(r);
        if (!(G(row, row) > 1e-12)) continue;
        double given = 0.;
        for (std::size_t c = 0; c < rows_.size(); ++c) given += G(row, Eigen::Index(c)) * rows_[c].pull;
        const double old = rows_[r].pull;
        rows_[r].pull = std::max(0., old + (missing[row] - given) / G(row, row));
        change = std::max(change, std::abs(rows_[r].pull - old));
        most = std::max(most, rows_[r].pull);
      }
      if (change <= kPullAccuracy * most) return;
    }
  }

  // --- steps -------------------------------------------------------------------------------------------------------

  enum class Outcome { whole, part, blocked, nothing_to_gain };

  /// One round: a shorter path near this one, if that is free.
  Outcome improve(double before) {
    for (Row& row : rows_) row.idle = row.pull > 0. ? 0 : row.idle + 1;
    std::erase_if(rows_, [](const Row& row) { return row.idle > kKept; });
    for (Row& row : rows_) linearize(row, points_);
    double size = 0.;
    for (int trial = 0; trial < kTrials && !stopped(); ++trial) {
      const Points target = solve();
      size = 0.;
      for (std::size_t i = 0; i < target.size(); ++i) size = std::max(size, (target[i] - points_[i]).norm());
      const double share = std::min(1., step_ / std::max(size, 1e-12));
      Points points = moved(target, share);
      if (length(points) >= (1. - .2 * least_gain_) * before) return Outcome::nothing_to_gain;
      if (!isFree(points)) continue;
      points_ = std::move(points);
      step_ = std::min(2. * step_, kLongestStep);
      return share == 1. ? Outcome::whole : Outcome::part;
    }
    step_ = .5 * std::min(step_, size);
    return Outcome::blocked;
  }

  /// The points, that share of the way to others.
  Points moved(const Points& target, double share) const {
    const JointSpace& space = steering_.space();
    Points trial = points_;
    for (std::size_t i = 1; i + 1 < trial.size(); ++i) {
      trial[i] += share * (target[i] - points_[i]);
      space.clamp(trial[i]);
      space.normalize(trial[i]);
    }
    return unrolled(std::move(trial));
  }

  /// Straight motions add what `difference` says, so that endless dofs count turns.
  Points unrolled(Points points) const {
    if (steering_.space().isPlain()) return points;
    const MatrixXd rows = steering_.space().unroll(points);
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = rows.row(Eigen::Index(i)).transpose();
    return points;
  }

  /// Are all motions of a path free? What is met becomes a row.
  bool isFree(const Points& path) {
    bool is_free = true;
    for (std::size_t i = 1; i < path.size(); ++i) {
      const auto contact = steering_.check().contact(path[i - 1], path[i]);
      if (!contact) continue;
      is_free = false;
      addRow(path, i - 1, *contact);
    }
    return is_free;
  }

  /// A row for a contact on one piece of a path, at the place of it where the pair is nearest.
  void addRow(const Points& path, std::size_t piece, const MotionContact& contact) {
    Row row{contact.a, contact.b, 0.};
    double nearest = std::numeric_limits<double>::infinity();
    for (const double share : {contact.time, 0., .25, .5, .75, 1.}) {
      const double place = double(piece) + share, distance = gradientAt(row, at(path, place)).distance;
      if (distance >= nearest) continue;
      nearest = distance;
      row.place = place;
    }
    std::erase_if(rows_, [&](const Row& other) {
      const bool replaced = other.a == row.a && other.b == row.b && std::abs(other.place - row.place) < kNearRow;
      if (replaced) row.pull = other.pull;
      return replaced;
    });
    linearize(row, nearest > -kDeepest ? path : points_);
    rows_.push_back(std::move(row));
  }

  /// Leaves out postures where the path is straight.
  void dropStraight() {
    for (std::size_t i = 1; i + 1 < points_.size();) {
      const VectorXd chord = points_[i + 1] - points_[i - 1], side = points_[i] - points_[i - 1];
      const double share = std::clamp(side.dot(chord) / std::max(chord.squaredNorm(), 1e-18), 0., 1.);
      if ((side - share * chord).norm() < kStraight && steering_.check().isMotionFree(points_[i - 1], points_[i + 1])) {
        points_.erase(points_.begin() + std::ptrdiff_t(i));
      } else {
        ++i;
      }
    }
  }

  Steering& steering_;
  const RopeShortcutOptions& options_;
  State state_;
  VectorXd weight_;
  Points points_;
  std::vector<double> along_;  ///< per point, the length up to it
  std::vector<Row> rows_;
  double step_ = kFirstStep;  ///< of a point, at most
  double least_gain_ = kLeastGain;
  int rounds_ = 0;
};

}  // namespace

std::vector<VectorXd> tightenPath(Steering& steering, const std::vector<VectorXd>& path,
                                  const RopeShortcutOptions& options) {
  if (steering.isConstrained() || path.size() < 3) return path;
  steering.check().forget();  // which pair is met first must not depend on what was asked before
  return RopeShortcut(steering, path, options).run();
}

}  // namespace kinegraph
