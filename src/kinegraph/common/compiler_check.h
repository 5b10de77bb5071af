#pragma once

// One clear error for compilers and flags with which the headers do not compile. The include ends the compilation.
#if __cplusplus < 202002L
#error "Kinegraph needs C++20: compile with -std=c++20 or newer (CMake: link the target kinegraph::kinegraph)"
#include <kinegraph/stop>
#elif !defined(__cpp_exceptions)
#error "Kinegraph reports mistakes by exceptions: compile without -fno-exceptions"
#include <kinegraph/stop>
#endif
