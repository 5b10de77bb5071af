#include "kinegraph/planning/roadmap.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <queue>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/planning/endpoints.h"
#include "kinegraph/planning/search/path_search.h"
#include "kinegraph/planning/smoothing/shortcut.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

namespace {

constexpr std::size_t kNeighbors = 12;
constexpr char kMagic[8] = {'K', 'G', 'R', 'O', 'A', 'D', '0', '2'};
constexpr char kEarlierMagic[8] = {'K', 'G', 'R', 'O', 'A', 'D', '0', '1'};  // without the state of the random numbers

std::unique_ptr<Steering> steeringFor(const State& scene, const JointSpace& space, double margin) {
  return std::make_unique<Steering>(PlanningConstraints{
      .scene = &scene, .space = &space, .clearance = {.margin = margin, .guard = Clearance::kGuard}});
}

/// Adds bytes to a hash (FNV-1a).
void mix(std::uint64_t& code, const void* bytes, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    code = (code ^ static_cast<const unsigned char*>(bytes)[i]) * 0x100000001B3ull;
}

template <class T>
void put(std::ostream& out, const T& value) {
  out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class T>
T take(std::istream& in, const std::string& path) {
  T value;
  if (!in.read(reinterpret_cast<char*>(&value), sizeof value))
    throw FileError(cat(path, ": the roadmap file ends too early"));
  return value;
}

}  // namespace

Roadmap::Roadmap(const Config& config, double margin, std::uint64_t seed)
    : scene_(std::make_shared<const State>(config.state())),
      space_(std::make_shared<const JointSpace>(scene_->model())),
      margin_(margin),
      rng_(seed) {
  if (!(margin >= 0.)) throw ValueError(cat("Roadmap: margin is ", margin, "; expected a number >= 0, in m"));
  space_->requireRanges("Roadmap");
  steering_ = steeringFor(*scene_, *space_, margin_);
}

Roadmap::~Roadmap() = default;
Roadmap::Roadmap(Roadmap&&) noexcept = default;
Roadmap& Roadmap::operator=(Roadmap&&) noexcept = default;

int Roadmap::addNode(const VectorXd& q) {
  const int node = size();
  std::vector<std::pair<double, int>> near;
  for (int i = 0; i < node; ++i) near.emplace_back(space_->distance(nodes_[std::size_t(i)], q), i);
  const std::size_t count = std::min(kNeighbors, near.size());
  std::partial_sort(near.begin(), near.begin() + std::ptrdiff_t(count), near.end());
  nodes_.push_back(q);
  node_known_.push_back(Known::is_free);
  edges_of_.emplace_back();
  for (std::size_t i = 0; i < count; ++i) {
    const int other = near[i].second;
    edges_of_[std::size_t(node)].push_back(edges());
    edges_of_[std::size_t(other)].push_back(edges());
    edges_.push_back({other, node, near[i].first, Known::nothing});
  }
  return node;
}

void Roadmap::grow(int configurations, const CancellationToken& cancellation) {
  if (configurations < 0)
    throw ValueError(cat("Roadmap.grow: configurations is ", configurations, "; expected a number >= 0"));
  const VectorXd like = scene_->q();
  for (long tries = 1000l * configurations; configurations > 0 && tries > 0; --tries) {
    if (tries % 16 == 0 && cancellation && cancellation()) return;
    const VectorXd q = space_->sample(rng_, like);
    if (!steering_->check().isFree(q)) continue;
    addNode(q);
    --configurations;
  }
}

bool Roadmap::nodeIsFree(int node) {
  Known& known = node_known_[std::size_t(node)];
  if (known == Known::nothing)
    known = steering_->check().isFree(nodes_[std::size_t(node)]) ? Known::is_free : Known::is_blocked;
  return known == Known::is_free;
}

bool Roadmap::edgeIsFree(Edge& edge) {
  if (edge.known == Known::nothing) {
    const VectorXd &a = nodes_[std::size_t(edge.a)], &b = nodes_[std::size_t(edge.b)];
    const bool is_free = nodeIsFree(edge.a) && nodeIsFree(edge.b) && steering_->isFree(a, b);
    edge.known = is_free ? Known::is_free : Known::is_blocked;
  }
  return edge.known == Known::is_free;
}

/// Finds the shortest path over edges that are not known to be in collision, by A*. Empty if there is none.
std::vector<int> Roadmap::shortestPath(int from, int to) const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::vector<double> cost(nodes_.size(), kFar);
  std::vector<int> by(nodes_.size(), -1);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto left = [&](int node) { return space_->distance(nodes_[std::size_t(node)], nodes_[std::size_t(to)]); };
  cost[std::size_t(from)] = 0.;
  open.push({left(from), from});
  while (!open.empty()) {
    const auto [bound, node] = open.top();
    open.pop();
    if (node == to) break;
    if (bound > cost[std::size_t(node)] + left(node) + 1e-12) continue;
    for (const int e : edges_of_[std::size_t(node)]) {
      const Edge& edge = edges_[std::size_t(e)];
      if (edge.known == Known::is_blocked) continue;
      const int next = edge.a == node ? edge.b : edge.a;
      const double there = cost[std::size_t(node)] + edge.length;
      if (there >= cost[std::size_t(next)]) continue;
      cost[std::size_t(next)] = there;
      by[std::size_t(next)] = e;
      open.push({there + left(next), next});
    }
  }
  std::vector<int> path;
  for (int node = to; node != from;) {
    if (by[std::size_t(node)] < 0) return {};
    const Edge& edge = edges_[std::size_t(by[std::size_t(node)])];
    path.push_back(by[std::size_t(node)]);
    node = edge.a == node ? edge.b : edge.a;
  }
  std::reverse(path.begin(), path.end());
  return path;
}

