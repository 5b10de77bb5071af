#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/scene/config.h"
#include "kinegraph/viewer/shown_scene.h"

namespace kinegraph::inline viewer_internal {

/// Returns the client's page with embedded messages, which it shows from a file without a program. Script and messages
/// are compressed.
std::string recordedPage(const std::vector<Outgoing>& messages);

/// Writes a page of recordedPage or recordedScene to a file. With `client`, the path of a file with the script of all
/// such pages, the page loads its script from there instead of containing it. That file is written if it does not
/// exist. Throws FileError if a file cannot be written, and if `client` has another content.
void savePage(const std::string& page, const std::string& path, const std::string& client);

/// Appends a message to a stream of recorded ones: its time (float64, s), 0 (text) or 1 (binary) and its number of
/// bytes, as uint32, then the bytes, filled up to a multiple of 4.
void appendMessage(std::string& stream, double time, const Outgoing& message);

/// Appends the end of a recorded run.
void appendEnd(std::string& stream, double time);

/// Returns the content of a file with a recorded run, from a stream of messages.
std::string runFile(const std::string& stream);

/// Returns the page that plays the content of such a file. Throws ValueError for other content.
std::string runPage(std::string_view file);

/// The largest page in a notebook, bytes.
constexpr std::size_t kLargestInNotebooks = 580000;

/// Returns the page with the content of a scene. With `largest` > 0, merges close vertices of meshes until the page has
/// at most so many bytes, if that is possible.
std::string recordedPage(const ShownScene& scene, std::size_t largest = 0);

/// Returns the page with an embedded configuration and, optionally, a motion of it and the content of a program. Needs
/// no server. `largest`: see recordedPage.
std::string recordedScene(const Config& config, const ShownMotion* motion = nullptr,
                          const std::string& title = "Kinegraph", std::shared_ptr<PageContent> content = nullptr,
                          std::size_t largest = 0);

}  // namespace kinegraph::inline viewer_internal
