#pragma once

#include <string>

namespace kinegraph {

/// What is made of a list of a library's functions, `#define LIST(X) X(first) X(second)`: the members of a struct that has
/// a pointer to each under its own name, and the calls that fill `functions`, such a struct, from a DynamicLibrary
/// `library`.
#define KINEGRAPH_LIBRARY_MEMBER(name) decltype(&::name) name;
#define KINEGRAPH_LIBRARY_LOAD(name) library.load(functions.name, #name);

/// A shared library that is loaded when it is first needed, not when the program starts. It is looked for where the
/// libraries are that this one is linked with, and stays loaded.
class DynamicLibrary {
 public:
  /// `purpose` is what cannot be done without it. Throws FileError, which names the library, if it cannot be loaded.
  DynamicLibrary(std::string name, std::string purpose);

  /// Points `function` to the function of that name. Throws FileError if the library has none.
  template <class Function>
  void load(Function*& function, const char* symbol) const {
    function = reinterpret_cast<Function*>(address(symbol));
  }

 private:
  void* address(const char* symbol) const;

  std::string name_, purpose_;
  void* handle_;
};

}  // namespace kinegraph
