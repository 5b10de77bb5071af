#pragma once

#include <functional>
#include <string>

#include "kinegraph/viewer/config_viewer.h"

namespace kinegraph {

/// Loads a scene file into `config`, shows it, and shows it again whenever the file or one that it includes changes,
/// until q or Escape is pressed in the browser, or Enter on the terminal. Other keys: see WatchKeys. A file with a
/// mistake leaves the last good scene; the message is shown in the browser and given to `report`. `cancellation` is asked every
/// 20 ms and ends it. Where nobody can press a key (KINEGRAPH_HEADLESS is set), loads and shows once.
void watchFile(Config& config, ConfigViewer& viewer, const std::string& path,
               const std::function<void(const std::string&)>& report, const CancellationToken& cancellation);

}  // namespace kinegraph
