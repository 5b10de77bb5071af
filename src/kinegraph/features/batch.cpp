#include "kinegraph/features/eval.h"

#include <algorithm>

#include "kinegraph/collision/edge_check.h"
#include "kinegraph/collision/edge_checkers.h"
#include "kinegraph/collision/near_pairs.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/parallel.h"
#include "kinegraph/common/text.h"
#include "kinegraph/features/residual.h"
#include "kinegraph/kinematics/lane_kinematics.h"

namespace kinegraph {

namespace {

constexpr int kBatch = 32;           ///< configurations that a thread takes at once
constexpr double kTolerance = 1e-5;  ///< m; irrelevant for checks of single configurations

void checkJoints(const State& scene, const Eigen::Ref<const RowMatrix>& Q) {
  if (Q.cols() != scene.dofs()) {
    throw ValueError(cat("joint vectors: got ", Q.rows(), " x ", Q.cols(), " numbers; the configuration has ",
                         scene.dofs(), " dofs"));
  }
  if (Q.outerStride() == Q.cols()) {
    const Eigen::Map<const VectorXd> all(Q.data(), Q.size());
    if ((all - all).squaredNorm() == 0.) return;  // faster than allFinite()
  } else if (Q.allFinite()) {
    return;
  }
  Eigen::Index row = 0;
  while (Q.row(row).allFinite()) ++row;
  throw ValueError(cat("joint vectors: row ", row, " has numbers that are not finite"));
}

/// Calls one(worker, i) for each configuration, with a copy of `first` as worker for each thread.
template <class Worker, class One>
void forEach(const Worker& first, int count, const BatchOptions& options, const One& one) {
  const int threads = std::clamp(options.threads, 1, std::max(1, (count + kBatch - 1) / kBatch));
  std::vector<Worker> workers(std::size_t(threads), first);
  const auto part = [&](int worker, int from, int to) {
    for (int i = from; i < to; ++i) one(workers[worker], i);
  };
  parallelFor(count, kBatch, threads, part, options.cancellation);
}

/// Runs the kernels on batches of configurations, and calls finish(worker, first, count) after each batch.
template <class Batch, class Finish>
void forLanes(const LaneKinematics& model, int count, const BatchOptions& options, const Batch& batch,
              const Finish& finish) {
  const int threads = std::clamp(options.threads, 1, std::max(1, (count + kBatch - 1) / kBatch));
  std::vector<LaneKinematics::Scratch> scratch;
  scratch.reserve(threads);
  for (int i = 0; i < threads; ++i) scratch.emplace_back(model, options.lanes);
  const auto part = [&](int worker, int from, int to) {
    model.run(scratch[worker], batch(worker, from, to - from));
    finish(worker, from, to - from);
  };
  parallelFor(count, kBatch, threads, part, options.cancellation);
}

/// evalBatch for features that consist of rows with kernels in lanes.
void evalInLanes(const State& scene, const Residual& residual, const LaneRowList& list,
                 const Eigen::Ref<const RowMatrix>& Q, Eigen::Ref<RowMatrix> y, JacobianRows* J,
                 const BatchOptions& options) {
  const LaneKinematics model(scene.model(), scene.parameters(), list);
  const int rows = residual.rows(), raw_rows = list.rows(), n = scene.dofs();
  const bool plain = residual.scale().size() == 0 && residual.target().size() == 0, mixes = residual.mixesRows();
  RowMatrix raw_y, raw_J;  // of the present batch of each thread
  if (mixes) {
    raw_y.resize(Eigen::Index(kBatch) * options.threads, raw_rows);
    raw_J.resize(J ? Eigen::Index(kBatch) * options.threads * raw_rows : 0, n);
  }
  const auto batch = [&](int worker, int from, int count) {
    LaneBatch part{Q.data() + from * Q.outerStride(),
                   Q.outerStride(),
                   count,
                   y.data() + from * y.outerStride(),
                   y.outerStride(),
                   nullptr,
                   0,
                   n};
    if (J) part.J = J->data() + Eigen::Index(from) * rows * J->outerStride();
    if (J) part.row_stride = J->outerStride();
    if (mixes) {
      part.y = raw_y.data() + Eigen::Index(worker) * kBatch * raw_rows;
      part.y_stride = raw_rows;
      if (J) part.J = raw_J.data() + Eigen::Index(worker) * kBatch * raw_rows * n;
      part.row_stride = n;
    }
    part.J_stride = part.row_stride * raw_rows;
    return part;
  };
  const auto finish = [&](int worker, int from, int count) {
    for (int i = 0; i < count && !plain; ++i) {
      Eigen::Map<VectorXd> value(y.row(from + i).data(), rows);
      const Eigen::Index first = Eigen::Index(from + i) * rows, raw = Eigen::Index(worker) * kBatch + i;
      if (!mixes && J) {
        JacobianRows own = J->middleRows(first, rows);
        residual.finish(value, &own);
      } else if (!mixes) {
        residual.finish(value, nullptr);
      } else if (J) {
        JacobianRows own = J->middleRows(first, rows), from_lanes = raw_J.middleRows(raw * raw_rows, raw_rows);
        own.setZero();
        residual.mix(raw_y.row(raw).transpose(), &from_lanes, value, &own);
      } else {
        residual.mix(raw_y.row(raw).transpose(), nullptr, value, nullptr);
      }
    }
  };
  forLanes(model, int(Q.rows()), options, batch, finish);
}

}  // namespace

void evalBatch(const State& scene, const Residual& residual, const Eigen::Ref<const RowMatrix>& Q,
               Eigen::Ref<RowMatrix> y, JacobianRows* J, const BatchOptions& options) {
  checkJoints(scene, Q);
  if (residual.order() > 0) {
    throw ValueError(cat(residual.name(), " of order ", residual.order(), " needs ", residual.order() + 1,
                         " consecutive configurations; a batch takes one at a time"));
  }
  LaneRowList list;
  if (residual.feature().addLaneRows(list)) return evalInLanes(scene, residual, list, Q, y, J, options);
  const int rows = residual.rows();
  struct Worker {
    State state;
    Residual residual;
  };
  forEach(Worker{scene, residual}, int(Q.rows()), options, [&](Worker& worker, int i) {
    worker.state.setJoints(Q.row(i).data());
    const State* state = &worker.state;
    Eigen::Map<VectorXd> value(y.row(i).data(), rows);
    if (J) {
      JacobianRows own = J->middleRows(Eigen::Index(i) * rows, rows);
      own.setZero();
      worker.residual.eval({&state, 1}, 1., value, &own);
    } else {
      worker.residual.eval({&state, 1}, 1., value, nullptr);
    }
  });
}

void framePoses(const State& scene, const std::vector<int>& frames, const Eigen::Ref<const RowMatrix>& Q,
                Eigen::Ref<RowMatrix> poses, const BatchOptions& options) {
  checkJoints(scene, Q);
  LaneRowList list;
  for (int frame : frames) list.addPose(frame);
  const LaneKinematics model(scene.model(), scene.parameters(), list);
  const auto batch = [&](int, int from, int count) {
    return LaneBatch{Q.data() + from * Q.outerStride(),
                     Q.outerStride(),
                     count,
                     poses.data() + from * poses.outerStride(),
                     poses.outerStride(),
                     nullptr,
                     0,
                     0};
  };
  forLanes(model, int(Q.rows()), options, batch, [](int, int, int) {});
}

void frameJacobians(const State& scene, const std::vector<int>& frames, const Eigen::Ref<const RowMatrix>& Q,
                    JacobianRows J, const BatchOptions& options) {
  checkJoints(scene, Q);
  LaneRowList list;
  for (int frame : frames) list.addTwist(frame);
  const LaneKinematics model(scene.model(), scene.parameters(), list);
  const Eigen::Index stride = J.outerStride() * 6 * Eigen::Index(frames.size());
  const auto batch = [&](int, int from, int count) {
    return LaneBatch{Q.data() + from * Q.outerStride(), Q.outerStride(), count,          nullptr, 0,
                     J.data() + from * stride,          stride,          J.outerStride()};
  };
  forLanes(model, int(Q.rows()), options, batch, [](int, int, int) {});
}

void pairDistances(const State& scene, const Eigen::Ref<const RowMatrix>& Q, Eigen::Ref<RowMatrix> distances,
                   const BatchOptions& options) {
  checkJoints(scene, Q);
  forEach(std::pair(scene, PairDistances(scene.sharedModel())), int(Q.rows()), options, [&](auto& worker, int i) {
    auto& [state, pairs] = worker;
    state.setJoints(Q.row(i).data());
    pairs.forAll(state, [&](int pair, const Proximity& near) { distances(i, pair) = near.distance; });
  });
}

void NearestPointArrays::write(int pair, const Proximity& near) const {
  distances[pair] = near.distance;
  Eigen::Map<Vector3d>(points + 6 * pair) = near.point_a;
  Eigen::Map<Vector3d>(points + 6 * pair + 3) = near.point_b;
  Eigen::Map<Vector3d>(normals + 3 * pair) = near.normal;
}

void nearestPoints(const State& scene, const Eigen::Ref<const RowMatrix>& Q, const NearestPointArrays& first,
                   const BatchOptions& options) {
  checkJoints(scene, Q);
  const std::size_t count = scene.model().collidable().size();
  forEach(std::pair(scene, PairDistances(scene.sharedModel())), int(Q.rows()), options, [&](auto& worker, int i) {
    auto& [state, pairs] = worker;
    const std::size_t before = std::size_t(i) * count;
    const NearestPointArrays arrays{first.distances + before, first.points + 6 * before, first.normals + 3 * before};
    state.setJoints(Q.row(i).data());
    pairs.forAll(state, [&](int pair, const Proximity& near) { arrays.write(pair, near); });
  });
}

namespace {

/// One checker per thread, borrowed from the caller's checkers.
class ThreadCheckers {
 public:
  ThreadCheckers(const State& scene, double margin, double tolerance, int count, const BatchOptions& options)
      : pool_(options.checkers ? options.checkers : &own_) {
    const int threads = std::clamp(options.threads, 1, std::max(1, (count + kBatch - 1) / kBatch));
    while (int(checkers_.size()) < threads) checkers_.push_back(pool_->take(scene, margin, tolerance));
  }
  ThreadCheckers(const ThreadCheckers&) = delete;
  ~ThreadCheckers() {
    for (auto& checker : checkers_) pool_->giveBack(std::move(checker));
  }

