#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <sstream>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/common/utf8.h"
#include "kinegraph/tool_paths/tool_path.h"

namespace kinegraph {

namespace {

constexpr double kMillimeter = 1e-3, kInch = 25.4e-3;  // m
constexpr double kFull = 2. * std::numbers::pi;
constexpr double kRadiusShare = 1e-3, kRadiusError = 2e-6;  // m; of the two radii of an arc, which files round

/// A letter with its number, such as G1 or X-2.5.
struct GcodeWord {
  char letter;
  double number;
  SourcePosition where;
};

/// Splits a line into words. Comments in parentheses and after a semicolon, "%" and a block-delete "/" are left out.
std::vector<GcodeWord> wordsOf(const std::string& line, const std::string& file, int number) {
  std::vector<GcodeWord> words;
  for (std::size_t at = 0; at < line.size();) {
    const char c = line[at];
    const SourcePosition where{file, number, int(at) + 1};
    if (c == ';') break;
    if (c == '(') {
      const std::size_t end = line.find(')', at);
      if (end == std::string::npos) throw ParseError(where, "the comment has no end; expected ')'");
      at = end + 1;
    } else if (std::isspace(static_cast<unsigned char>(c)) || c == '%' || (c == '/' && words.empty())) {
      ++at;
    } else if (std::isalpha(static_cast<unsigned char>(c))) {
      const std::size_t first = line.find_first_not_of(" \t", at + 1);
      const std::size_t end = first == std::string::npos ? first : line.find_first_not_of("+-.0123456789", first);
      const std::string text = first == std::string::npos ? "" : line.substr(first, end - first);
      const char* rest = nullptr;
      const double value = readNumber(text.c_str(), &rest);
      if (text.empty() || *rest != '\0')
        throw ParseError(where, cat("'", c, "' has no number; expected such as X12.5"));
      words.push_back({char(std::toupper(static_cast<unsigned char>(c))), value, where});
      at = end == std::string::npos ? line.size() : end;
    } else {
      throw ParseError(where, cat("'", c, "' is no word; expected a letter with a number, such as G1 or X12.5"));
    }
  }
  return words;
}

/// The code of a word, such as G64 or M30, in tenths: G90.1 is 901.
int codeOf(const GcodeWord& word) {
  constexpr double kMostTenths = 99999.;
  const double tenths = std::round(10. * word.number);
  if (std::abs(10. * word.number - tenths) > 1e-6 || !(tenths >= 0. && tenths <= kMostTenths))
    throw ParseError(word.where, cat(word.letter, word.number, " is no code; expected such as ", word.letter, "1"));
  return int(tenths);
}

std::string codeName(char letter, int tenths) {
  return tenths % 10 == 0 ? cat(letter, tenths / 10) : cat(letter, tenths / 10, ".", tenths % 10);
}

/// Builds a path from the lines of a program.
class GcodeProgram {
 public:
  GcodeProgram(ToolPath path, double blend) : path_(std::move(path)), blend_(blend) {}

  std::vector<std::string> warnings;

  /// False after the end of the program.
  bool addLine(const std::vector<GcodeWord>& words) {
    std::map<char, const GcodeWord*> values;
    bool is_end = false, dwells = false, sets_blend = false;
    // Moves to places of the machine, such as its home, are not part of the path.
    const auto leaving = std::find_if(words.begin(), words.end(), [](const GcodeWord& word) {
      return word.letter == 'G' && (word.number == 28. || word.number == 30. || word.number == 53.);
    });
    const bool leaves = leaving != words.end();
    if (leaves) ignore(leaving->where, cat("the move with ", codeName('G', codeOf(*leaving))));
    const auto has = [&](char letter) {
      return std::any_of(words.begin(), words.end(), [&](const GcodeWord& word) { return word.letter == letter; });
    };
    const bool is_of_extruder = has('E') && !has('X') && !has('Y') && !has('Z');
    for (const GcodeWord& word : words) {
      if (leaves && &word == &*leaving) continue;
      if (word.letter == 'G' && codeOf(word) == 920 && is_of_extruder)
        ignore(word.where, "G92");  // others move the origin
      else if (word.letter == 'G')
        addCode(word, dwells, sets_blend);
      else if (word.letter == 'M')
        is_end = addMachineCode(word) || is_end;
      else if (std::string("ABCUVW").find(word.letter) != std::string::npos)
        throw ParseError(word.where, cat("the axis ", word.letter, " is not supported; expected X, Y and Z"));
      else if (std::string("STEDHQL").find(word.letter) != std::string::npos)
        ignore(word.where, cat(word.letter, word.number));
      else if (std::string("XYZIJKRFPNO").find(word.letter) == std::string::npos)
        throw ParseError(word.where, cat("unknown word ", word.letter, word.number));
      else if (word.letter != 'N' && word.letter != 'O' && !values.emplace(word.letter, &word).second)
        throw ParseError(word.where, cat("the line has two words ", word.letter));
    }
    const auto take = [&](char letter) {
      const auto found = values.find(letter);
      return found == values.end() ? nullptr : found->second;
    };
    if (const GcodeWord* feed = take('F')) setFeed(*feed);
    if (const GcodeWord* p = take('P')) {
      if (sets_blend)
        blend_ = unit_ * requireNotNegative(*p);
      else if (!dwells)
        throw ParseError(p->where, "P has no meaning here; expected it after G64 or G4");
    }
    std::array<const GcodeWord*, 3> axes{take('X'), take('Y'), take('Z')}, center{take('I'), take('J'), take('K')};
    if (leaves) return !is_end;
    if (axes[0] || axes[1] || axes[2] || center[0] || center[1] || center[2] || take('R'))
      move(words.front().where, axes, center, take('R'));
    return !is_end;
  }

