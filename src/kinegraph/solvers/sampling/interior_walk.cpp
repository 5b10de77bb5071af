#include "kinegraph/solvers/sampling/interior_walk.h"

#include <Eigen/QR>

#include <cmath>
#include <limits>
#include <optional>

namespace kinegraph::inline solvers_internal {

namespace {

constexpr double kOnSurface = 1e-9;  ///< |eq| of a projected point

/// Hit-and-run: samples uniformly on random lines x + t d through the feasible set.
class HitAndRun {
 public:
  HitAndRun(SampledProblem& problem, Rng& rng) : problem_(problem), rng_(rng) {}

  /// Samples a point of the line within the set: each infeasible sample shrinks the interval (Neal 2003, sec. 4.2).
  void step(SampledPoint& point) {
    VectorXd d = normalVector(point.x.size(), rng_);
    for (Eigen::Index i = 0; i < d.size(); ++i) {
      if (problem_.nlp().lower()[i] == problem_.nlp().upper()[i]) d[i] = 0.;
    }
    if (d.norm() == 0.) return;
    d.normalize();
    auto [low, high] = interval(point, d);
    while (high - low > 1e-14 && !problem_.cancelled()) {
      const double t = rng_.uniform(low, high);
      const VectorXd x =
          (point.x + t * d).cwiseMax(problem_.nlp().lower()).cwiseMin(problem_.nlp().upper());  // rounding only
      SampledPoint next = problem_.at(x);
      if (contains(next)) {
        point = std::move(next);
        return;
      }
      (t < 0. ? low : high) = t;
    }
  }

 private:
  bool contains(const SampledPoint& point) const {
    if (!std::isfinite(point.slack)) return false;
    const auto& types = problem_.nlp().types();
    double slack = 0.;
    for (int row = 0; row < point.phi.size(); ++row) {
      const double v = violation(types[row], point.phi[row]);
      slack += types[row] == ObjectiveType::eq ? std::max(0., v - problem_.options().hitRunEqMargin) : v;
    }
    return slack <= problem_.options().tolerance + problem_.options().eps;
  }

  /// Returns the interval of t in which the line is within the bounds. If there are no bounds, steps extend the
  /// interval until it leaves the set (Neal 2003, fig. 3).
  std::pair<double, double> interval(const SampledPoint& point, const VectorXd& d) {
    double low = -std::numeric_limits<double>::infinity(), high = -low;
    for (Eigen::Index i = 0; i < d.size(); ++i) {
      if (d[i] == 0.) continue;
      const double a = (problem_.nlp().lower()[i] - point.x[i]) / d[i],
                   b = (problem_.nlp().upper()[i] - point.x[i]) / d[i];
      low = std::max(low, std::min(a, b));
      high = std::min(high, std::max(a, b));
    }
    const double width = problem_.options().interiorNoiseSigma, shift = rng_.uniform() * width;
    constexpr int kSteps = 100;
    const int down = int(rng_.uniform(0., kSteps));
    const auto stepOut = [&](double bound, double from, double step, int steps) {
      if (std::isfinite(bound)) return bound;
      while (steps-- > 0 && !problem_.cancelled() && contains(problem_.at(point.x + from * d))) from += step;
      return from;
    };
    return {stepOut(low, -shift, -width, down), stepOut(high, width - shift, width, kSteps - 1 - down)};
  }

  SampledProblem& problem_;
  Rng& rng_;
};

/// Metropolis steps along the tangents of the equalities, projected back along their normals. A step is rejected if the
/// reverse step does not lead back to its start.
class SurfaceWalk {
 public:
  SurfaceWalk(SampledProblem& problem, bool with_gradient, Rng& rng)
      : problem_(problem), with_gradient_(with_gradient), rng_(rng) {
    const SamplerOptions& options = problem.options();
    tau_ = with_gradient && options.langevinTauPrime > 0. ? options.langevinTauPrime
                                                          : .5 * std::pow(options.interiorNoiseSigma, 2);
  }

  /// Projects a point near the surface onto it.
  void begin(SampledPoint& point) {
    if (!problem_.hasEqualities()) return;
    if (std::optional<SampledPoint> on = project(point.x, placeAt(point)); on && problem_.isFeasible(*on))
      point = std::move(*on);
  }

