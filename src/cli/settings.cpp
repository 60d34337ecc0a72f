#include "cli/settings.hpp"

namespace signorini::cli {

void add_settings(CLI::App& command, std::vector<std::string>& settings) {
  command
      .add_option("--set", settings,
                  "change a key of the scene: run.rtol=1e-10, contacts.first.friction=0.5 (may be repeated)")
      ->option_text("PATH=VALUE")
      ->allow_extra_args(false);
}

std::vector<Override> overrides_of(const std::vector<std::string>& settings) {
  std::vector<Override> list;
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw UsageError("--set " + setting + ": expected path=value, such as run.rtol=1e-10");
    }
    list.push_back({setting.substr(0, equals), setting.substr(equals + 1)});
  }
  return list;
}

}  // namespace signorini::cli
