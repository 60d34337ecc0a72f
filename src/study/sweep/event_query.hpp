// event_query.hpp: events of one type, at all contacts or one, in options: EVENT, EVENT@CONTACT.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "signorini/result.hpp"

namespace signorini {

struct EventQuery {
  EventType type{};
  std::string contact;  ///< empty: all

  [[nodiscard]] bool meets(const Event& event, const Model& model) const {
    if (event.type != type || contact.empty()) return event.type == type;
    return event.contact >= 0 && model.contacts[static_cast<std::size_t>(event.contact)].name == contact;
  }
};

[[nodiscard]] std::vector<std::string> event_names();
/// nullopt if EVENT is not an event type. option: begins error messages. Errors: UsageError for an unknown contact.
[[nodiscard]] std::optional<EventQuery> parse_event_query(const std::string& option, const std::string& text,
                                                          const Model& model);

/// Errors: UsageError "OPTION: unknown WHAT "NAME"", with similar names.
void check_known(const std::string& option, const char* what, const std::string& name,
                 const std::vector<std::string>& known);

template <class List>
[[nodiscard]] std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> names;
  for (const auto& item : list) names.emplace_back(item.name);
  return names;
}

}  // namespace signorini
