#include "kinegraph/trajectories/two_variable_program.h"

#include <algorithm>
#include <cmath>

namespace kinegraph::inline trajectories_internal {

namespace {

constexpr double kTolerance = 1e-11;  // largest violation of a row, relative to its limits
constexpr double kRounding = 2e-15;   // likewise, relative to the largest of its terms
constexpr double kFlat = 1e-6;        // relative determinant below which two rows of a guess count as parallel
constexpr int kMaxPivots = 80;

}  // namespace

// Inequalities are numbered: 2 r and 2 r + 1 are the upper and the lower side of row r; first come the rows with limit
// 1, then the others, then the box.
TwoVariableProgram::Cut TwoVariableProgram::cut(int inequality) const {
  const int row = inequality / 2, rows = int(u.size()), count = rows + int(others.size());
  const bool is_upper = inequality % 2 == 0;
  const double sign = is_upper ? 1. : -1.;
  if (row < rows) return {sign * u[row], sign * w[row], 1. - sign * t[row]};
  if (row < count) {
    const PlaneRow& other = others[std::size_t(row - rows)];
    return {sign * other.u, sign * other.w, is_upper ? other.high - other.t : other.t - other.low};
  }
  if (row == count) return {sign, 0., is_upper ? x_high : -x_low};
  return {0., sign, is_upper ? y_high : -y_low};
}

int TwoVariableProgram::mostViolated(double x, double y, double tolerance) {
  const int rows = int(u.size());
  double most = tolerance;
  int found = -1;
  if (rows > 0) {
    value_ = u * x + w * y + t;
    if (value_.abs().maxCoeff() > 1. + tolerance) {
      const auto rounding = kRounding * ((u * x).abs() + (w * y).abs() + t.abs());
      int r = 0;
      const double peak = (value_.abs() - rounding).maxCoeff(&r) - 1.;
      if (peak > tolerance) most = peak, found = 2 * r + (value_[r] > 0. ? 0 : 1);
    }
  }
  const auto offer = [&](double violation, int inequality) {
    if (violation > most) most = violation, found = inequality;
  };
  for (std::size_t k = 0; k < others.size(); ++k) {
    const PlaneRow& row = others[k];
    const double at = row.u * x + row.w * y + row.t,
                 size = std::min(std::abs(row.high - row.t), std::abs(row.low - row.t));
    const double unit = 1. / std::max(size, 1e-6 * std::max(std::abs(row.t), 1e-300));
    offer((at - row.high) * unit, 2 * (rows + int(k)));
    offer((row.low - at) * unit, 2 * (rows + int(k)) + 1);
  }
  const int box = 2 * (rows + int(others.size()));
  const double x_unit = 1. / std::max(1e-300, x_high), y_unit = 1. / std::max(1e-300, y_high);
  offer((x - x_high) * x_unit, box), offer((x_low - x) * x_unit, box + 1);
  offer((y - y_high) * y_unit, box + 2), offer((y_low - y) * y_unit, box + 3);
  return found;
}

TwoVariableProgram::Answer TwoVariableProgram::farthest(double dx, double dy, const Answer* guess) {
  const int box = 2 * int(u.size() + Eigen::Index(others.size())), low = dx > 0. ? 0 : 1;
  Answer answer;
  answer.rows[0] = box + low, answer.rows[1] = box + 2 + low;
  if (guess && guess->is_feasible) {
    const Cut first = cut(guess->rows[0]), second = cut(guess->rows[1]);
    const double determinant = first.a * second.b - first.b * second.a;
    const double flat = kFlat * (std::abs(first.a * second.b) + std::abs(first.b * second.a));
    if (std::abs(determinant) > flat && (dx * second.b - dy * second.a) / determinant >= 0. &&
        (first.a * dy - first.b * dx) / determinant >= 0.)
      answer.rows[0] = guess->rows[0], answer.rows[1] = guess->rows[1];
  }
  for (int pivot = 0; pivot < kMaxPivots; ++pivot) {
    const Cut first = cut(answer.rows[0]), second = cut(answer.rows[1]);
    const double determinant = first.a * second.b - first.b * second.a;
    answer.x = (first.c * second.b - first.b * second.c) / determinant;
    answer.y = (first.a * second.c - first.c * second.a) / determinant;
    answer.multipliers[0] = (dx * second.b - dy * second.a) / determinant;
    answer.multipliers[1] = (first.a * dy - first.b * dx) / determinant;
    const int entering = mostViolated(answer.x, answer.y, kTolerance);
    if (entering < 0) {
      answer.is_feasible = true;
      return answer;
    }
    const Cut next = cut(entering);
    const double share[2] = {(next.a * second.b - next.b * second.a) / determinant,
                             (first.a * next.b - first.b * next.a) / determinant};
    const double tiny = 1e-14 * (std::abs(share[0]) + std::abs(share[1]));
    int leaving = -1;
    double least = 0.;
    for (int k = 0; k < 2; ++k) {
      const double ratio = std::max(0., answer.multipliers[k]) / share[k];
      if (share[k] > tiny && (leaving < 0 || ratio < least)) leaving = k, least = ratio;
    }
    if (leaving < 0) {  // next + |share| (first, second) have no common point
      answer.third = entering;
      answer.contradiction = next.a * answer.x + next.b * answer.y - next.c;
      answer.multipliers[0] = -share[0], answer.multipliers[1] = -share[1];
      return answer;
    }
    answer.rows[leaving] = entering;
  }
  return answer;
}

double TwoVariableProgram::signedValue(int inequality, const Eigen::ArrayXd& of_rows,
                                       const std::vector<double>& of_others) const {
  const int row = inequality / 2, rows = int(u.size());
  const double sign = inequality % 2 == 0 ? 1. : -1.;
  if (row < rows) return sign * of_rows[row];
  if (row < rows + int(others.size())) return sign * of_others[std::size_t(row - rows)];
  return 0.;
}

}  // namespace kinegraph::inline trajectories_internal
