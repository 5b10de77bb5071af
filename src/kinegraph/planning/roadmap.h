#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/endpoints.h"
#include "kinegraph/planning/search/path_search.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

/// What a Roadmap answers.
struct RoadmapPath {
  MatrixXd path;        ///< (K, n), free at all times; no rows if there is none
  std::string message;  ///< "" if there is one, else why not
  long checked = 0;     ///< evaluations of Steering that it took; none where all was known

  bool feasible() const { return path.rows() > 0; }
};

/// Postures and motions between them that are kept from query to query.
///
///     Roadmap map(C, .01);
///     map.grow(500);
///     MatrixXd path = map.findPath(q0, q1).path;
///
/// Motions are looked at when a query first wants to use them, at all times of them, and it is remembered what came out.
/// Paths are shortest ones in the map, then shortened. Starts and goals stay in the map as postures. After obstacles have
/// moved, `setScene` forgets what was found free or not, and keeps the postures. The same calls give the same bits.
/// Source: Bohlin, Kavraki, Path planning using lazy PRM, 2000.
class Roadmap {
 public:
  /// All collidable pairs keep `margin` (m) apart. Throws ValueError for joints without limits, and a negative margin.
  explicit Roadmap(const Config& config, double margin = 0., std::uint64_t seed = 0);

  /// Adds that many free random postures, each with motions to the nearest ones. Throws ValueError for less than 0.
  void grow(int configurations, const CancellationToken& cancellation = {});

  /// Throws ValueError for joint vectors of a wrong length.
  RoadmapPath findPath(const VectorXd& start, const VectorXd& goal, const CancellationToken& cancellation = {});

  /// The scene is another one now, with the same joints; else ValueError.
  void setScene(const Config& config);

  /// Writes postures, what is known of motions, and how it draws on. Throws FileError.
  void save(const std::string& path) const;
  void save(std::ostream& out) const;

  /// Reads them in place of its own. Throws FileError for a file that is not there or damaged, ValueError for a map of
  /// other joints. What is known of motions is taken over only if the scene is the same as when it was saved.
  void load(const std::string& path);

  /// The same from a stream that can be sought in; `name` is for messages.
  void load(std::istream& in, const std::string& name);

  /// A copy of a scene with these joints, and lines in it along which frames go: "roadmap" (blue) are all motions that are not
  /// known to be blocked. Frames and errors as in MotionPlan::picture.
  Config picture(const Config& config, const std::vector<std::string>& frames = {}) const;

  int size() const { return int(nodes_.size()); }
  int motions() const { return int(edges_.size()); }
  MatrixXd configurations() const;                      ///< (N, n)
  std::vector<std::pair<int, int>> motionEnds() const;  ///< places of postures
  double margin() const { return margin_; }

 private:
  enum class Known : unsigned char { nothing, is_free, is_blocked };
  struct Edge {
    int a, b;
    double length;
    Known known;
  };

  int addNode(const VectorXd& q);
  bool nodeIsFree(int node);
  bool edgeIsFree(Edge& edge);
  std::vector<int> shortestPath(int from, int to) const;
  std::vector<int> freePath(int from, int to, const CancellationToken& cancellation);
  std::uint64_t sceneCode() const;

  std::shared_ptr<const State> scene_;
  std::shared_ptr<const JointSpace> space_;
  double margin_;
  Rng rng_;
  std::unique_ptr<Steering> steering_;
  std::vector<VectorXd> nodes_;
  std::vector<Known> node_known_;
  std::vector<std::vector<int>> edges_of_;  ///< per node
  std::vector<Edge> edges_;
};

}  // namespace kinegraph
