// Trajectories as text files: Trajectory::writeCsv and SampledTrajectory::read.
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <vector>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/trajectories/trajectory.h"

namespace kinegraph {

namespace {

constexpr const char* kRowsExpected = "expected time, q, velocity and acceleration, as Trajectory.writeCsv writes them";

/// Returns the numbers of a line that is separated by commas; `column` is that of the first cell without a number.
std::vector<double> cellsOf(const std::string& line, int& column) {
  std::vector<double> numbers;
  const char* at = line.c_str();
  column = 0;
  for (;;) {
    const char* end = at;
    const double number = readNumber(at, &end);
    const char* rest = end;
    while (*rest == ' ' || *rest == '\t' || *rest == '\r') ++rest;
    if (end == at || (*rest != ',' && *rest != '\0') || !std::isfinite(number)) {
      column = int(at - line.c_str()) + 1;
      return numbers;
    }
    numbers.push_back(number);
    if (*rest == '\0') return numbers;
    at = rest + 1;
  }
}

}  // namespace

void Trajectory::writeCsv(const std::string& file, double rate, const std::vector<std::string>& names) const {
  const auto n = std::size_t(dimension());
  if (!names.empty() && names.size() != n)
    throw ValueError(cat("writeCsv: got ", names.size(), " names; the trajectory has ", n, " dofs"));
  const MotionStates states = sample(rate);
  std::ofstream out(file);
  if (!out) throw FileError(cat(file, ": cannot write the file: ", std::strerror(errno)));
  const auto name = [&](std::size_t j) { return names.empty() ? cat("q", j) : names[j]; };
  out << "time";
  for (const char* kind : {"", "_velocity", "_acceleration"})
    for (std::size_t j = 0; j < n; ++j) out << ',' << name(j) << kind;
  out << '\n';
  for (Eigen::Index k = 0; k < states.times.size(); ++k) {
    out << exact(states.times[k]);
    for (const MatrixXd* values : {&states.q, &states.velocity, &states.acceleration})
      for (Eigen::Index j = 0; j < values->cols(); ++j) out << ',' << exact((*values)(k, j));
    out << '\n';
  }
  out.close();
  if (!out) throw FileError(cat(file, ": cannot write all rows; is the disk full?"));
}

SampledTrajectory SampledTrajectory::read(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw FileError(cat(file, ": cannot open the file: ", std::strerror(errno)));
  std::vector<std::vector<double>> rows;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    int column = 0;
    std::vector<double> cells = cellsOf(line, column);
    if (column > 0 && number == 1) continue;  // names
    const SourcePosition place{file, number, std::max(column, 1)};
    if (column > 0) throw ParseError(place, cat("not a finite number; ", kRowsExpected));
    if (cells.size() < 4 || cells.size() % 3 != 1)
      throw ParseError(place, cat("the row has ", cells.size(), " numbers; ", kRowsExpected,
                                  " (for a path without them, `retime` computes a timing)"));
    if (!rows.empty() && cells.size() != rows.front().size())
      throw ParseError(place,
                       cat("the row has ", cells.size(), " numbers; the rows before have ", rows.front().size()));
    rows.push_back(std::move(cells));
  }
  if (rows.empty()) throw ParseError({file, 1, 1}, cat("there are no rows; ", kRowsExpected));
  const auto count = Eigen::Index(rows.size()), n = Eigen::Index(rows.front().size() / 3);
  MotionStates states{VectorXd(count), MatrixXd(count, n), MatrixXd(count, n), MatrixXd(count, n)};
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::Map<const Eigen::RowVectorXd> row(rows[std::size_t(k)].data(), 1 + 3 * n);
    states.times[k] = row[0];
    states.q.row(k) = row.segment(1, n);
    states.velocity.row(k) = row.segment(1 + n, n);
    states.acceleration.row(k) = row.segment(1 + 2 * n, n);
  }
  return SampledTrajectory(std::move(states));
}

}  // namespace kinegraph