  int size() const { return int(checkers_.size()); }
  EdgeChecker& of(int worker) { return *checkers_[std::size_t(worker)]; }

 private:
  EdgeCheckers own_;
  EdgeCheckers* pool_;
  std::vector<std::unique_ptr<EdgeChecker>> checkers_;
};

/// Checks configurations within the limits side by side. `limit(i)` returns whether row i is within the limits.
template <class Limit>
void areFreeInLanes(const State& scene, const Eigen::Ref<const RowMatrix>& Q, double margin, std::span<bool> valid,
                    const BatchOptions& options, const Limit& limit) {
  ThreadCheckers checkers(scene, margin, kTolerance, int(Q.rows()), options);
  const auto part = [&](int worker, int from, int to) {
    const double* rows[EdgeChecker::kLanes];
    int places[EdgeChecker::kLanes], count = 0;
    bool free[EdgeChecker::kLanes];
    for (int i = from; i < to; ++i) {
      if (limit(i)) {
        places[count] = i;
        rows[count++] = Q.row(i).data();
      }
      if (count == 0 || (count < EdgeChecker::kLanes && i + 1 < to)) continue;
      checkers.of(worker).areFree({rows, std::size_t(count)}, free);
      for (int k = 0; k < count; ++k) valid[places[k]] = free[k];
      count = 0;
    }
  };
  parallelFor(int(Q.rows()), kBatch, checkers.size(), part, options.cancellation);
}

}  // namespace

void areValid(const State& scene, const Eigen::Ref<const RowMatrix>& Q, double margin, std::span<bool> valid,
              const BatchOptions& options) {
  checkJoints(scene, Q);
  const auto limit = [&](int i) { return valid[i] = withinLimits(scene.model(), Q.row(i).data()); };
  if (scene.model().contacts.bodies.size() <= NearPairs::kFew)
    return areFreeInLanes(scene, Q, margin, valid, options, limit);
  struct Worker {
    State state;
    NearPairs pairs;
  };
  forEach(Worker{scene, NearPairs(scene.sharedModel())}, int(Q.rows()), options, [&](Worker& worker, int i) {
    if (!limit(i)) return;
    worker.state.setJoints(Q.row(i).data());
    worker.pairs.place(worker.state);
    valid[i] = worker.pairs.apart(margin);
  });
}

void areMotionsFree(const State& scene, const Eigen::Ref<const RowMatrix>& from, const Eigen::Ref<const RowMatrix>& to,
                    double margin, double tolerance, std::span<bool> free, const BatchOptions& options) {
  checkJoints(scene, from);
  checkJoints(scene, to);
  if (from.rows() != to.rows())
    throw ValueError(cat("motions: got ", from.rows(), " starts and ", to.rows(), " ends; expected equal numbers"));
  if (!(tolerance > 0.)) throw ValueError(cat("motions: tolerance is ", tolerance, "; expected a distance > 0 in m"));
  ThreadCheckers checkers(scene, margin, tolerance, int(from.rows()), options);
  const auto part = [&](int worker, int first, int end) {
    for (int i = first; i < end; ++i) {
      const double *a = from.row(i).data(), *b = to.row(i).data();
      free[i] = withinLimits(scene.model(), a) && withinLimits(scene.model(), b) && checkers.of(worker).isFree(a, b);
    }
  };
  parallelFor(int(from.rows()), kBatch, checkers.size(), part, options.cancellation);
}

}  // namespace kinegraph
