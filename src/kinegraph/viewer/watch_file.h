#pragma once

#include <functional>
#include <string>

#include "kinegraph/scene/config.h"
#include "kinegraph/viewer/config_viewer.h"

namespace kinegraph {

/// Loads a scene file into `config`, shows it, and reloads it whenever the file or an included one changes, until q or
/// Escape is pressed in the browser, or Enter on the terminal. Other keys: see WatchKeys. With an invalid file, the
/// last valid scene stays; the message appears in the browser and is passed to `report`. `cancellation` is checked
/// every 20 ms and ends the call. If KINEGRAPH_HEADLESS is set, so that no key can be pressed, it loads and shows once.
void watchFile(Config& config, ConfigViewer& viewer, const std::string& path,
               const std::function<void(const std::string&)>& report, const CancellationToken& cancellation);

}  // namespace kinegraph
