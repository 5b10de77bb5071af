#include "kinegraph/features/batch.h"

#include <algorithm>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/parallel.h"
#include "kinegraph/base/text.h"
#include "kinegraph/kinematics/motion_check.h"

namespace kinegraph {

namespace {

constexpr int kPart = 32;  ///< configurations that a thread takes at once

void checkJoints(const State& scene, const Eigen::Ref<const RowMatrix>& Q) {
  if (Q.cols() != scene.dofs()) {
    throw ValueError(cat("joint vectors: got ", Q.rows(), " x ", Q.cols(), " numbers; the configuration has ", scene.dofs(), " dofs"));
  }
  if (Q.allFinite()) return;
  Eigen::Index row = 0;
  while (Q.row(row).allFinite()) ++row;
  throw ValueError(cat("joint vectors: row ", row, " has numbers that are not finite"));
}

/// Calls one(worker, i) for each configuration, with a worker made from `first` for every thread.
template <class Worker, class One>
void forEach(const Worker& first, int count, const BatchOptions& options, const One& one) {
  const int threads = std::clamp(options.threads, 1, std::max(1, (count + kPart - 1) / kPart));
  std::vector<Worker> workers(std::size_t(threads), first);
  const auto part = [&](int worker, int from, int to) {
    for (int i = from; i < to; ++i) one(workers[worker], i);
  };
  forParts(count, kPart, threads, part, options.between);
}

}  // namespace

void evalBatch(const State& scene, const Residual& residual, const Eigen::Ref<const RowMatrix>& Q, Eigen::Ref<RowMatrix> y,
               JacobianRows* J, const BatchOptions& options) {
  checkJoints(scene, Q);
  if (residual.order() > 0) {
    throw ValueError(cat(residual.name(), " of order ", residual.order(), " needs ", residual.order() + 1,
                         " consecutive configurations; a batch takes one at a time"));
  }
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
  forEach(scene, int(Q.rows()), options, [&](State& state, int i) {
    state.setJoints(Q.row(i).data());
    for (std::size_t f = 0; f < frames.size(); ++f) {
      poses.row(i).segment<7>(7 * Eigen::Index(f)) = Pose(state.pose(frames[f])).canonical().numbers().transpose();
    }
  });
}

void pairDistances(const State& scene, const Eigen::Ref<const RowMatrix>& Q, Eigen::Ref<RowMatrix> distances,
                   const BatchOptions& options) {
  checkJoints(scene, Q);
  const BodyPairs pairs(scene.program(), scene.program().collidable());
  struct Worker {
    State state;
    PlacedBodies bodies;
  };
  forEach(Worker{scene, PlacedBodies(pairs)}, int(Q.rows()), options, [&](Worker& worker, int i) {
    worker.state.setJoints(Q.row(i).data());
    worker.bodies.place(worker.state);
    for (int pair = 0; pair < worker.bodies.pairs(); ++pair) distances(i, pair) = worker.bodies.proximity(pair).distance;
  });
}

void areValid(const State& scene, const Eigen::Ref<const RowMatrix>& Q, double margin, std::span<bool> valid,
              const BatchOptions& options) {
  checkJoints(scene, Q);
  const VectorXd &lower = scene.program().lower, &upper = scene.program().upper;
  struct Worker {
    State state;
    NearPairs pairs;
  };
  forEach(Worker{scene, NearPairs(scene.sharedProgram())}, int(Q.rows()), options, [&](Worker& worker, int i) {
    const auto q = Q.row(i).transpose().array();
    valid[i] = (q >= lower.array()).all() && (q <= upper.array()).all();
    if (!valid[i]) return;
    worker.state.setJoints(Q.row(i).data());
    worker.pairs.place(worker.state);
    valid[i] = worker.pairs.apart(margin);
  });
}

void areMotionsFree(const State& scene, const Eigen::Ref<const RowMatrix>& from, const Eigen::Ref<const RowMatrix>& to, double margin,
                    double tolerance, std::span<bool> free, const BatchOptions& options) {
  checkJoints(scene, from);
  checkJoints(scene, to);
  if (from.rows() != to.rows()) throw ValueError(cat("motions: ", from.rows(), " starts and ", to.rows(), " ends"));
  if (!(tolerance > 0.)) throw ValueError(cat("motions: tolerance is ", tolerance, "; expected a distance > 0 in m"));
  forEach(MotionChecker(scene), int(from.rows()), options, [&](MotionChecker& checker, int i) {
    free[i] = !checker.firstContact(from.row(i).data(), to.row(i).data(), margin, tolerance);
  });
}

}  // namespace kinegraph