/// Checks the edges of the shortest path, and replans when one of them is in collision.
std::vector<int> Roadmap::freePath(int from, int to, const CancellationToken& cancellation) {
  while (!(cancellation && cancellation())) {
    const std::vector<int> path = shortestPath(from, to);
    if (std::ranges::all_of(path, [&](int e) { return edgeIsFree(edges_[std::size_t(e)]); })) return path;
  }
  return {};
}

RoadmapPath Roadmap::findPath(const VectorXd& start, const VectorXd& goal, const CancellationToken& cancellation) {
  RoadmapPath answer;
  const long before = steering_->evaluations();
  int ends[2];
  for (int i = 0; i < 2; ++i) {
    const Endpoint end =
        checkEndpoint(*steering_, scene_->model(), i ? goal : start, margin_, i ? "goal" : "start", "Roadmap");
    const bool keeps = end.near.empty() || end.near.front().distance >= margin_ + 2. * Clearance::kGuard;
    if (!end.isFree() || !keeps) {
      answer.message = end.isFree() ? cat("the ", i ? "goal" : "start",
                                          " does not keep the margin: ", describePairs(scene_->model(), end.near))
                                    : end.problem;
      return answer;
    }
    VectorXd q = end.q;
    space_->normalize(q);
    const auto known = std::ranges::find(nodes_, q);
    ends[i] = known == nodes_.end() ? addNode(q) : int(known - nodes_.begin());
  }
  const std::vector<int> path = freePath(ends[0], ends[1], cancellation);
  std::vector<VectorXd> points = {nodes_[std::size_t(ends[0])]};
  int node = ends[0];
  for (const int e : path) {
    const Edge& edge = edges_[std::size_t(e)];
    node = edge.a == node ? edge.b : edge.a;
    points.push_back(nodes_[std::size_t(node)]);
  }
  if (node == ends[1]) {
    points.front() = start;
    answer.path = space_->unroll(shortcutPath(*steering_, std::move(points), {.cancellation = cancellation}));
  } else {
    answer.message = cat("no path in a roadmap of ", size(), " configurations and ", edges(), " edges; grow adds more");
  }
  answer.evaluations = steering_->evaluations() - before;
  return answer;
}

void Roadmap::setScene(const Config& config) {
  const auto scene = std::make_shared<const State>(config.state());
  if (dofNames(scene->model()) != dofNames(scene_->model()))
    throw ValueError("Roadmap.setScene: the scene has other joints than the roadmap");
  scene_ = scene;
  space_ = std::make_shared<const JointSpace>(scene_->model());
  steering_ = steeringFor(*scene_, *space_, margin_);
  std::ranges::fill(node_known_, Known::nothing);
  for (Edge& edge : edges_) edge.known = Known::nothing;
}

MatrixXd Roadmap::configurations() const {
  MatrixXd rows(size(), space_->dofs());
  for (int i = 0; i < size(); ++i) rows.row(i) = nodes_[std::size_t(i)].transpose();
  return rows;
}

std::vector<std::pair<int, int>> Roadmap::edgeEnds() const {
  std::vector<std::pair<int, int>> ends;
  for (const Edge& edge : edges_)
    if (edge.known != Known::is_blocked) ends.emplace_back(edge.a, edge.b);
  return ends;
}

