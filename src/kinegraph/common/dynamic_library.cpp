#include "kinegraph/common/dynamic_library.h"

#include <dlfcn.h>

#include <utility>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline common_internal {

namespace {

/// Flags for dlopen. A library that is loaded looks names up in the program and its libraries first. If these have the
/// same names, the library must begin with its own.
int bindingFlags(const std::string& name, const std::string& purpose, const char* symbol) {
#ifdef RTLD_DEEPBIND
  const auto isThere = [](const char* wanted) { return dlsym(RTLD_DEFAULT, wanted) != nullptr; };
  if (!isThere(symbol)) return 0;
  if (void* loaded = dlopen(name.c_str(), RTLD_NOW | RTLD_NOLOAD)) {
    dlclose(loaded);  // the program's library is this one
    return 0;
  }
  if (isThere("__asan_init") || isThere("__tsan_init") || isThere("__msan_init"))
    throw FileError(cat(purpose, " needs the library ", name, ", and the program has another one with the function ",
                        symbol, "; sanitizers do not allow both in one program"));
  return RTLD_DEEPBIND;
#else
  return 0;
#endif
}

}  // namespace

DynamicLibrary::DynamicLibrary(std::string name, std::string purpose, const char* symbol)
    : name_(std::move(name)),
      purpose_(std::move(purpose)),
      handle_(dlopen(name_.c_str(), RTLD_NOW | RTLD_LOCAL | bindingFlags(name_, purpose_, symbol))) {
  if (!handle_) {
    const char* why = dlerror();
    throw FileError(cat(purpose_, " needs the library ", name_, ", which cannot be loaded: ", why ? why : "unknown"));
  }
}

void* DynamicLibrary::address(const char* symbol) const {
  void* found = dlsym(handle_, symbol);
  if (!found) throw FileError(cat(purpose_, " needs another version of ", name_, ": this one has no ", symbol));
  return found;
}

}  // namespace kinegraph::inline common_internal
