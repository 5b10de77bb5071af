#include "kinegraph/robot/command_log.h"

#include <cmath>
#include <fstream>
#include <iomanip>
#include <locale>
#include <sstream>

#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

constexpr const char* kHeader = "kinegraph commands 1";

// --- writing -------------------------------------------------------------------------------------------------------

void write(std::ostream& out, const VectorXd& numbers) {
  out << ' ' << numbers.size();
  for (const double x : numbers) out << ' ' << exact(x);
}

void write(std::ostream& out, const MatrixXd& numbers) {
  out << ' ' << numbers.rows() << ' ' << numbers.cols();
  for (const double x : numbers.reshaped<Eigen::RowMajor>()) out << ' ' << exact(x);
}

void write(std::ostream& out, const BSpline& spline) {
  out << ' ' << spline.degree();
  write(out, spline.getKnots());
  write(out, spline.getCtrlPoints());
}

struct Writer {
  std::ostream& out;

  void operator()(const FollowSpline& c) {
    if (std::isfinite(c.begin)) {
      write(out << "follow_from " << exact(c.begin), c.motion);
    } else {
      write(out << "follow", c.motion);
    }
  }
  void operator()(const FollowTrajectory& c) {
    const MotionStates& samples = c.motion->samples();
    write(out << "trajectory " << exact(c.begin), samples.times);
    for (const MatrixXd* values : {&samples.q, &samples.velocity, &samples.acceleration}) write(out, *values);
  }
  void operator()(const HoldRobot& c) { write(out << "hold", c.motion); }
  void operator()(const FloatRobot& c) { out << "float " << exact(c.damping); }
  void operator()(const SetStiffness& c) { write(out << "stiffness", c.stiffness); }
  void operator()(const GripperCommand& c) {
    out << (c.grasp ? "grasp " : "gripper ") << c.gripper << ' ' << exact(c.width) << ' ' << exact(c.speed) << ' '
        << exact(c.force) << ' ' << std::quoted(c.object);
  }
  void operator()(const AttachFrames& c) {
    out << (c.attach ? "attach " : "detach ") << std::quoted(c.from) << ' ' << std::quoted(c.to);
  }
  void operator()(const PlaceFrame& c) { write(out << "place " << std::quoted(c.frame), VectorXd(c.pose.numbers())); }
  void operator()(const RecoverRobot&) { out << "recover"; }
};

// --- reading -------------------------------------------------------------------------------------------------------

/// Reads the words of one line; errors name the line.
class Line {
 public:
  Line(const std::string& text, SourcePosition where) : in_(text), where_(std::move(where)) {
    in_.imbue(std::locale::classic());
  }

  [[noreturn]] void fail(const std::string& reason) { throw ParseError(where_, reason); }

  std::string word() {
    std::string word;
    if (!(in_ >> word)) fail("the line ends too early");
    return word;
  }

  double number() {
    const std::string text = word();
    const char* end = nullptr;
    const double value = readNumber(text.c_str(), &end);
    if (end == text.c_str() + text.size()) return value;
    fail(cat("'", text, "' is not a number"));
  }

  long count() {
    const double value = number();
    if (!(value >= 0.) || value > 1e7 || value != double(long(value)))
      fail(cat("the count is ", value, "; expected an integer from 0 to 1e7"));
    return long(value);
  }

  std::string quoted() {
    std::string text;
    if (!(in_ >> std::quoted(text))) fail("expected a name in quotes here");
    return text;
  }

  VectorXd vector() {
    VectorXd numbers(count());
    for (double& x : numbers) x = number();
    return numbers;
  }

  MatrixXd matrix() {
    const long rows = count(), columns = count();
    if (rows * columns > 10'000'000)
      fail(cat("the matrix has ", rows, " x ", columns, " numbers; expected at most 1e7"));
    MatrixXd numbers(rows, columns);
    for (double& x : numbers.reshaped<Eigen::RowMajor>()) x = number();
    return numbers;
  }

  BSpline spline() {
    const int degree = int(count());
    const VectorXd knots = vector();
    try {
      return BSpline::fromParts(degree, knots, matrix());
    } catch (const ValueError& error) {
      fail(error.what());
    }
  }

