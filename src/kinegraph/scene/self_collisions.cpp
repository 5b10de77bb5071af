#include "kinegraph/scene/collisions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "kinegraph/collision/near_pairs.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/parallel.h"
#include "kinegraph/common/random.h"
#include "kinegraph/common/text.h"
#include "kinegraph/kinematics/chains.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

namespace {

using Reason = SelfCollisionPair::Reason;

constexpr int kBatch = 64;  // configurations that a thread samples at a time, from their own seed

/// Sampling interval of each dof. `unbounded` marks dofs without limits that no interval can represent.
struct Ranges {
  VectorXd lower, upper;
  std::vector<char> unbounded;
};

Ranges rangesOf(const KinematicModel& model, const VectorXd& q) {
  Ranges ranges{model.lower, model.upper, std::vector<char>(std::size_t(model.dofs), 0)};
  std::vector<char> turns(std::size_t(model.dofs), 0);
  for (const KinematicModel::Link& link : model.links) {
    int dof = link.dof;
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
      turns[std::size_t(dof)] = model.steps[std::size_t(s)].rotates();
      dof += model.steps[std::size_t(s)].dofs();
    }
  }
  for (int dof = 0; dof < model.dofs; ++dof) {
    if (std::isfinite(ranges.lower[dof]) && std::isfinite(ranges.upper[dof])) continue;
    const double reach = turns[std::size_t(dof)] ? std::numbers::pi : 1.;  // rad, or m around the current value
    if (!std::isfinite(ranges.lower[dof])) ranges.lower[dof] = std::min(q[dof], ranges.upper[dof]) - reach;
    if (!std::isfinite(ranges.upper[dof])) ranges.upper[dof] = std::max(q[dof], ranges.lower[dof]) + reach;
    ranges.unbounded[std::size_t(dof)] = !turns[std::size_t(dof)];
  }
  for (const KinematicModel::DofRange& norm : model.unit_norms) {  // a uniformly sampled direction needs no limits
    for (int dof = norm.first; dof < norm.first + norm.count; ++dof) ranges.unbounded[std::size_t(dof)] = 0;
  }
  return ranges;
}

void sampleConfiguration(Rng& rng, const KinematicModel& model, const Ranges& ranges, VectorXd& q) {
  for (int dof = 0; dof < model.dofs; ++dof) q[dof] = rng.uniform(ranges.lower[dof], ranges.upper[dof]);
  for (const KinematicModel::DofRange& norm : model.unit_norms) {
    for (int dof = norm.first; dof < norm.first + norm.count; ++dof) q[dof] = rng.normal();
    q.segment(norm.first, norm.count).normalize();
  }
}

bool hangsOn(const FrameData* frame, const FrameData& root) {
  while (frame && frame != &root) frame = frame->parent;
  return frame == &root;
}

/// Pairs of frames that carry shapes, and the pairs of shapes of each.
class FramePairs {
 public:
  FramePairs(const Config& config, const std::string& root) {
    const KinematicModel& model = *config.model();
    const FrameData* first = root.empty() ? nullptr : config.scene()->frames()[config.getFrame(root).id()].get();
    std::map<int, int> owner_of;
    for (const ContactRules::Body& body : model.contacts.bodies) owner_of[body.frame] = body.owner;
    std::map<std::pair<int, int>, int> numbers;
    const auto counts = [&](int frame) {
      return first ? hangsOn(config.scene()->frames()[std::size_t(frame)].get(), *first)
                   : model.frame_link[std::size_t(frame)] != 0;
    };
    for (const auto& [a, b] : model.movingPairs()) {
      if (!counts(a) || !counts(b)) continue;
      shapes.emplace_back(a, b);
      const std::pair<int, int> owners = std::minmax(owner_of.at(a), owner_of.at(b));
      const auto found = numbers.try_emplace(owners, int(frames.size())).first;
      if (found->second == int(frames.size())) frames.push_back(owners);
      group.push_back(found->second);
    }
  }

  std::vector<std::pair<int, int>> frames, shapes;
  std::vector<int> group;  ///< per pair of shapes: index of its pair of frames
};

bool adjacent(const KinematicModel& model, int a, int b) {
  const int link_a = model.frame_link[std::size_t(a)], link_b = model.frame_link[std::size_t(b)];
  return model.links[std::size_t(link_a)].parent == link_b || model.links[std::size_t(link_b)].parent == link_a;
}

