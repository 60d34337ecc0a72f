#include "signorini/error.hpp"

#include <fmt/core.h>

namespace signorini {

namespace {

std::string scene_message(const SourcePlace& place, const std::string& key, const std::string& message) {
  std::string text = place.file;
  if (place.line > 0) text += fmt::format(":{}", place.line);
  if (place.line > 0 && place.column > 0) text += fmt::format(":{}", place.column);
  if (!text.empty()) text += ": ";
  if (!key.empty()) text += key + ": ";
  return text + message;
}

}  // namespace

SceneError::SceneError(const SourcePlace& place, const std::string& key, const std::string& message)
    : Error(ExitCode::scene, scene_message(place, key, message)) {}

}  // namespace signorini
