#include "kinegraph/solvers/nlp_solver.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/solvers/methods/augmented_lagrangian.h"
#include "kinegraph/solvers/problems/relaxed_nlp.h"

namespace kinegraph {

namespace {

constexpr int kMaxTrials = 12;     // number of relaxations, the most promising first
constexpr double kNoSlack = 1e-9;  // distance at which a bound counts as active
constexpr double kWeakPull =
    1e-3;  // a bound with a smaller share of the largest multiplier is not part of the conflict

double angleOfChord(double chord) { return 2. * std::asin(std::min(1., .5 * chord)); }

void raise(double& value, double to) { value = std::isnan(value) ? to : std::max(value, to); }

/// Returns the violation of residuals of one objective in one slice. Lengths of equalities form a vector.
Amount amountOf(const Nlp& nlp, const VectorXd& phi, const std::vector<int>& rows) {
  Amount out;
  double length = -1., quaternion = -1., axis = -1.;
  for (int row : rows) {
    const RowDescription what = nlp.describeRow(row);
    const bool equality = nlp.types()[row] == ObjectiveType::eq;
    const double missed = equality ? std::abs(phi[row]) : std::max(0., phi[row]);
    out.scaled = std::max(out.scaled, missed);
    out.time_order = what.time_order;
    if (what.scale == 0.) continue;
    const double value = missed / std::abs(what.scale), square = value * value;
    switch (what.measure) {
      case Measure::number:
        break;
      case Measure::length:
        length = equality ? std::max(length, 0.) + square : std::max(length, square);
        break;
      case Measure::angle:
        raise(out.radians, value);
        break;
      case Measure::quaternion:
        quaternion = std::max(quaternion, 0.) + square;
        break;
      case Measure::axis:
        axis = std::max(axis, 0.) + square;
        break;
      case Measure::cosine: {
        const auto angle = [](double cosine) { return std::acos(std::clamp(cosine, -1., 1.)); };
        raise(out.radians, std::abs(angle(what.target + phi[row] / what.scale) - angle(what.target)));
        break;
      }
    }
  }
  if (length >= 0.) out.meters = std::sqrt(length);
  if (quaternion >= 0.) raise(out.radians, 2. * angleOfChord(std::sqrt(quaternion)));
  if (axis >= 0.) raise(out.radians, angleOfChord(std::sqrt(axis)));
  return out;
}

/// Returns the largest violation over all slices.
Amount amountOfSlices(const Nlp& nlp, const VectorXd& phi, const std::vector<int>& rows) {
  std::map<int, std::vector<int>> by_slice;
  for (int row : rows) by_slice[nlp.describeRow(row).slice].push_back(row);
  Amount out;
  for (const auto& [slice, some] : by_slice) {
    const Amount here = amountOf(nlp, phi, some);
    out.scaled = std::max(out.scaled, here.scaled);
    out.time_order = here.time_order;
    if (!std::isnan(here.meters)) raise(out.meters, here.meters);
    if (!std::isnan(here.radians)) raise(out.radians, here.radians);
  }
  return out;
}

std::string withUnit(double meters) {
  if (meters >= 1.) return numberText(meters, 3) + " m";
  return meters >= .01 ? numberText(1e2 * meters, 3) + " cm" : numberText(1e3 * meters, 3) + " mm";
}

std::string slicesText(const std::vector<int>& slices) {
  if (slices.empty() || slices.front() < 0) return {};
  if (slices.size() == 1) return cat(" in slice ", slices[0]);
  return cat(" in ", slices.size(), " slices, ", slices.front(), " to ", slices.back());
}

/// Groups violated residuals by requirement.
std::vector<Conflict> violatedRequirements(const Nlp& nlp, const VectorXd& phi, double tolerance) {
  std::map<int, Conflict> by_group;
  for (int row = 0; row < int(nlp.types().size()); ++row) {
    const double v = violation(nlp.types()[row], phi[row]);
    if (v <= tolerance) continue;
    const RowDescription what = nlp.describeRow(row);
    Conflict& conflict = by_group[what.group];
    conflict.name = what.objective;
    conflict.type = nlp.types()[row];
    conflict.frames = what.frames;
    conflict.rows.push_back(row);
    if (conflict.slices.empty() || conflict.slices.back() != what.slice) {
      conflict.slices.push_back(what.slice);
      for (std::string& detail : nlp.detailsOf(row)) conflict.details.push_back(std::move(detail));
    }
    conflict.pull = std::max(conflict.pull, 2. * v);
  }
  std::vector<Conflict> conflicts;
  for (auto& [group, conflict] : by_group) {
    if (conflict.slices.front() < 0) conflict.slices.clear();
    conflict.violation = amountOfSlices(nlp, phi, conflict.rows);
    conflicts.push_back(std::move(conflict));
  }
  std::stable_sort(conflicts.begin(), conflicts.end(),
                   [](const Conflict& a, const Conflict& b) { return a.violation.scaled > b.violation.scaled; });
  return conflicts;
}

/// Returns the bounds that prevent a further decrease of the sum of squared violations.
std::vector<Conflict> activeBounds(Nlp& nlp, const VectorXd& x, const VectorXd& phi, const Jacobian& J,
                                   double tolerance) {
  VectorXd gradient = VectorXd::Zero(x.size());
  for (int row = 0; row < phi.size(); ++row) {
    if (violation(nlp.types()[row], phi[row]) > tolerance) J.addRowTo(row, 2. * phi[row], gradient);
  }
  std::vector<Conflict> bounds;
  for (int i = 0; i < x.size(); ++i) {
    const bool below = x[i] <= nlp.lower()[i] + kNoSlack && gradient[i] > 0.,
               above = x[i] >= nlp.upper()[i] - kNoSlack && gradient[i] < 0.;
    if (!below && !above) continue;
    const VariableDescription what = nlp.describeVariable(i);
    Conflict conflict;
    conflict.name = cat(below ? "lower" : "upper", " limit of ", what.name);
    conflict.is_bound = true;
    if (!what.frame.empty()) conflict.frames = {what.frame};
    if (what.slice >= 0) conflict.slices = {what.slice};
    conflict.variable = i;
    conflict.bound = below ? nlp.lower()[i] : nlp.upper()[i];
    conflict.pull = std::abs(gradient[i]);
    bounds.push_back(std::move(conflict));
  }
  std::stable_sort(bounds.begin(), bounds.end(), [](const Conflict& a, const Conflict& b) { return a.pull > b.pull; });
  while (!bounds.empty() && bounds.back().pull < kWeakPull * bounds.front().pull) bounds.pop_back();
  return bounds;
}

Amount amountOfBound(const Nlp& nlp, int variable, double beyond) {
  Amount out;
  out.scaled = beyond;
  const Measure measure = nlp.describeVariable(variable).measure;
  if (measure == Measure::length) out.meters = beyond;
  if (measure == Measure::angle) out.radians = beyond;
  return out;
}

/// Relaxes one requirement as far as necessary, and checks whether the others can hold.
void tryRelaxing(Nlp& nlp, const VectorXd& x, double tolerance, const EvaluationCallback& callback,
                 Conflict& conflict) {
  const std::size_t rows = nlp.types().size();
  std::vector<bool> relaxed(rows, false);
  std::vector<int> group_rows;
  if (!conflict.is_bound) {
    const int group = nlp.describeRow(conflict.rows[0]).group;
    for (int row = 0; row < int(rows); ++row) {
      relaxed[row] = nlp.describeRow(row).group == group;
      if (relaxed[row]) group_rows.push_back(row);
    }
  }
  RelaxedNlp problem(nlp, relaxed, conflict.variable);
  SolverOptions options;
  options.verbose = 0;
  options.stopEvals = 100;
  options.stopGTolerance = .1 * tolerance;
  const SolverResult result = solveAugmentedLagrangian(problem, x, options, {}, callback);
  VectorXd phi(Eigen::Index(problem.types().size()));
  problem.evaluate(result.x, phi, nullptr);
  conflict.remaining = result.violation;
  conflict.suffices = result.violation <= tolerance;
  if (conflict.is_bound) {
    const double at = result.x[conflict.variable];
    conflict.relaxation =
        amountOfBound(nlp, conflict.variable,
                      std::abs(at - std::clamp(at, nlp.lower()[conflict.variable], nlp.upper()[conflict.variable])));
  } else {
    conflict.relaxation = amountOfSlices(nlp, phi.head(Eigen::Index(rows)), group_rows);
  }
}

/// Returns the size in m or rad, if it has a unit, so that the scales of objectives do not matter.
double sizeOf(const Amount& amount) {
  double size = 0.;
  if (!std::isnan(amount.meters)) size = amount.meters;
  if (!std::isnan(amount.radians)) size = std::max(size, amount.radians);
  return size > 0. ? size : amount.scaled;
}

/// Returns the requirement whose smallest relaxation lets all others hold; else the one that leaves the least
/// violation.
int mostHelpful(const std::vector<Conflict>& conflicts, double violation_now) {
  int best = -1;
  for (int i = 0; i < int(conflicts.size()); ++i) {
    const Conflict& c = conflicts[i];
    if (!c.suffices && c.remaining > .9 * violation_now) continue;
    if (best < 0) {
      best = i;
      continue;
    }
    const Conflict& b = conflicts[best];
    const bool better = c.suffices != b.suffices ? c.suffices
                        : c.suffices             ? sizeOf(c.relaxation) < .999 * sizeOf(b.relaxation)
                                                 : c.remaining < .999 * b.remaining;
    if (better) best = i;
  }
  return best;
}

}  // namespace

std::string Amount::str() const {
  const std::string per = time_order == 0 ? "" : time_order == 1 ? "/s" : cat("/s^", time_order);
  std::vector<std::string> parts;
  if (!std::isnan(meters) && (meters > 0. || std::isnan(radians))) parts.push_back(withUnit(meters) + per);
  if (!std::isnan(radians) && (radians > 0. || parts.empty()))
    parts.push_back(cat(numberText(radians, 3), " rad", per));
  return parts.empty() ? cat(numberText(scaled, 3), " (scaled)") : join(parts, " and ");
}

namespace {

Explanation findConflicts(Nlp& nlp, const VectorXd& x, double tolerance, const EvaluationCallback& callback) {
  Explanation out;
  out.tolerance = tolerance;
  out.x = x;
  VectorXd phi(Eigen::Index(nlp.types().size()));
  nlp.evaluate(x, phi, nullptr);
  if (const std::string what = describeNotFinite(nlp, phi, nullptr); !what.empty())
    throw ValueError(cat("explain: ", what));
  out.violation = out.least_violation = largestViolation(nlp.types(), phi);
  if (out.violation <= tolerance) return out;
  out.conflicts = violatedRequirements(nlp, phi, tolerance);

  RelaxedNlp least(nlp, std::vector<bool>(nlp.types().size(), true));
  SolverOptions options;
  options.verbose = 0;
  options.stopEvals = 200;
  options.stopTolerance = 1e-6;
  if (nlp.dimension() > 0)
    out.x = solveAugmentedLagrangian(least, x.cwiseMax(nlp.lower()).cwiseMin(nlp.upper()), options, {}, callback).x;
  Jacobian J = nlp.makeJacobian();
  nlp.evaluate(out.x, phi, &J);
  out.least_violation = largestViolation(nlp.types(), phi);
  if (out.least_violation <= tolerance) {
    out.verdict = Explanation::Verdict::not_reached;
    nlp.evaluate(x, phi, nullptr);
    return out;
  }
  out.verdict = Explanation::Verdict::conflict;
  out.conflicts = violatedRequirements(nlp, phi, tolerance);
  for (Conflict& bound : activeBounds(nlp, out.x, phi, J, tolerance)) out.conflicts.push_back(std::move(bound));
  for (int i = 0; i < int(out.conflicts.size()); ++i) {
    if (i < kMaxTrials) {
      tryRelaxing(nlp, out.x, tolerance, callback, out.conflicts[i]);
    } else {
      out.conflicts[i].remaining = out.least_violation;
    }
  }
  out.best = mostHelpful(out.conflicts, out.least_violation);
  nlp.evaluate(x, phi, nullptr);
  return out;
}

}  // namespace

Explanation explain(Nlp& nlp, const VectorXd& x, double tolerance, const CancellationToken& cancellation) {
  if (x.size() != nlp.dimension())
    throw ValueError(cat("explain: x has ", x.size(), " entries; the problem has ", nlp.dimension(), " variables"));
  VectorXd no_multipliers;
  nlp.refine(x, no_multipliers);
  if (!cancellation) return findConflicts(nlp, x, tolerance, {});
  try {
    return findConflicts(nlp, x, tolerance, [&](const VectorXd&, const VectorXd&) {
      cancellation.check();
      return true;
    });
  } catch (...) {
    nlp.leaveAt(x);
    throw;
  }
}

std::string Explanation::str(int at_most) const {
  if (!reason.empty()) return reason;
  if (verdict == Verdict::holds) return cat("All constraints hold to ", tolerance, ".");
  std::string text = verdict == Verdict::not_reached
                         ? "All constraints can hold nearby, but not at this point; solve (again) from here:"
                         : "The constraints contradict each other. At the point of least violation:";
  int shown = 0;
  for (const Conflict& conflict : conflicts) {
    if (shown++ == at_most) {
      text += cat("\n  and ", int(conflicts.size()) - at_most, " more");
      break;
    }
    text += cat("\n  ", conflict.name, slicesText(conflict.slices));
    text += conflict.is_bound
                ? cat(" is active at ", conflict.bound)
                : cat(" (", objectiveTypeName(conflict.type), ") is violated by ", conflict.violation.str());
    if (!conflict.details.empty())
      text +=
          cat(": ",
              join({conflict.details.begin(),
                    conflict.details.begin() + std::min<std::ptrdiff_t>(3, std::ptrdiff_t(conflict.details.size()))}));
  }
  if (verdict == Verdict::not_reached) return text;
  if (best < 0) return text + "\nRelaxing any single one of these does not help.";
  const Conflict& c = conflicts[best];
  if (c.suffices) return text + cat("\nIf ", c.name, " is relaxed by ", c.relaxation.str(), ", all others can hold.");
  return text + cat("\nNo single relaxation lets all others hold. Relaxing ", c.name,
                    " helps most: the largest violation falls from ", least_violation, " to ", c.remaining,
                    " (scaled).");
}

}  // namespace kinegraph
