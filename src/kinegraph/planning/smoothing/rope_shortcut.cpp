#include "kinegraph/planning/smoothing/rope_shortcut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "kinegraph/planning/steering/pair_gradient.h"

namespace kinegraph::inline planning_internal {

namespace {

constexpr int kPieces = 20;          // of a path, approximately
constexpr double kShortest = .05;    // piece
constexpr double kLeastGain = 3e-3;  // least relative gain of a round
constexpr double kGainRatio = .25;   // of the least gain, from one refinement to the next
constexpr double kFinest = .01;      // shortest piece that is refined
constexpr double kSpare = 1e-3;      // m, that rows keep beyond the margin if the path does
constexpr double kNearRow = .25;     // pieces: a new row of the same pair within this distance replaces the old one
constexpr double kDeepest = .03;     // m: the normal of a deeper penetration is not reliable
constexpr int kTrials = 4;           // of a round, each with the rows that the one before added
constexpr int kKept = 4;             // rounds that an inactive row stays
constexpr double kFirstStep = .5, kLongestStep = 4., kShortestStep = .03;  // of a point in a round
constexpr int kSweeps = 200;
constexpr double kForceAccuracy = 1e-3;  // of the largest force
constexpr double kStraight = 1e-3;       // rad or m: largest change of the path when a point is removed

/// A constraint on the path: the linearized distance of a pair at one place.
struct Row {
  int a, b;             ///< frames
  double place;         ///< in pieces
  VectorXd slope = {};  ///< slope . x(place) >= least
  double least = 0.;
  double force = 0.;  ///< >= 0
  int idle = 0;       ///< rounds without a force
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
      least_gain_ *= kGainRatio;
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

  /// Iterates until the gains are small.
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

  /// Halves the pieces with active rows: around a corner the path is a polygon, and with more sides it may be shorter.
  /// False if there are none.
  bool refine() {
    std::vector<char> touches(points_.size() - 1, false);
    for (const Row& row : rows_)
      if (row.force > 0.) touches[std::min(std::size_t(row.place), touches.size() - 1)] = true;
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

  /// Divides the edges of the path into pieces of similar length.
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

  // --- minimum of the energy under the rows ------------------------------------------------------------------------

  /// The displacement of the rope at place u under a unit force at place v.
  double compliance(double u, double v) const {
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

  /// Linearizes a row at its place of a path. The distance has to be the margin, and slightly more if the present path
  /// has more.
  void linearize(Row& row, const Points& path) {
    const VectorXd q = at(path, row.place);
    PairGradient pair = gradientAt(row, q);
    const VectorXd free_q = at(points_, row.place);
    const double free = &path == &points_ ? pair.distance : gradientAt(row, free_q).distance,
                 needed = steering_.check().marginAt(free_q);
    row.slope = std::move(pair.gradient);
    row.least = row.slope.dot(q) + needed + std::clamp(free - needed, 0., kSpare) - pair.distance;
  }

  /// Returns the path of least energy under the rows.
  Points solve() {
    along_.assign(1, 0.);
    for (std::size_t i = 1; i < points_.size(); ++i)
      along_.push_back(along_.back() + std::max(distance(points_[i - 1], points_[i]), 1e-9));
    const VectorXd inverse_weight = weight_.cwiseAbs2().cwiseInverse();
    const VectorXd all = points_.back() - points_.front();
    const auto count = Eigen::Index(rows_.size());
    MatrixXd G(count, count);
    VectorXd missing(count);  // violations on the straight line
    for (Eigen::Index r = 0; r < count; ++r) {
      const Row& row = rows_[std::size_t(r)];
      double share = 0.;
      for (const auto& [i, of_i] : ends(row.place)) share += of_i * along_[i] / along_.back();
      missing[r] = row.least - row.slope.dot(points_.front() + share * all);
      const VectorXd direction = row.slope.cwiseProduct(inverse_weight);
      for (Eigen::Index c = 0; c <= r; ++c)
        G(r, c) = G(c, r) =
            direction.dot(rows_[std::size_t(c)].slope) * compliance(row.place, rows_[std::size_t(c)].place);
    }
    findForces(G, missing);
    Points points;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      VectorXd q = points_.front() + along_[i] / along_.back() * all;
      for (const Row& row : rows_)
        if (row.force > 0.) q += row.force * compliance(double(i), row.place) * row.slope.cwiseProduct(inverse_weight);
      points.push_back(std::move(q));
    }
    points.front() = points_.front();
    points.back() = points_.back();
    return points;
  }

  /// Solves the complementarity problem G f >= missing, f >= 0, by Gauss-Seidel sweeps.
  void findForces(const MatrixXd& G, const VectorXd& missing) {
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      double most = 0., change = 0.;
      for (std::size_t r = 0; r < rows_.size(); ++r) {
        const auto row = Eigen::Index(r);
        if (!(G(row, row) > 1e-12)) continue;
        double sum = 0.;
        for (std::size_t c = 0; c < rows_.size(); ++c) sum += G(row, Eigen::Index(c)) * rows_[c].force;
        const double old = rows_[r].force;
        rows_[r].force = std::max(0., old + (missing[row] - sum) / G(row, row));
        change = std::max(change, std::abs(rows_[r].force - old));
        most = std::max(most, rows_[r].force);
      }
      if (change <= kForceAccuracy * most) return;
    }
  }

  // --- steps -------------------------------------------------------------------------------------------------------

  enum class Outcome { whole, part, blocked, nothing_to_gain };

  /// Takes one step towards the minimum, if it is collision-free.
  Outcome improve(double before) {
    for (Row& row : rows_) row.idle = row.force > 0. ? 0 : row.idle + 1;
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

  /// Moves the points by a share of their distance to the target.
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

  /// Unrolls endless dofs, so that edges are differences of points.
  Points unrolled(Points points) const {
    if (steering_.space().isPlain()) return points;
    const MatrixXd rows = steering_.space().unroll(points);
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = rows.row(Eigen::Index(i)).transpose();
    return points;
  }

  /// Checks the edges of a path. Every contact becomes a row.
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

  /// Adds a row for a contact on a piece of a path, at the place where the pair is closest.
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
      if (replaced) row.force = other.force;
      return replaced;
    });
    linearize(row, nearest > -kDeepest ? path : points_);
    rows_.push_back(std::move(row));
  }

  /// Removes points at which the path is nearly straight.
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
  steering.check().forget();  // results must not depend on earlier checks
  return RopeShortcut(steering, path, options).run();
}

}  // namespace kinegraph::inline planning_internal
