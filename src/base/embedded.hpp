// embedded.hpp: text files that are part of the program (scripts/embed.cmake makes them a source).
#pragma once

#include <span>
#include <string_view>

namespace signorini {

struct EmbeddedFile {
  std::string_view name, text;
};

/// Template scenes: src/cli/scenes.
[[nodiscard]] std::span<const EmbeddedFile> scene_templates();
/// Texts of the scene reference: src/cli/texts.
[[nodiscard]] std::span<const EmbeddedFile> reference_texts();
/// Parts of the page of `report`: src/report/page.
[[nodiscard]] std::span<const EmbeddedFile> page_parts();

}  // namespace signorini
