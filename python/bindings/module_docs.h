#pragma once

/// Docstrings for module.cpp.
namespace kinegraph::python::docs::module {

inline constexpr char parseText[] = R"(Parses a text in .g syntax to a dict.

Args:
    text: The text.
    name: Name of the text in messages, in place of a file name.
Returns:
    The names and values of the text.
Raises:
    ParseError: The text has an error; the message has the line and the column.)";

}  // namespace kinegraph::python::docs::module
