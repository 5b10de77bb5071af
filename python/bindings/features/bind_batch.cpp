#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include "bindings.h"
#include "features/batch_docs.h"
#include "features/feature_arguments.h"
#include "kinegraph/collision/near_pairs.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/features/eval.h"
#include "kinegraph/features/make_residual.h"
#include "kinegraph/geometry/distance/proximity.h"

namespace kinegraph::python {

namespace {

/// Joint vectors, one per row. The results for a single vector have no first axis.
struct JointVectors {
  Eigen::Map<const RowMatrix> q;
  bool single;

  std::size_t count() const { return std::size_t(q.rows()); }

  /// Returns an array, or its only entry for a single joint vector.
  template <class Kind>
  Kind answer(const Kind& array) const {
    return single ? Kind(nb::object(array[nb::int_(0)])) : array;
  }
};

JointVectors jointVectors(const Numbers& Q, const PyConfig& config, const char* call, const char* name = "Q") {
  const std::size_t n = std::size_t(config.getJointDimension()), size = std::size_t(Q.values.size());
  const bool single = Q.rank == 1 && size == n && n > 0, empty = size == 0 && Q.rank <= 2 && Q.rank > 0;
  if (!single && !empty && (Q.rank != 2 || Q.columns() != n)) {
    throw ValueError(cat(call, ": ", name, " has ",
                         Q.rank == 2   ? cat("shape (", Q.rows, ", ", Q.columns(), ")")
                         : Q.rank == 1 ? cat("shape (", Q.rows, ",)")
                                       : cat(Q.rank, " dimensions"),
                         "; expected (N, ", n, "), one joint vector per row, or (", n, ",), a single one"));
  }
  const std::size_t rows = single ? 1 : Q.rank == 2 ? Q.rows : 0;
  return {{Q.values.data(), Eigen::Index(rows), Eigen::Index(n)}, single};
}

/// Runs without the interpreter lock and regularly checks for Ctrl-C.
template <class Work>
void unlocked(int threads, const char* call, const Work& work) {
  if (threads < 1) throw ValueError(cat(call, ": threads is ", threads, "; expected 1 or more"));
  const nb::gil_scoped_release unlock;
  work(BatchOptions{threads, CheckInterrupts()});
}

Eigen::Map<RowMatrix> rowsOf(const NewArray& array, std::size_t rows, std::size_t columns) {
  return {array.data, Eigen::Index(rows), Eigen::Index(columns)};
}

nb::typed<nb::tuple, Array, Array> evalBatch(const PyConfig& config, const FeatureArgument& feature,
                                             const FrameNames& frames, const Numbers& Q,
                                             const std::optional<Numbers>& scale, const std::optional<Numbers>& target,
                                             int threads) {
  const auto joints = jointVectors(Q, config, "evalBatch");
  const State scene = config.state();
  const Residual residual = makeResidual(scene, feature.source(), toNames(frames), toScale(scale), toTarget(target));
  const std::size_t count = joints.count(), rows = std::size_t(residual.rows()), n = std::size_t(scene.dofs());
  const NewArray y = newArray(count, rows), J = newArray(count, rows, n);
  auto values = rowsOf(y, count, rows), jacobians = rowsOf(J, count * rows, n);
  JacobianRows view = jacobians;
  unlocked(threads, "evalBatch", [&](const BatchOptions& options) {
    kinegraph::evalBatch(scene, residual, joints.q, values, &view, options);
  });
  return nb::make_tuple(joints.answer(y.array), joints.answer(J.array));
}

Array getFramePoses(const PyConfig& config, const Numbers& Q, const FrameNames& frames, int threads) {
  const auto joints = jointVectors(Q, config, "getFramePoses");
  const State scene = config.state();
  std::vector<int> ids;
  for (const std::string& name : toNames(frames)) ids.push_back(frameId(scene.model(), name, "getFramePoses"));
  const NewArray poses = newArray(joints.count(), ids.size(), 7);
  auto rows = rowsOf(poses, joints.count(), 7 * ids.size());
  unlocked(threads, "getFramePoses",
           [&](const BatchOptions& options) { framePoses(scene, ids, joints.q, rows, options); });
  return joints.answer(poses.array);
}

Array getFrameJacobians(const PyConfig& config, const Numbers& Q, const FrameNames& frames, int threads) {
  const auto joints = jointVectors(Q, config, "getFrameJacobians");
  const State scene = config.state();
  std::vector<int> ids;
  for (const std::string& name : toNames(frames)) ids.push_back(frameId(scene.model(), name, "getFrameJacobians"));
  const std::size_t n = std::size_t(scene.dofs());
  const NewArray J = newArray(joints.count(), ids.size(), 6, n);
  const auto rows = rowsOf(J, 6 * joints.count() * ids.size(), n);
  unlocked(threads, "getFrameJacobians",
           [&](const BatchOptions& options) { frameJacobians(scene, ids, joints.q, rows, options); });
  return joints.answer(J.array);
}

Array getDistances(const PyConfig& config, const Numbers& Q, int threads) {
  const auto joints = jointVectors(Q, config, "getDistances");
  const State scene = config.state();
  const std::size_t pairs = scene.model().collidable().size();
  const NewArray distances = newArray(joints.count(), pairs);
  auto rows = rowsOf(distances, joints.count(), pairs);
  unlocked(threads, "getDistances",
           [&](const BatchOptions& options) { pairDistances(scene, joints.q, rows, options); });
  return joints.answer(distances.array);
}

/// Returns nearest points at the present q: (p,), (p, 2, 3), (p, 3).
nb::typed<nb::tuple, Array, Array, Array> nearestPointsHere(const PyConfig& config) {
  const State& state = config.state();
  if (!config.pairs || config.pairs->model() != state.sharedModel()) {
    config.pairs = std::make_shared<PairDistances>(state.sharedModel());
  }
  const std::size_t pairs = state.model().collidable().size();
  const NewArray distances = newArray(pairs), points = newArray(pairs, 2, 3), normals = newArray(pairs, 3);
  const NearestPointArrays arrays{distances.data, points.data, normals.data};
  config.pairs->forAll(state, [&](int pair, const Proximity& near) { arrays.write(pair, near); });
  return nb::make_tuple(distances.array, points.array, normals.array);
}

nb::typed<nb::tuple, Array, Array, Array> getNearestPoints(const PyConfig& config, const std::optional<Numbers>& Q,
                                                           int threads) {
  if (!Q) return nearestPointsHere(config);
  const auto joints = jointVectors(*Q, config, "getNearestPoints");
  const State scene = config.state();
  const std::size_t pairs = scene.model().collidable().size();
  const NewArray distances = newArray(joints.count(), pairs), points = newArray(joints.count(), pairs, 2, 3),
                 normals = newArray(joints.count(), pairs, 3);
  unlocked(threads, "getNearestPoints", [&](const BatchOptions& options) {
    nearestPoints(scene, joints.q, {distances.data, points.data, normals.data}, options);
  });
  return nb::make_tuple(joints.answer(distances.array), joints.answer(points.array), joints.answer(normals.array));
}

FlagArray isValid(const PyConfig& config, const Numbers& Q, double margin, int threads) {
  const auto joints = jointVectors(Q, config, "isValid");
  if (!std::isfinite(margin)) throw ValueError(cat("isValid: margin is ", margin, "; expected a distance in m"));
  warnOfContacts(config);
  const State scene = config.state();
  const NewFlags valid = newFlags(joints.count());
  unlocked(threads, "isValid", [&](BatchOptions options) {
    options.checkers = &config.checkers;
    areValid(scene, joints.q, margin, {valid.data, joints.count()}, options);
  });
  return joints.answer(valid.array);
}

FlagArray isMotionFree(const PyConfig& config, const Numbers& from, const Numbers& to, double margin, double tolerance,
                       int threads) {
  const auto starts = jointVectors(from, config, "isMotionFree", "start"),
             ends = jointVectors(to, config, "isMotionFree", "end");
  if (starts.count() != ends.count())
    throw ValueError(
        cat("isMotionFree: got ", starts.count(), " starts and ", ends.count(), " ends; expected equal numbers"));
  warnOfContacts(config);
  const State scene = config.state();
  const NewFlags free = newFlags(starts.count());
  unlocked(threads, "isMotionFree", [&](BatchOptions options) {
    options.checkers = &config.checkers;
    areMotionsFree(scene, starts.q, ends.q, margin, tolerance, {free.data, starts.count()}, options);
  });
  return starts.answer(free.array);
}

}  // namespace

void bindBatch(nb::class_<PyConfig>& config) {
  config
      .def("evalBatch", evalBatch, "feature"_a, "frames"_a, "Q"_a, "scale"_a = nb::none(), "target"_a = nb::none(),
           "threads"_a = 1, docs::batch::evalBatch)
      .def("getFramePoses", getFramePoses, "Q"_a, "frames"_a, "threads"_a = 1, docs::batch::getFramePoses)
      .def("getFrameJacobians", getFrameJacobians, "Q"_a, "frames"_a, "threads"_a = 1, docs::batch::getFrameJacobians)
      .def("getDistances", getDistances, "Q"_a, "threads"_a = 1, docs::batch::getDistances)
      .def("getNearestPoints", getNearestPoints, "Q"_a = nb::none(), "threads"_a = 1, docs::batch::getNearestPoints)
      .def("isValid", isValid, "Q"_a, "margin"_a = 0., "threads"_a = 1, docs::batch::isValid)
      .def("isMotionFree", isMotionFree, "start"_a, "end"_a, "margin"_a = 0., "tolerance"_a = 1e-5, "threads"_a = 1,
           docs::batch::isMotionFree);
}

}  // namespace kinegraph::python