  ToolPath finish(const std::string& file) {
    if (path_.elements().empty())
      throw ParseError({file, 1, 1}, "the program has no move; expected G0, G1, G2 or G3 with X, Y or Z");
    return std::move(path_);
  }

 private:
  void addCode(const GcodeWord& word, bool& dwells, bool& sets_blend) {
    const int code = codeOf(word);
    switch (code) {
      case 0:
      case 10:
      case 20:
      case 30:
        motion_ = code / 10;
        path_.speed(motion_ == 0 ? 0. : feed_);
        return;
      case 40:
        dwells = true;
        return ignore(word.where, "G4 (dwell)");
      case 170:
      case 180:
      case 190:
        normal_ = code == 170 ? 2 : code == 180 ? 1 : 0;
        return;
      case 200:
      case 210:
        unit_ = code == 200 ? kInch : kMillimeter;
        return;
      case 610:
        blend_ = 0.;
        return;
      case 640:
        sets_blend = true;
        return;
      case 430:
        return ignore(word.where, "G43 (tool length)");
      case 900:
      case 910:
        is_absolute_ = code == 900;
        return;
      case 901:
      case 911:
        has_absolute_centers_ = code == 901;
        return;
      case 400:  // states that are always given: no offsets, no canned cycle, feed per minute
      case 490:
      case 540:
      case 800:
      case 940:
        return;
      default:
        throw ParseError(word.where, cat("unknown code ", codeName('G', code),
                                         "; expected G0-G4, G17-G21, G28, G30, G40, G43, G49, G53, G54, G61, G64, G80, "
                                         "G90, G90.1, G91, G91.1 or G94"));
    }
  }

  /// True at the end of the program.
  bool addMachineCode(const GcodeWord& word) {
    const int code = codeOf(word);
    if (code == 20 || code == 300) return true;
    ignore(word.where, codeName('M', code));
    return false;
  }

  void ignore(const SourcePosition& where, const std::string& what) {
    warnings.push_back(cat(where.str(), ": ", what, " is ignored"));
  }

  static double requireNotNegative(const GcodeWord& word) {
    if (!(word.number >= 0.)) throw ParseError(word.where, cat(word.letter, " is ", word.number, "; expected >= 0"));
    return word.number;
  }

  void setFeed(const GcodeWord& word) {
    if (!(word.number > 0.)) throw ParseError(word.where, cat("F is ", word.number, "; expected a number > 0"));
    feed_ = unit_ * word.number / 60.;
    if (motion_ != 0) path_.speed(feed_);
  }

