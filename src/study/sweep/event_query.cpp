#include "study/sweep/event_query.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "base/suggest.hpp"
#include "signorini/error.hpp"

namespace signorini {

std::vector<std::string> event_names() { return names_of(all_event_types); }

std::optional<EventQuery> parse_event_query(const std::string& option, const std::string& text,
                                            const Model& model) {
  const std::size_t at = text.find('@');
  const auto row = std::find_if(all_event_types.begin(), all_event_types.end(),
                                [&](const EventTypeName& type) { return text.substr(0, at) == type.name; });
  if (row == all_event_types.end()) return std::nullopt;
  EventQuery query{row->type, {}};
  if (at == std::string::npos) return query;
  query.contact = text.substr(at + 1);
  check_known(option, "contact", query.contact, names_of(model.contacts));
  return query;
}

void check_known(const std::string& option, const char* what, const std::string& name,
                 const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  throw UsageError(fmt::format("{}: unknown {} \"{}\"{}", option, what, name, suggestion(name, known)));
}

}  // namespace signorini