/// Counts, per pair of frames, the sampled configurations in collision.
std::vector<int> countCollisions(const Config& config, const FramePairs& pairs, const Ranges& ranges,
                                 const SelfCollisionOptions& options) {
  const auto model = config.model();
  const BodyPairs bodies(*model, pairs.shapes);
  struct Worker {
    State state;
    PlacedBodies placed;
    VectorXd q;
    std::vector<int> counts, last;
  };
  std::vector<std::optional<Worker>> workers(std::size_t(options.threads));
  parallelFor(options.samples, kBatch, options.threads, [&](int number, int from, int to) {
    std::optional<Worker>& worker = workers[std::size_t(number)];
    if (!worker) {
      worker.emplace(Worker{State(model, config.parameters()), PlacedBodies(bodies), VectorXd(model->dofs),
                            std::vector<int>(pairs.frames.size(), 0), std::vector<int>(pairs.frames.size(), -1)});
    }
    Rng rng(options.seed + std::uint64_t(from) * 0x9E3779B97F4A7C15u);
    for (int sample = from; sample < to; ++sample) {
      sampleConfiguration(rng, *model, ranges, worker->q);
      worker->state.setJoints(worker->q.data());
      worker->placed.place(worker->state);
      worker->placed.forMaybeNear(options.margin, [&](int pair) {
        const std::size_t group = std::size_t(pairs.group[std::size_t(pair)]);
        if (worker->last[group] == sample || worker->placed.proximity(pair).distance >= options.margin) return;
        worker->last[group] = sample;
        ++worker->counts[group];
      });
    }
  });
  std::vector<int> counts(pairs.frames.size(), 0);
  for (const std::optional<Worker>& worker : workers) {
    for (std::size_t i = 0; worker && i < counts.size(); ++i) counts[i] += worker->counts[i];
  }
  return counts;
}

}  // namespace

void SelfCollisionOptions::validate() const {
  const auto require = [](bool good, const char* what, double value, const char* expected) {
    if (!good) throw ValueError(cat("selfCollisionMatrix: ", what, " is ", value, "; expected ", expected));
  };
  require(samples >= 1, "samples", samples, "at least 1");
  require(std::isfinite(margin), "margin", margin, "a length in m");
  require(always > 0. && always <= 1., "always", always, "a fraction in (0, 1]");
  require(threads >= 1, "threads", threads, "at least 1");
}

const char* selfCollisionReasonName(Reason reason) {
  switch (reason) {
    case Reason::adjacent:
      return "adjacent";
    case Reason::always:
      return "always";
    case Reason::never:
      return "never";
    case Reason::sometimes:
      return "sometimes";
  }
  return "sometimes";
}

std::string SelfCollisionMatrix::str() const {
  const auto count = [&](Reason reason) { return std::ranges::count(pairs, reason, &SelfCollisionPair::reason); };
  return cat(pairs.size(), " pairs of frames in ", samples, " configurations: ", count(Reason::adjacent), " adjacent, ",
             count(Reason::always), " always in collision, ", count(Reason::never), " never, ",
             count(Reason::sometimes), " sometimes");
}

SelfCollisionMatrix selfCollisionMatrix(const Config& config, const SelfCollisionOptions& options) {
  options.validate();
  const auto model = config.model();
  const FramePairs pairs(config, options.root);
  if (pairs.frames.empty()) {
    throw ValueError(
        cat("selfCollisionMatrix: ", options.root.empty() ? "the scene" : cat("frame '", options.root, "'"),
            " has no collidable pair of shapes that joints move apart; give the shapes `contact`"));
  }
  const Ranges ranges = rangesOf(*model, config.getJointState());
  const std::vector<int> counts = countCollisions(config, pairs, ranges, options);
  SelfCollisionMatrix matrix;
  matrix.samples = options.samples;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const auto [a, b] = pairs.frames[i];
    bool unbounded = false;
    forColumnsBetween(*model, a, b, [&](int column) {
      unbounded = unbounded || ranges.unbounded[std::size_t(model->column_dof[std::size_t(column)])];
    });
    const Reason reason = adjacent(*model, a, b)                                  ? Reason::adjacent
                          : unbounded                                             ? Reason::sometimes
                          : counts[i] == 0                                        ? Reason::never
                          : double(counts[i]) >= options.always * options.samples ? Reason::always
                                                                                  : Reason::sometimes;
    matrix.pairs.push_back({a, b, reason, counts[i]});
  }
  std::ranges::sort(matrix.pairs, [](const SelfCollisionPair& x, const SelfCollisionPair& y) {
    return std::pair(x.a, x.b) < std::pair(y.a, y.b);
  });
  return matrix;
}

void ignoreSelfCollisions(Config& config, const SelfCollisionMatrix& matrix) {
  SceneTree& scene = *config.scene();
  bool any = false;
  for (const SelfCollisionPair& pair : matrix.pairs) {
    if (std::size_t(pair.b) >= scene.frames().size())
      throw ValueError(cat("ignoreSelfCollisions: the matrix belongs to another scene: no frame ", pair.b));
    if (pair.matters()) continue;
    scene.frames()[std::size_t(pair.a)]->no_contact.push_back(scene.frames()[std::size_t(pair.b)].get());
    any = true;
  }
  if (any) scene.structureChanged();
}

}  // namespace kinegraph
