#pragma once

#include <string>

#include "kinegraph/gfile/value.h"

namespace kinegraph::inline gfile_internal {

/// Text that parses to the same value: numbers in their shortest exact form, strings unquoted if possible. Throws
/// ValueError for text that the language cannot express (both kinds of quotes in one string).
std::string write(const Value& value);

/// The entries of a graph on one line, without braces: "shape: box, size: [1 1 1], flag, other!".
std::string writeEntries(const Graph& graph);

/// A file: one entry per line.
std::string writeFile(const Graph& graph);

}  // namespace kinegraph::inline gfile_internal
