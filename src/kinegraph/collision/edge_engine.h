#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "kinegraph/collision/displacement_bound.h"
#include "kinegraph/collision/motion_check.h"
#include "kinegraph/collision/placed_samples.h"
#include "kinegraph/geometry/distance/separation.h"

namespace kinegraph {

/// How EdgeChecker finds its answers.
///
/// Eight configurations are placed side by side. Spheres around the links drop most pairs for all of them at once,
/// boxes most of the others in most of them. Of two convex bodies that are left, a direction n (fixed in the last link
/// that both hang on) along which they are apart by d at q(s) and by d' at q(s + w) keeps them apart by
///
///     min(d, d') - w^2 / 8 max |d^2p / ds^2|
///
/// in between, because a twice differentiable function is above its chord by no more than that. n is the normal where
/// they are nearest at one of the ends; it is tried for all that follows before another one is computed. Other bodies
/// have (d + d' - w max |dp / ds|) / 2. Where this is not enough, the interval is halved. Distances are computed only
/// where it does not show sooner that a pair is apart, or that it is not (see separation.h).
class EdgeEngine {
 public:
  using Lane = PlacedSamples::Lane;
  static constexpr int kLanes = PlacedSamples::kMost;
  static constexpr double kFar = std::numeric_limits<double>::infinity();

  EdgeEngine(const State& scene, double tolerance);

  void setTolerance(double tolerance) { tolerance_ = tolerance; }

  /// Per configuration (at most kLanes, a row of `Q` each): are all pairs at least `margin` apart?
  void areFree(const double* const* Q, int count, double margin, bool* free);

  /// Are all of them free? Ends at the first pair that is found too near.
  bool areAllFree(const double* const* Q, int count, double margin);

  bool isFree(const double* from, const double* to, double margin);

  void forget() { suspect_ = -1; }

  double clearance(const double* q, double most);
  double clearance(const double* from, const double* to, double most);

  void findApproaches(const double* from, const double* to, double most, std::vector<MotionContact>& found);

  /// What the last question was answered no for, without its distance (NaN), or with it.
  const std::optional<MotionContact>& lastHit() const { return last_hit_; }
  const std::optional<MotionContact>& measuredHit();

 private:
  struct Candidate {
    LinkBodies::Pair pair;
    int index;  ///< of the pair, -1 if it is not listed
    Lane bounds;
    double least;      ///< of the bounds
    int touching = 0;  ///< the sample in which it is nearest, as far as inner balls show
  };
  /// A direction, and where the supports of both bodies were found along it.
  struct Normal {
    int stamp = 0;  ///< of the question that it was computed for
    Vector3d n;     ///< in the ancestor, unit, from b to a
    SupportCorners corners;
  };
  /// How far a pair is apart in all samples, along the direction that it had when it was asked.
  struct SampleGaps {
    Vector3d n;
    Lane gaps;
    bool known = false;
  };
  /// A time of the motion: a sample, or a State of its own.
  struct Moment {
    double time;
    const State* state;  ///< null: a sample
    int sample;
  };

  void ask() {  // directions of questions before are forgotten
    ++stamp_;
    last_hit_.reset();
  }
  int setMotion(const double* from, const double* to);
  DisplacementBound::Rates ratesOf(const Candidate& candidate);
  const DisplacementBound::Rates& ratesInWorld(int body);
  template <class Hit>
  void forHits(const double* const* Q, int count, double margin, bool all, const Hit& hit);
  const Candidate* findCandidates(double margin, double most = kFar, double near = -kFar);
  bool addPair(const LinkBodies::Pair& pair, int index, double most, double near);
  bool addNearFixed(double margin, double most, double near);
  template <class Hit>
  bool lookAt(const Candidate& candidate, const double* const* Q, int count, double margin, bool* was_hit,
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
  enum class Verdict { apart, near, unknown };
  Verdict judge(const Candidate& candidate, Normal& normal, const Moment& at, double margin);
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
  std::vector<DisplacementBound::Rates> group_rates_;  ///< of the centers of groups that move, of this motion
  struct BodyRates {
    int stamp = 0;  ///< of the question
    DisplacementBound::Rates rates;
  };
  std::vector<BodyRates> body_rates_;  ///< in the world, of those that were asked for
  double tolerance_;
  std::vector<Candidate> candidates_;
  std::vector<Normal> normals_;  ///< per listed pair
  Normal scratch_normal_;        ///< of a pair that is not listed
  std::vector<LinkBodies::Pair> near_fixed_;
  std::vector<std::unique_ptr<State>> middles_;  ///< per depth, made when first needed
  std::vector<double> piece_times_;
  VectorXd from_, to_, q_;
  std::optional<MotionContact> last_hit_;
  VectorXd hit_q_;
  int stamp_ = 1, suspect_ = -1;
};

}  // namespace kinegraph
