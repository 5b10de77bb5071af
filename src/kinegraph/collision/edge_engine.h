#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "kinegraph/collision/cell_separation.h"
#include "kinegraph/collision/displacement_bound.h"
#include "kinegraph/collision/motion_check.h"
#include "kinegraph/collision/placed_samples.h"
#include "kinegraph/geometry/distance/separation.h"

namespace kinegraph::inline collision_internal {

/// The collision checks of EdgeChecker.
///
/// Eight configurations are placed side by side. Spheres around the links exclude most pairs for all of them at once,
/// and boxes most of the other pairs in most of them. For two convex bodies that remain, let n be a direction fixed in
/// their last common ancestor link, along which they are apart by d at q(s) and by d' at q(s + w). In between, they are
/// apart by
///
///     min(d, d') - w^2 / 8 max |d^2p / ds^2|
///
/// because a twice differentiable function exceeds its chord by at most the second term. n is the contact normal at one
/// of the ends; it is tried for the following intervals before another one is computed. For other bodies the bound is
/// (d + d' - w max |dp / ds|) / 2; for solid cells, each cell is a convex body (cell_separation.h). If the bound is too
/// small, the interval is halved. Exact distances are computed only if a separation test (separation.h) does not
/// decide.
class EdgeEngine {
 public:
  using Lane = PlacedSamples::Lane;
  static constexpr int kLanes = PlacedSamples::kMost;
  static constexpr double kFar = std::numeric_limits<double>::infinity();

  EdgeEngine(const State& scene, double tolerance);

  void setTolerance(double tolerance) { tolerance_ = tolerance; }

  /// Writes per configuration (at most kLanes, a row of `Q` each) whether all pairs are at least `margin` apart.
  void areFree(const double* const* Q, int count, double margin, bool* free);

  /// Whether all of them are free. Returns at the first pair that is too close.
  bool areAllFree(const double* const* Q, int count, double margin);

  bool isFree(const double* from, const double* to, double margin);

  void forget() { suspect_ = -1; }

  double clearance(const double* q, double most);
  double clearance(const double* from, const double* to, double most);

  void findApproaches(const double* from, const double* to, double most, std::vector<MotionContact>& found);

  /// The collision of the last check, without its distance (NaN), or with it.
  const std::optional<MotionContact>& lastHit() const { return last_hit_; }
  const std::optional<MotionContact>& measuredHit();

 private:
  struct Candidate {
    LinkBodies::Pair pair;
    int index;  ///< of the pair, -1 if it is not listed
    Lane bounds;
    double least;        ///< of the bounds
    int touching = 0;    ///< the sample in which the inner balls are closest
    bool cells = false;  ///< one of the bodies consists of solid cells, the other one is convex
  };
  /// A separating direction, and the support corners of both bodies along it.
  struct Normal {
    int stamp = 0;  ///< of the check that computed it
    Vector3d n;     ///< in the ancestor, unit, from b to a
    SupportCorners corners;
  };
  /// Gaps of a pair in all samples along a direction.
  struct SampleGaps {
    Vector3d n;
    Lane gaps;
    bool known = false;
  };
  /// A time of the edge: a sample, or a State of its own.
  struct Moment {
    double time;
    const State* state;  ///< null: a sample
    int sample;
  };

  void beginCheck() {  // invalidates the directions of earlier checks
    ++stamp_;
    last_hit_.reset();
  }
  int setEdge(const double* from, const double* to);
  DisplacementBound::Rates ratesOf(const Candidate& candidate);
  const DisplacementBound::Rates& ratesInWorld(int body);
  template <class Hit>
  void forHits(const double* const* Q, int count, double margin, bool all, const Hit& hit);
  const Candidate* findCandidates(double margin, double most = kFar, double near = -kFar);
  bool addPair(const LinkBodies::Pair& pair, int index, double most, double near);
  bool addNearFixed(double margin, double most, double near);
  template <class Hit>
  bool checkPair(const Candidate& candidate, const double* const* Q, int count, double margin, bool* was_hit,
                 const Hit& hit);
  void placePiece(double from, double to);
  Moment sampleAt(int sample) const;
  Moment between(const Moment& a, const Moment& b, int depth);
  Moment momentAt(double time, int depth);
  const double* jointsAt(double time);

  Normal& normalOf(const Candidate& candidate);
  RigidTransform linkAt(int link, const Moment& at) const;
  RigidTransform poseAt(int body, const Moment& at);
  double gap(const Candidate& candidate, Normal& normal, const Moment& at);
  const Lane& gapsIn(SampleGaps& known, const Candidate& candidate, Normal& normal);
  double measure(const Candidate& candidate, Normal& normal, const Moment& at);
  double measureUpTo(double most, const Candidate& candidate, Normal& normal, const Moment& at);
  bool usesSeparation(const Candidate& candidate, double margin) const;
  CellVerdict separateCells(const Candidate& candidate, const Moment& a, const Moment& b, double margin,
                            const DisplacementBound::Rates& rates);
  void boundCells(Candidate& candidate);
  enum class Verdict { apart, near, unknown };
  Verdict separate(const Candidate& candidate, Normal& normal, const Moment& at, double margin);
  bool isNear(const Candidate& candidate, Normal& normal, const Moment& at, double margin);
  bool hit(const Candidate& candidate, double time, const double* q,
           double distance = std::numeric_limits<double>::quiet_NaN());

  bool samplesKeep(double margin);
  bool pieceKeeps(double margin);
  bool pairKeeps(const Candidate& candidate, double margin, double width);
  bool keeps(const Candidate& candidate, Normal& normal, const DisplacementBound::Rates& rates, double margin,
             const Moment& a, const Moment& b, int depth);
  double distanceBelow(double most, const Candidate& candidate, Normal& normal, const Moment& at);
  void addApproaches(const Candidate& candidate, double most, std::vector<MotionContact>& found);
  void lower(const Candidate& candidate, Normal& normal, const DisplacementBound::Rates& rates, const Moment& a,
             const Moment& b, int depth, double& least);

  State scene_;
  LinkBodies bodies_;
  PlacedSamples samples_;
  DisplacementBound bounds_;
  std::vector<DisplacementBound::Rates> group_rates_;  ///< of the centers of moving groups, for this edge
  struct BodyRates {
    int stamp = 0;  ///< of the check
    DisplacementBound::Rates rates;
  };
  std::vector<BodyRates> body_rates_;  ///< in the world, computed on demand
  double tolerance_;
  std::vector<Candidate> candidates_;
  std::vector<Normal> normals_;  ///< per listed pair
  Normal scratch_normal_;        ///< for a pair that is not listed
  std::vector<LinkBodies::Pair> near_fixed_;
  std::vector<std::unique_ptr<State>> middles_;  ///< per depth, constructed on first use
  std::vector<double> piece_times_;
  VectorXd from_, to_, q_;
  std::optional<MotionContact> last_hit_;
  VectorXd hit_q_;
  int stamp_ = 1, suspect_ = -1;
};

}  // namespace kinegraph::inline collision_internal
