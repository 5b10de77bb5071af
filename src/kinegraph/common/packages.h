#pragma once

#include <functional>
#include <string>

namespace kinegraph::inline common_internal {

/// Visits the folders that may be the ROS package `name`, in the order of the search, until `visit` returns true:
///
/// 1. `folder` and the folders above it, by the name of a subfolder, or as the package itself;
/// 2. the entries of KINEGRAPH_PACKAGE_PATH, ROS_PACKAGE_PATH and AMENT_PREFIX_PATH: ENTRY/name, ENTRY/share/name;
/// 3. all packages below these entries, and below a folder `src` above `folder`: the folders with a package.xml whose
///    <name> is `name`. As rospack does, the search does not enter packages, hidden folders, and folders with a file
///    CATKIN_IGNORE, COLCON_IGNORE, AMENT_IGNORE or rospack_nosubdirs.
///
/// Returns whether a visit returned true. Source: wiki.ros.org/rospack, "Crawling algorithm".
bool visitPackageFolders(const std::string& name, const std::string& folder,
                         const std::function<bool(const std::string& candidate)>& visit);

/// Returns the <name> in the package.xml of a folder, or "".
std::string packageNameOf(const std::string& folder);

}  // namespace kinegraph::inline common_internal
