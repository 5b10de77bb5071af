#pragma once

#include <string>

namespace kinegraph::inline common_internal {

/// Expand a list of functions of a library, `#define LIST(X) X(first) X(second)`: the first to members of a struct, one
/// function pointer per function; the second to statements that load the members of such a struct `functions` from a
/// DynamicLibrary `library`.
#define KINEGRAPH_LIBRARY_MEMBER(name) decltype(&::name) name;
#define KINEGRAPH_LIBRARY_LOAD(name) library.load(functions.name, #name);

/// A shared library that is loaded on demand and stays loaded. The search path is that of the linked libraries of this
/// library.
class DynamicLibrary {
 public:
  /// `purpose` names the function that needs the library, and `symbol` one of the library's own functions. If the
  /// program has another library with these functions, such as another version, this one keeps to its own (deep
  /// binding). Throws FileError with the name if the library cannot be loaded.
  DynamicLibrary(std::string name, std::string purpose, const char* symbol);

  /// Sets `function` to the function of that name. Throws FileError if the library does not have it.
  template <class Function>
  void load(Function*& function, const char* symbol) const {
    function = reinterpret_cast<Function*>(address(symbol));
  }

 private:
  void* address(const char* symbol) const;

  std::string name_, purpose_;
  void* handle_;
};

}  // namespace kinegraph::inline common_internal
