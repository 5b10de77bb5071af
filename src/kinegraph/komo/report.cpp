#include "kinegraph/komo/komo.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/komo/continuous_collisions.h"
#include "kinegraph/komo/path_problem.h"

namespace kinegraph {

namespace {

double sizeOf(ObjectiveType type, double phi) {
  switch (type) {
    case ObjectiveType::sos:
      return phi * phi;
    case ObjectiveType::ineqP:
      return phi > 0. ? phi * phi : 0.;
    case ObjectiveType::eq:
      return std::abs(phi);
    case ObjectiveType::ineq:
    case ObjectiveType::ineqB:
      return std::max(0., phi);
    default:
      return phi;
  }
}

/// Returns the name of a feature in reports of the reference.
std::string className(const Objective& objective) {
  if (objective.damped) return "F_NewtonEuler_DampedVelocities";
  if (const auto symbol = objective.feature.symbol()) return featureInfo(*symbol).reported_as;
  std::string name = objective.name();
  if (!name.starts_with("q")) name[0] = char(std::toupper(name[0]));
  return "F_" + name;
}

void requireSlice(const Komo& komo, int slice) {
  if (slice < 0 || slice >= komo.slices())
    throw ValueError(cat("KOMO: slice ", slice, " is not in 0 .. ", komo.slices() - 1));
}

}  // namespace

PathErrors measurePath(const Komo& komo) {
  PathProblem problem(komo.path(), komo.contacts(), withSamples(komo.objectives().all(), komo.path()));
  VectorXd phi(problem.rows());
  problem.evaluate(komo.path(), phi, nullptr);
  PathErrors errors;
  errors.per_slice.setZero(komo.slices(), Eigen::Index(problem.objectives().size()));
  for (const PathProblem::Term& term : problem.terms()) {
    for (int row = term.first_row; row < term.first_row + term.rows; ++row) {
      errors.per_slice(term.slice, term.objective) += sizeOf(problem.types()[row], phi[row]);
    }
  }
  const VectorXd sums = errors.per_slice.colwise().sum();
  errors.per_objective.assign(sums.begin(), sums.end());
  errors.totals = sumErrors(problem.types(), phi);
  return errors;
}

std::string objectiveTag(const Komo& komo, const Objective& objective) {
  std::string tag = className(objective);
  const int own =
      objective.feature == FeatureSymbol::angularVel || objective.feature == FeatureSymbol::linangVel ? 1 : 0;
  const int order = own == 1 && objective.order == 1 ? 0 : objective.order;
  if (objective.between_slices) return tag + "/between";
  if (order == 1) tag += "/vel";
  if (order == 2) tag += "/acc";
  if (order > 2) tag += cat("/", order);
  const bool joints = objective.feature == FeatureSymbol::qItself;
  std::size_t count = objective.frames.size();
  if (joints) {  // each joint counts with its parent
    count = 2 * (objective.frames.empty() ? komo.path().initial().joint_frames.size() : objective.frames.size());
  } else if (objective.frames.empty()) {
    count = komo.path().shownFrames().size();
  }
  if (objective.frames.empty() || joints || objective.frames.size() > 3) return cat(tag, "[#", count, "]");
  return cat(tag, "[", join(objective.frames, ","), "]");
}

std::vector<std::string> residualTags(const Komo& komo) {
  const PathProblem problem(komo.path(), komo.contacts(), komo.objectives().all());
  std::vector<std::string> tags;
  for (const PathProblem::Term& term : problem.terms())
    tags.insert(tags.end(), term.rows, objectiveTag(komo, problem.objectives()[term.objective]));
  return tags;
}

std::string sliceErrors(const Komo& komo, int slice, const MatrixXd& per_slice) {
  requireSlice(komo, slice);
  const int count = int(komo.objectives().size());
  if (per_slice.rows() != komo.slices() || per_slice.cols() != count) {
    throw ValueError(cat("sliceErrors: the traces are ", per_slice.rows(), " x ", per_slice.cols(), "; expected ",
                         komo.slices(), " x ", count, ", as from objectiveErrorTraces"));
  }
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return per_slice(slice, a) > per_slice(slice, b); });
  std::string text;
  for (int o : order) {
    if (!(per_slice(slice, o) > 1e-4)) continue;
    const Objective& objective = komo.objectives()[std::size_t(o)];
    text += cat("t:", slice, " #", o, objectiveTag(komo, objective), " ", objectiveTypeName(objective.type), " ",
                per_slice(slice, o), "\n");
  }
  return text;
}

std::string sliceCollisions(const Komo& komo, int slice, double margin) {
  requireSlice(komo, slice);
  const Config config = komo.configuration(slice);
  std::string text;
  for (const Config::NearPair& pair : config.getCollisions(margin)) {
    text += cat(config.getFrame(pair.a).getName(), "-", config.getFrame(pair.b).getName(), ": ", pair.distance, "\n");
  }
  return text;
}

}  // namespace kinegraph
