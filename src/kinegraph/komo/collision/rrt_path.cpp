#include "kinegraph/komo/collision/rrt_path.h"

#include <algorithm>
#include <limits>

#include "kinegraph/rrt/rrt_connect.h"
#include "kinegraph/rrt/shortcutter.h"

namespace kinegraph::inline komo_internal {

namespace {

constexpr double kRange = .25;  // of an extension, as a share of the straight edge between the ends
constexpr int kCuts = 40;       // random shortcuts

/// Configurations whose dofs outside of the bounds are fixed. Every edge is checked exactly.
class BoundedSpace {
 public:
  static constexpr bool kVerifiesExtensions = true;

  BoundedSpace(EdgeChecker& checker, const SampleBounds& bounds) : checker_(checker), bounds_(bounds) {}

  int dofs() const { return checker_.scene().dofs(); }
  static bool isConstrained() { return false; }
  static void normalize(VectorXd&) {}
  static VectorXd difference(const VectorXd& from, const VectorXd& to) { return to - from; }
  long evaluations() const { return evaluations_; }

  double squaredDistance(const double* a, const double* b) const {
    double square = 0.;
    for (const int dof : bounds_.dofs) square += (b[dof] - a[dof]) * (b[dof] - a[dof]);
    return square;
  }

  std::optional<VectorXd> sample(Rng& rng, const VectorXd& like) const {
    VectorXd q = like;
    for (std::size_t i = 0; i < bounds_.dofs.size(); ++i)
      q[bounds_.dofs[i]] = rng.uniform(bounds_.lower[Eigen::Index(i)], bounds_.upper[Eigen::Index(i)]);
    return q;
  }

  std::optional<VectorXd> sampleNear(Rng& rng, const VectorXd& center, double radius) const {
    const VectorXd away = *sample(rng, center) - center;
    return center + std::min(1., rng.uniform(0., radius) / std::max(away.norm(), 1e-9)) * away;
  }

  Extension extend(const VectorXd& from, const VectorXd& target, double range) {
    const VectorXd change = target - from;
    const double length = change.norm();
    const bool reaches = length <= range;
    const VectorXd end = reaches ? target : VectorXd(from + range / length * change);
    if (!isEdgeFree(from, end)) return {};
    return {{end}, reaches};
  }

  bool isEdgeFree(const VectorXd& from, const VectorXd& to) {
    ++evaluations_;
    return checker_.isFree(from.data(), to.data());
  }

  std::optional<std::vector<VectorXd>> connect(const VectorXd& from, const VectorXd& to) {
    return isEdgeFree(from, to) ? std::optional(std::vector<VectorXd>()) : std::nullopt;
  }

 private:
  EdgeChecker& checker_;
  const SampleBounds& bounds_;
  long evaluations_ = 0;
};

}  // namespace

std::vector<VectorXd> rrtPath(EdgeChecker& checker, const SampleBounds& bounds, const VectorXd& from,
                              const VectorXd& to, Rng& rng, int max_samples) {
  VectorXd fixed = to - from;
  fixed(bounds.dofs).setZero();
  if (!fixed.isZero(0.) || !checker.isFree(from.data()) || !checker.isFree(to.data())) return {};
  if (from == to) return {from, to};
  BoundedSpace space(checker, bounds);
  const double range = kRange * (to - from).norm();
  RrtConnectOptions options;
  options.range = options.least_radius = range;
  options.dynamic_radius = std::numeric_limits<double>::infinity();  // few samples: every one extends a tree
  options.seed = rng.bits();
  options.max_evaluations = std::numeric_limits<long>::max();
  options.max_samples = max_samples;
  RrtConnect search(space, {from}, {to}, options);
  if (!search.run([] { return false; })) return {};
  std::vector<VectorXd> path =
      Shortcutter(space, search.path(), {.cuts = kCuts, .corners = false, .seed = rng.bits()}).run();
  // Random shortcuts add corners; every corner needs a slice.
  return Shortcutter(space, std::move(path), {.cuts = 0, .corners = false}).run();
}

}  // namespace kinegraph::inline komo_internal
