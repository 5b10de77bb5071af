#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/common/random.h"
#include "kinegraph/scene/config.h"

namespace kinegraph::inline kinematics_internal {
class State;
}

namespace kinegraph::inline planning_internal {
class JointSpace;
class Steering;
}

namespace kinegraph {

/// The answer of Roadmap::findPath.
struct RoadmapPath {
  MatrixXd path;         ///< (K, n), continuously collision-free; no rows if there is none
  std::string message;   ///< "" if there is a path, else why not
  long evaluations = 0;  ///< evaluations of Steering; 0 if the results of all edges were known

  bool feasible() const { return path.rows() > 0; }
};

/// A graph of configurations and edges that is kept from query to query (lazy PRM).
///
///     Roadmap map(C, .01);
///     map.grow(500);
///     MatrixXd path = map.findPath(q0, q1).path;
///
/// An edge is checked continuously when a query first uses it, and the result is kept. Queries return shortest paths of
/// the graph, shortened by shortcuts. Starts and goals stay in the graph. After obstacles have moved, `setScene` drops
/// the results of the checks and keeps the configurations. Equal calls give equal bits. Source: Bohlin, Kavraki, Path
/// planning using lazy PRM, 2000.
class Roadmap {
 public:
  /// Keeps all collidable pairs `margin` (m) apart. Throws ValueError for joints without limits and a negative margin.
  explicit Roadmap(const Config& config, double margin = 0., std::uint64_t seed = 0);
  ~Roadmap();
  Roadmap(Roadmap&&) noexcept;
  Roadmap& operator=(Roadmap&&) noexcept;

  /// Adds so many collision-free random configurations, each with edges to the nearest ones. Throws ValueError for a
  /// negative number.
  void grow(int configurations, const CancellationToken& cancellation = {});

  /// Finds a path between two joint vectors. Throws ValueError for a wrong length.
  RoadmapPath findPath(const VectorXd& start, const VectorXd& goal, const CancellationToken& cancellation = {});

  /// Replaces the scene by another one with the same joints; else throws ValueError.
  void setScene(const Config& config);

  /// Writes configurations, results of checks, and the state of the random numbers. Throws FileError.
  void save(const std::string& path) const;
  void save(std::ostream& out) const;

  /// Replaces the graph by a saved one. Keeps its results of checks only if the scene is the same as when it was saved.
  /// Throws FileError for a missing or damaged file, ValueError for a graph of other joints.
  void load(const std::string& path);

  /// Loads from a seekable stream; messages call it `name`.
  void load(std::istream& in, const std::string& name);

  /// Returns a copy of a scene with the traces of frames as lines: "roadmap" (blue) are all edges that are not known to
  /// be in collision. Frames and errors as in MotionPlan::picture.
  Config picture(const Config& config, const std::vector<std::string>& frames = {}) const;

  int size() const { return int(nodes_.size()); }
  int edges() const { return int(edges_.size()); }
  MatrixXd configurations() const;                    ///< (N, n)
  std::vector<std::pair<int, int>> edgeEnds() const;  ///< indices of configurations
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
