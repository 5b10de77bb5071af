#include "kinegraph/api/batch_queries.h"

#include <cmath>
#include <memory>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/kinematics/kinematic_model.h"
#include "kinegraph/kinematics/state.h"

namespace kinegraph {

namespace {

void requireMargin(const char* call, double margin) {
  if (!std::isfinite(margin)) throw ValueError(cat(call, ": margin is ", margin, "; expected a distance in m"));
}

/// Calls write(answers) with room for `count` answers, and returns them.
template <class Write>
std::vector<bool> answersOf(Eigen::Index count, const Write& write) {
  const auto answers = std::make_unique<bool[]>(std::size_t(count));
  write(std::span<bool>(answers.get(), std::size_t(count)));
  return std::vector<bool>(answers.get(), answers.get() + count);
}

}  // namespace

std::vector<bool> isValid(const Config& C, const RowMatrix& Q, double margin, int threads) {
  requireMargin("isValid", margin);
  return answersOf(Q.rows(),
                   [&](std::span<bool> valid) { areValid(C.state(), Q, margin, valid, {.threads = threads}); });
}

std::vector<bool> isMotionFree(const Config& C, const RowMatrix& start, const RowMatrix& end, double margin,
                               double tolerance, int threads) {
  requireMargin("isMotionFree", margin);
  if (start.rows() != end.rows())
    throw ValueError(
        cat("isMotionFree: got ", start.rows(), " starts and ", end.rows(), " ends; expected equal numbers"));
  return answersOf(start.rows(), [&](std::span<bool> is_free) {
    areMotionsFree(C.state(), start, end, margin, tolerance, is_free, {.threads = threads});
  });
}

RowMatrix getFramePoses(const Config& C, const RowMatrix& Q, const std::vector<std::string>& frames, int threads) {
  std::vector<int> ids;
  for (const std::string& name : frames) ids.push_back(frameId(C.state().model(), name, "getFramePoses"));
  RowMatrix poses(Q.rows(), Eigen::Index(7 * ids.size()));
  framePoses(C.state(), ids, Q, poses, {.threads = threads});
  return poses;
}

RowMatrix getDistances(const Config& C, const RowMatrix& Q, int threads) {
  RowMatrix distances(Q.rows(), Eigen::Index(C.getCollidablePairs().size()));
  pairDistances(C.state(), Q, distances, {.threads = threads});
  return distances;
}

}  // namespace kinegraph
