#pragma once

/// The manual of what module.cpp binds.
namespace kinegraph::python::docs::module {

inline constexpr char parseText[] = R"(Text in .g syntax as a dict.

Args:
    text: The text.
    name: What messages call it in place of a file name.
Returns:
    The names and values of the text.
Raises:
    ParseError: A mistake in the text; it has the line and the column.)";

}  // namespace kinegraph::python::docs::module
