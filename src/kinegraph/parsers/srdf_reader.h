#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/gfile/parser.h"

namespace kinegraph {

/// What a file says about the frames of a robot besides what they are: an SRDF file. Frames are meant by their names.
struct RobotSemantics {
  struct Pair {
    std::string a, b;  ///< links; an empty `b` stands for all others
    SourcePosition where;
  };
  struct Member {
    enum class Kind { joint, link, chain, group } kind;
    std::string name, tip;  ///< of a chain the first and the last link
    SourcePosition where;
  };
  struct Group {
    std::string name;
    std::vector<Member> members;
  };
  struct JointValue {
    std::string joint;
    std::vector<double> values;  ///< as SRDF orders them: of a floating joint x y z qx qy qz qw
    SourcePosition where;
  };
  struct State {
    std::string name, group;
    std::vector<JointValue> joints;
  };

  std::vector<Pair> no_contact, contact;  ///< `contact` takes pairs out of those without
  std::vector<Group> groups;
  std::vector<State> states;
  std::vector<std::string> outside;  ///< joints of the robot to its world, which are no frames of it
  std::vector<std::string> robot;    ///< the frames of the robot's file, if it was found beside that
  std::string file, prefix;          ///< `prefix` is put before the names of frames
  bool asked_for =
      true;  ///< else it was found beside the robot's file, and names that are not there are nobody's mistake
};

/// The semantics of a text. What is wrong and what is odd is appended to `found`; with an error nothing is returned.
RobotSemantics readSemantics(std::string_view text, const std::string& file, std::vector<Diagnostic>& found);

/// Is it a file of that kind, by its name?
bool isSemanticsFile(const std::string& file);

/// The SRDF file that belongs to a URDF file: of the same name, beside it, or in a folder srdf beside its folder. "" if
/// there is none.
std::string semanticsBeside(const std::string& file);

}  // namespace kinegraph
