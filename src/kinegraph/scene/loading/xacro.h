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

/// Expands a file by the function that was set. Throws FileError without one, with the command that converts the file.
std::string expandXacro(const std::string& path, const XacroArguments& arguments);

}  // namespace kinegraph
