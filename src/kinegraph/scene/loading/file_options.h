#pragma once

#include <functional>
#include <map>
#include <string>

namespace kinegraph {

/// Values of the arguments <xacro:arg> of a file, by name.
using XacroArguments = std::map<std::string, std::string>;

/// Returns the XML text of a file with xacro macros. Throws Error.
using XacroExpander = std::function<std::string(const std::string& path, const XacroArguments& arguments)>;

/// Sets the function that expands files with macros in this process; an empty one removes it. The Python package sets
/// one that calls the package xacrodoc.
void setXacroExpander(XacroExpander expander);

/// How a scene file is read.
struct FileOptions {
  bool strict = false;     ///< warnings about the file are errors
  XacroArguments xacro{};  ///< arguments of a .xacro file
  /// Gives the root frame a free joint below a new frame `world`; a legged robot then falls in a simulation. Throws
  /// ValueError if the file has several roots, or a root that cannot move.
  bool floating = false;
  bool orphans = false;  ///< a frame with an unknown parent has none, and a warning, instead of an error
};

}  // namespace kinegraph
