#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/gfile/parser.h"

namespace kinegraph::inline parsers_internal {

/// The content of an SRDF file: collision pairs, groups and states of a robot's frames, referred to by name.
struct RobotSemantics {
  struct Pair {
    std::string a, b;  ///< links; an empty `b` stands for all other links
    SourcePosition where;
  };
  struct Member {
    enum class Kind { joint, link, chain, group } kind;
    std::string name, tip;  ///< first and last link of a chain
    SourcePosition where;
  };
  struct Group {
    std::string name;
    std::vector<Member> members;
  };
  struct JointValue {
    std::string joint;
    std::vector<double> values;  ///< in SRDF order: of a floating joint x y z qx qy qz qw
    SourcePosition where;
  };
  struct State {
    std::string name, group;
    std::vector<JointValue> joints;
  };

  std::vector<Pair> no_contact, contact;  ///< `contact` removes pairs from `no_contact`
  std::vector<Group> groups;
  std::vector<State> states;
  std::vector<std::string> outside;  ///< joints between the robot and its world, without a frame
  std::vector<std::string> robot;    ///< frames of the robot's file, if the file was found beside it
  std::string file, prefix;          ///< put before the names of frames
  bool requested = true;             ///< false: found beside the robot's file
};

/// Parses an SRDF text. Appends errors and warnings to `found`; after an error the result is empty.
RobotSemantics readSemantics(std::string_view text, const std::string& file, std::vector<Diagnostic>& found);

/// Returns whether the name is that of an SRDF file: *.srdf or *.srdf.xacro.
bool isSemanticsFile(const std::string& file);

/// The SRDF file of a URDF file: same name, in the same folder, or in a folder srdf beside that folder. "" if there is
/// none.
std::string semanticsBeside(const std::string& file);

}  // namespace kinegraph::inline parsers_internal
