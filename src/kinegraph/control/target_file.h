#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// Poses at times, from a text: rows of t x y z, or t x y z qw qx qy qz, in s and m. Numbers are separated by commas; empty
/// lines, lines that begin with # and a header are left out. Between rows positions go straight and rotations turn
/// evenly; before the first and after the last row the pose stays.
class TargetFile {
 public:
  /// Reads a file. Throws FileError if it cannot be read, ParseError with the place of what is not as expected.
  explicit TargetFile(const std::string& path);

  /// The same of a text; `name` stands in its errors.
  static TargetFile fromText(std::string_view text, const std::string& name = {});

  double duration() const { return rows_.back().time; }  ///< time of the last row, s

  /// The pose at a time t, s: x y z (3,), or x y z qw qx qy qz (7,).
  VectorXd operator()(double t) const;

 private:
  struct Row {
    double time;
    VectorXd pose;
  };
  TargetFile() = default;

  std::vector<Row> rows_;  ///< at least one; times ascend, quaternions have length one and the signs of the short way
};

}  // namespace kinegraph