/// A hash of the bodies, their poses and the margin.
std::uint64_t Roadmap::sceneCode() const {
  std::uint64_t code = 0xCBF29CE484222325ull;
  const KinematicModel& model = scene_->model();
  for (const auto& [a, b] : model.movingPairs()) {
    for (const int frame : {a, b}) {
      const RigidTransform& X = scene_->parameters().frame_offset[std::size_t(frame)];
      mix(code, X.R.data(), sizeof(double) * 9);
      mix(code, X.p.data(), sizeof(double) * 3);
      const Geometry& shape = *model.geometry[std::size_t(frame)];
      const int type = int(shape.type);
      mix(code, &type, sizeof type);
      mix(code, shape.size.data(), sizeof(double) * shape.size.size());
      const double radius = model.body[std::size_t(frame)]->boundRadius();
      mix(code, &radius, sizeof radius);
    }
  }
  for (const LaneModel::Link& link : scene_->parameters().link) {
    mix(code, link.R, sizeof link.R);
    mix(code, link.p, sizeof link.p);
  }
  mix(code, &margin_, sizeof margin_);
  return code;
}

void Roadmap::save(const std::string& path) const {
  std::ofstream out(path, std::ios::binary);
  save(out);
  out.flush();
  if (!out) throw FileError(cat(path, ": the roadmap could not be written"));
}

void Roadmap::save(std::ostream& out) const {
  out.write(kMagic, sizeof kMagic);
  const std::string joints = join(dofNames(scene_->model()), "\n");
  put(out, std::uint64_t(joints.size()));
  out.write(joints.data(), std::streamsize(joints.size()));
  put(out, sceneCode());
  put(out, std::uint64_t(space_->dofs()));
  put(out, std::uint64_t(nodes_.size()));
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    put(out, node_known_[i]);
    out.write(reinterpret_cast<const char*>(nodes_[i].data()), std::streamsize(sizeof(double)) * nodes_[i].size());
  }
  put(out, std::uint64_t(edges_.size()));
  for (const Edge& edge : edges_) {
    put(out, edge.a);
    put(out, edge.b);
    put(out, edge.length);
    put(out, edge.known);
  }
  put(out, rng_);
}

void Roadmap::load(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw FileError(cat(path, ": no such file"));
  load(in, path);
}

void Roadmap::load(std::istream& in, const std::string& path) {
  const auto begin = in.tellg();
  const auto bytes = std::uint64_t(in.seekg(0, std::ios::end).tellg() - begin);
  in.seekg(begin);
  char magic[sizeof kMagic];
  const bool is_read = bool(in.read(magic, sizeof magic));
  const bool has_rng = is_read && std::memcmp(magic, kMagic, sizeof magic) == 0;
  if (!is_read || (!has_rng && std::memcmp(magic, kEarlierMagic, sizeof magic) != 0))
    throw FileError(cat(path, ": not a roadmap"));
  const auto counted = [&](const char* what) {
    const auto count = take<std::uint64_t>(in, path);
    if (count > bytes) throw FileError(cat(path, ": the roadmap is damaged: ", count, " ", what));
    return std::size_t(count);
  };
  std::string joints(counted("letters"), ' ');
  if (!in.read(joints.data(), std::streamsize(joints.size())))
    throw FileError(cat(path, ": the roadmap file ends too early"));
  if (joints != join(dofNames(scene_->model()), "\n"))
    throw ValueError(cat("Roadmap.load: ", path, " is a roadmap of other joints: ", joints));
  const bool same_scene = take<std::uint64_t>(in, path) == sceneCode();
  if (counted("dofs") != std::size_t(space_->dofs())) throw FileError(cat(path, ": the roadmap is damaged: dofs"));
  std::vector<VectorXd> nodes(counted("configurations"), VectorXd(space_->dofs()));
  std::vector<Known> known;
  for (VectorXd& node : nodes) {
    known.push_back(take<unsigned char>(in, path) == 1 && same_scene ? Known::is_free : Known::nothing);
    for (double& value : node) value = take<double>(in, path);
    if (!node.allFinite()) throw FileError(cat(path, ": the roadmap is damaged: numbers that are not finite"));
  }
  std::vector<Edge> edges(counted("motions"));
  std::vector<std::vector<int>> edges_of(nodes.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    Edge& edge = edges[e];
    edge.a = take<int>(in, path);
    edge.b = take<int>(in, path);
    edge.length = take<double>(in, path);
    if (!(edge.length >= 0.)) throw FileError(cat(path, ": the roadmap is damaged: a length of ", edge.length));
    const auto state = take<unsigned char>(in, path);
    edge.known = same_scene && state <= 2 ? Known(state) : Known::nothing;
    for (const int node : {edge.a, edge.b}) {
      if (node < 0 || node >= int(nodes.size()))
        throw FileError(cat(path, ": the roadmap is damaged: configuration ", node));
      edges_of[std::size_t(node)].push_back(int(e));
    }
  }
  const Rng rng = has_rng ? take<Rng>(in, path) : rng_;
  nodes_ = std::move(nodes);
  rng_ = rng;
  node_known_ = std::move(known);
  edges_ = std::move(edges);
  edges_of_ = std::move(edges_of);
}

}  // namespace kinegraph