  std::shared_ptr<const SampledTrajectory> trajectory() {
    MotionStates samples;
    samples.times = vector();
    for (MatrixXd* values : {&samples.q, &samples.velocity, &samples.acceleration}) *values = matrix();
    try {
      return std::make_shared<const SampledTrajectory>(std::move(samples));
    } catch (const ValueError& error) {
      fail(error.what());
    }
  }

 private:
  std::istringstream in_;
  SourcePosition where_;
};

LoopCommand readCommand(Line& line) {
  const std::string kind = line.word();
  if (kind == "follow") return FollowSpline{line.spline()};
  if (kind == "follow_from") {
    const double begin = line.number();
    return FollowSpline{line.spline(), begin};
  }
  if (kind == "trajectory") {
    const double begin = line.number();
    return FollowTrajectory{begin, line.trajectory()};
  }
  if (kind == "hold") return HoldRobot{line.spline()};
  if (kind == "float") return FloatRobot{line.number()};
  if (kind == "stiffness") return SetStiffness{line.matrix()};
  if (kind == "gripper" || kind == "grasp") {
    GripperCommand command;
    command.grasp = kind == "grasp";
    command.gripper = int(line.count());
    command.width = line.number();
    command.speed = line.number();
    command.force = line.number();
    command.object = line.quoted();
    return command;
  }
  if (kind == "attach" || kind == "detach") {
    const std::string from = line.quoted(), to = line.quoted();
    return AttachFrames{from, to, kind == "attach"};
  }
  if (kind == "place") {
    const std::string frame = line.quoted();
    const VectorXd pose = line.vector();
    if (pose.size() != 7) line.fail(cat("the pose has ", pose.size(), " numbers; expected 7"));
    return PlaceFrame{frame, Pose(pose.head<3>(), Quaterniond(pose[3], pose[4], pose[5], pose[6]))};
  }
  if (kind == "recover") return RecoverRobot{};
  const std::vector<std::string> kinds = {"follow",  "follow_from", "trajectory", "hold",   "float", "stiffness",
                                          "gripper", "grasp",       "attach",     "detach", "place", "recover"};
  line.fail(cat("unknown command '", kind, "'", similarHint(kind, kinds)));
}

}  // namespace

std::string CommandLog::text() const {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << kHeader << "\nperiod " << exact(period) << "\n";
  for (const Entry& entry : entries) {
    out << entry.tick << ' ';
    std::visit(Writer{out}, entry.command);
    out << '\n';
  }
  out << ticks << " end\n";
  return out.str();
}

CommandLog CommandLog::fromText(const std::string& text, const std::string& name) {
  std::istringstream in(text);
  CommandLog log;
  std::string content;
  SourcePosition where{name, 1, 1};
  if (!std::getline(in, content) || content != kHeader)
    throw ParseError(where, cat("the first line is not '", kHeader, "'; expected a command log"));
  for (bool ended = false; std::getline(in, content);) {
    ++where.line;
    if (content.empty()) continue;
    Line line(content, where);
    if (ended) line.fail("a line follows the end of the log");
    if (where.line == 2) {
      if (line.word() != "period" || !((log.period = line.number()) > 0.))
        line.fail("expected the word 'period' and a number of seconds above 0");
      continue;
    }
    const long tick = line.count();
    if (tick < log.ticks) line.fail(cat("control period ", tick, " follows ", log.ticks, "; expected increasing ones"));
    log.ticks = tick;
    if (content.ends_with(" end")) {
      ended = true;
    } else {
      log.entries.push_back({tick, readCommand(line)});
    }
  }
  return log;
}

void CommandLog::save(const std::string& path) const {
  std::ofstream file(path);
  if (!(file << text()) || !file.flush()) throw FileError(cat("CommandLog::save: cannot write '", path, "'"));
}

CommandLog CommandLog::load(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw FileError(cat("CommandLog::load: cannot read '", path, "'"));
  std::ostringstream text;
  text << file.rdbuf();
  return fromText(text.str(), path);
}

}  // namespace kinegraph
