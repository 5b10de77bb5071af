#include "kinegraph/common/dynamic_library.h"

#include <dlfcn.h>

#include <utility>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

DynamicLibrary::DynamicLibrary(std::string name, std::string purpose)
    : name_(std::move(name)), purpose_(std::move(purpose)), handle_(dlopen(name_.c_str(), RTLD_NOW | RTLD_LOCAL)) {
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

}  // namespace kinegraph