  void step(SampledPoint& point) {
    if (!here_ || here_x_ != point.x) {
      here_ = placeAt(point);
      here_x_ = point.x;
    }
    const VectorXd v =
        here_->drift + std::sqrt(2. * tau_) * (here_->tangents * normalVector(here_->tangents.cols(), rng_));
    std::optional<SampledPoint> next = project(point.x + v, *here_);
    if (!next || !problem_.isFeasible(*next)) return;
    const Place there = placeAt(*next);
    const VectorXd back = there.tangents * (there.tangents.transpose() * (point.x - next->x));
    double log_ratio = point.energy - next->energy;
    log_ratio += ((v - here_->drift).squaredNorm() - (back - there.drift).squaredNorm()) / (4. * tau_);
    if (!(std::log(rng_.uniform()) < log_ratio)) return;
    if (problem_.hasEqualities()) {
      const std::optional<SampledPoint> returned = project(next->x + back, there);
      if (!returned || (returned->x - point.x).norm() > 1e-5) return;
    }
    point = std::move(*next);
    here_ = there;
    here_x_ = point.x;
  }

 private:
  struct Place {
    MatrixXd tangents, normals;  ///< orthonormal
    VectorXd drift;
  };

  Place placeAt(const SampledPoint& point) {
    const Eigen::Index n = point.x.size();
    Place place;
    if (problem_.hasEqualities()) {
      const Eigen::ColPivHouseholderQR<MatrixXd> qr(problem_.equalityJacobian(point).transpose());
      const MatrixXd Q = qr.householderQ() * MatrixXd::Identity(n, n);
      place.normals = Q.leftCols(qr.rank());
      place.tangents = Q.rightCols(n - qr.rank());
    } else {
      place.tangents = MatrixXd::Identity(n, n);
    }
    place.drift = VectorXd::Zero(n);
    if (with_gradient_)
      place.drift = -tau_ * (place.tangents * (place.tangents.transpose() * problem_.energyGradient(point)));
    return place;
  }

  /// Moves x along the normals of a place to the surface.
  std::optional<SampledPoint> project(VectorXd x, const Place& place) {
    for (int step = 0; step < 12 && !problem_.cancelled(); ++step) {
      SampledPoint point = problem_.at(x);
      const bool finite = point.phi.allFinite();
      if (!problem_.hasEqualities()) return point;
      if (!finite) return std::nullopt;
      const VectorXd h = problem_.equalities(point);
      if (h.lpNorm<Eigen::Infinity>() <= kOnSurface) return point;
      x += place.normals * (problem_.equalityJacobian(point) * place.normals).colPivHouseholderQr().solve(-h);
      if (!x.allFinite()) return std::nullopt;
    }
    return std::nullopt;
  }

  SampledProblem& problem_;
  bool with_gradient_;
  Rng& rng_;
  double tau_;
  std::optional<Place> here_;
  VectorXd here_x_;
};

/// A tree that grows from its nearest point towards random ones. Each new point is projected to the constraints.
class Tree {
 public:
  Tree(SampledProblem& problem, Rng& rng, const SampledPoint& root) : problem_(problem), rng_(rng), points_{root} {}

  void step(SampledPoint& point) {
    const VectorXd target = problem_.nlp().uniformPoint(rng_);
    const SampledPoint* nearest = &points_[0];
    for (const SampledPoint& known : points_) {
      if ((known.x - target).norm() < (nearest->x - target).norm()) nearest = &known;
    }
    const VectorXd offset = target - nearest->x;
    SampledPoint next =
        problem_.at(nearest->x + std::min(1., problem_.options().interiorNoiseSigma / offset.norm()) * offset);
    if (!std::isfinite(next.slack) || !problem_.goDownhill(next, rng_, false)) return;
    points_.push_back(next);
    point = std::move(next);
  }

 private:
  SampledProblem& problem_;
  Rng& rng_;
  std::vector<SampledPoint> points_;
};

}  // namespace

SampledPoint walkInside(SampledProblem& problem, const SampledPoint& start, int steps, Rng& rng) {
  const std::string& method = problem.options().interiorMethod;
  SampledPoint point = start;
  const auto walk = [&](auto&& walker) {
    for (int i = 0; i < steps && !problem.cancelled(); ++i) walker.step(point);
  };
  if (method == "HR") walk(HitAndRun(problem, rng));
  if (method == "MCMC" || method == "Langevin") {
    SurfaceWalk surface(problem, method == "Langevin", rng);
    surface.begin(point);
    walk(surface);
  }
  if (method == "manifoldRRT") walk(Tree(problem, rng, start));
  if (problem.isFeasible(point) || problem.goDownhill(point, rng, false)) return point;
  return start;
}

}  // namespace kinegraph::inline solvers_internal