  void move(const SourcePosition& where, const std::array<const GcodeWord*, 3>& axes,
            const std::array<const GcodeWord*, 3>& center, const GcodeWord* radius) {
    Vector3d to = now_;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!axes[k]) continue;
      to[Eigen::Index(k)] = unit_ * axes[k]->number + (is_absolute_ ? 0. : now_[Eigen::Index(k)]);
      known_[k] = true;
    }
    const bool has_center = center[0] || center[1] || center[2];
    if (motion_ < 2 && (has_center || radius))
      throw ParseError(where, cat("I, J, K and R belong to G2 and G3; the motion is G", motion_));
    if (!path_.first()) {
      if (motion_ == 0) {
        now_ = to;
        if (known_[0] && known_[1] && known_[2]) path_.start(now_);
        return;
      }
      path_.start(now_);
    }
    if (motion_ < 2) {
      path_.line(to, blend());
    } else {
      if (has_center == bool(radius)) throw ParseError(where, "an arc needs either I, J, K or R");
      radius ? arcOfRadius(*radius, to) : arcAround(where, center, to);
    }
    now_ = to;
  }

  void arcAround(const SourcePosition& where, const std::array<const GcodeWord*, 3>& center, const Vector3d& to) {
    Vector3d c = now_;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!center[k]) continue;
      if (int(k) == normal_)
        throw ParseError(center[k]->where, cat(center[k]->letter, " is not in the plane G", 19 - normal_));
      const double from = has_absolute_centers_ ? 0. : now_[Eigen::Index(k)];
      c[Eigen::Index(k)] = from + unit_ * center[k]->number;
    }
    const auto in_plane = [&](Vector3d r) {
      r[normal_] = 0.;
      return r;
    };
    const double first = in_plane(now_ - c).norm(), last = in_plane(to - c).norm();
    if (std::abs(first - last) > kRadiusError + kRadiusShare * first)
      throw ParseError(where,
                       cat("the end of the arc is ", last / unit_, " from its center, its start ", first / unit_));
    append(c, to);
  }

  void arcOfRadius(const GcodeWord& radius, const Vector3d& to) {
    Vector3d chord = to - now_;
    chord[normal_] = 0.;
    const double half = .5 * chord.norm(), r = unit_ * std::abs(radius.number);
    if (half < 1e-9) throw ParseError(radius.where, "R gives no full circle; expected I, J, K");
    if (half > r * (1. + kRadiusShare))
      throw ParseError(radius.where,
                       cat("R is ", radius.number, ", below half of the distance of both ends, ", half / unit_));
    const Vector3d side = Vector3d::Unit(normal_).cross(chord).normalized();  // left of the chord
    const bool is_left = (motion_ == 3) == (radius.number > 0.);
    const double height = std::sqrt(std::max(0., r * r - half * half));
    append(now_ + .5 * chord + (is_left ? height : -height) * side, to);
  }

  /// Appends an arc or a helix about the normal of the plane through c.
  void append(const Vector3d& c, const Vector3d& to) {
    const Vector3d axis = Vector3d::Unit(normal_);
    Vector3d a = now_ - c, b = to - c;
    a[normal_] = b[normal_] = 0.;
    double angle = std::atan2(axis.dot(a.cross(b)), a.dot(b));
    const bool is_full = (a - b).norm() < kRadiusError;
    if (motion_ == 3) angle = is_full ? kFull : angle < 0. ? angle + kFull : angle;
    if (motion_ == 2) angle = is_full ? -kFull : angle > 0. ? angle - kFull : angle;
    path_.circle(c, axis, angle, blend(), (to - now_)[normal_]);
  }

  /// The first element has no corner at its start.
  double blend() const { return path_.elements().empty() ? 0. : blend_; }

  ToolPath path_;
  double blend_, feed_ = 0., unit_ = kMillimeter;
  int motion_ = 0, normal_ = 2;
  bool is_absolute_ = true, has_absolute_centers_ = false;
  Vector3d now_ = Vector3d::Zero();
  std::array<bool, 3> known_{};
};

}  // namespace

ToolPath ToolPath::readGcode(const std::string& file, std::string frame, std::string relative_to, double blend) {
  if (!(blend >= 0.)) throw ValueError(cat("ToolPath.readGcode: blend is ", blend, "; expected a radius >= 0 in m"));
  std::ifstream in(file, std::ios::binary);
  if (!in) throw FileError(cat(file, ": cannot open the file"));
  std::istringstream text(toUtf8(std::string(std::istreambuf_iterator<char>(in), {})));
  GcodeProgram program(ToolPath(std::move(frame), std::move(relative_to)), blend);
  std::string line;
  for (int number = 1; std::getline(text, line); ++number)
    if (!program.addLine(wordsOf(line, file, number))) break;
  ToolPath path = program.finish(file);
  path.parts_.warnings = std::move(program.warnings);
  return path;
}

}  // namespace kinegraph
