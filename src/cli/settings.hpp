// settings.hpp: the option --set, which several subcommands share.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "signorini/scene.hpp"

namespace signorini::cli {

/// Adds --set PATH=VALUE to a subcommand; `settings` must outlive parsing.
void add_settings(CLI::App& command, std::vector<std::string>& settings);

/// Errors: UsageError for one without "=".
[[nodiscard]] std::vector<Override> overrides_of(const std::vector<std::string>& settings);

}  // namespace signorini::cli
