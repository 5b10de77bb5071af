#pragma once

// Eigen, and a check that the program and the library use it alike. All headers include Eigen through this one.
#include "kinegraph/common/compiler_check.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <kinegraph/build_check.h>
