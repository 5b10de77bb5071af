#include "kinegraph/api/solutions.h"

#include <algorithm>
#include <limits>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/parallel.h"
#include "kinegraph/common/text.h"
#include "kinegraph/komo/komo.h"
#include "kinegraph/komo/path_components.h"
#include "kinegraph/komo/path_description.h"

namespace kinegraph {

namespace {

/// Returns whether a name is in a list; an empty one stands for the first entry.
bool isOneOf(const std::string& what, std::initializer_list<const char*> words) {
  return what.empty() || std::ranges::find(words, what) != words.end();
}

std::shared_ptr<NlpParameter> ofObjective(const Nlp& nlp, int number, const std::string& what) {
  if (!isOneOf(what, {"target", "scale"}))
    throw NameError(cat("an objective has no '", what, "' to differentiate by; expected target or scale"));
  return what == "scale" ? objectiveScale(nlp, number) : objectiveTarget(nlp, number);
}

std::shared_ptr<NlpParameter> ofFrame(const Nlp& nlp, const std::string& frame, const std::string& what) {
  if (!isOneOf(what, {"position", "pose"}))
    throw NameError(cat("frame '", frame, "' has no '", what, "' to differentiate by; expected position or pose"));
  return what == "pose" ? framePose(nlp, frame) : framePosition(nlp, frame);
}

std::shared_ptr<NlpParameter> ofKomo(const Nlp& nlp, const std::string& name, const std::string& what) {
  std::vector<std::string> known;
  bool is_objective = false;
  for (const Objective& objective : *objectivesOf(nlp)) {
    known.push_back(objectiveName(objective));
    is_objective = is_objective || name == objective.name() || name == known.back();
  }
  if (is_objective) return ofObjective(nlp, objectiveNumber(nlp, name), what);
  const KinematicModel& model = komoOf(nlp)->path().state(0).model();
  if (model.frame_index.contains(name)) return ofFrame(nlp, name, what);
  if (name == "start") return motionStart(nlp);
  const std::string objectives = join(known);
  known.insert(known.end(), model.frame_name.begin(), model.frame_name.end());
  known.push_back("start");
  throw NameError(cat("there is no objective and no frame '", name, "'", similarHint(name, known),
                      objectives.empty() ? "" : cat("; the objectives are ", objectives)));
}

}  // namespace

std::shared_ptr<NlpParameter> parameterOf(const Nlp& nlp, const std::string& name, const std::string& what) {
  if (komoOf(nlp)) return ofKomo(nlp, name, what);
  return parameterOf(nlp, ikTargetNumber(nlp, name), what);
}

std::shared_ptr<NlpParameter> parameterOf(const Nlp& nlp, int number, const std::string& what) {
  if (komoOf(nlp)) return ofObjective(nlp, number, what);
  if (!isOneOf(what, {"target"}))
    throw NameError(cat("a solution of solveIk depends on its targets, not on a '", what, "'"));
  return ikTarget(nlp, number);
}

NlpParameters ikTargets(const Nlp& nlp) {
  NlpParameters parameters;
  for (int i = 0; i < ikTargetCount(nlp); ++i) parameters.push_back(ikTarget(nlp, i));
  return parameters;
}

MatrixXd ikGradients(const std::vector<IkResult>& results, const MatrixXd& v, int threads) {
  const auto count = Eigen::Index(results.size());
  if (v.rows() != count || (count > 0 && v.cols() != results[0].q.size()))
    throw ValueError(cat("the gradients have shape (", v.rows(), ", ", v.cols(), "); expected (", count, ", ",
                         count > 0 ? results[0].q.size() : 0, ") like the solutions"));
  const auto first = std::ranges::find_if(results, &IkResult::feasible);
  if (first == results.end()) return MatrixXd(count, 0);
  int size = 0;
  for (const auto& parameter : ikTargets(*makeNlp(*first))) size += parameter->size();
  MatrixXd gradients = MatrixXd::Constant(count, size, std::numeric_limits<double>::quiet_NaN());
  parallelFor(int(count), 8, threads, [&](int, int from, int to) {
    for (int i = from; i < to; ++i) {
      const IkResult& result = results[std::size_t(i)];
      if (!result.feasible()) continue;
      const std::shared_ptr<Nlp> nlp = makeNlp(result);
      gradients.row(i) = Sensitivity(nlp, result.q, {}, ikTargets(*nlp)).gradient(v.row(i));
    }
  });
  return gradients;
}

}  // namespace kinegraph
