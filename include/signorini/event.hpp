// event.hpp: a change of state of a contact: a row of events.csv.
//
//   x-  values just before the instant        x+  values just after everything that happens at it (`_after`)
//
// The types and the columns stand in one table each. What writes events.csv, reads it back, compares runs or
// documents them goes by these tables: a new column is a member, its row below, and the line in
// run/event_log.cpp that fills it; a new type a row, its rule in run/event_log.cpp, its colour in
// result/plot_parts.hpp.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <variant>

#include "signorini/contact.hpp"

namespace signorini {

enum class EventType { slip, stick, reversal, separation, contact, impact, time };

struct EventTypeName {
  EventType type;
  const char* name;     ///< as in events.csv
  const char* meaning;  ///< for the documentation
};

/// In the order of lists and tables; a type's row is at the place of its value.
inline constexpr std::array all_event_types = {
    EventTypeName{EventType::slip, "slip", "a contact that stuck begins to slide"},
    EventTypeName{EventType::stick, "stick", "a contact that slid comes to rest"},
    EventTypeName{EventType::reversal, "reversal", "slip turns into the opposite slip"},
    EventTypeName{EventType::separation, "separation", "a contact opens"},
    EventTypeName{EventType::contact, "contact", "a contact closes"},
    EventTypeName{EventType::impact, "impact",
                  "a hit of a rigid contact, whatever comes after it (`open` to `open` is a rebound)"},
    EventTypeName{
        EventType::time, "time",
        "a jump of a load: one row without a contact, and one with `from` = `to` for each contact whose "
        "forces jump without a change of state"},
};

[[nodiscard]] constexpr const char* to_string(EventType type) {
  return all_event_types[static_cast<std::size_t>(type)].name;
}

/// How many of the events counted by type are changes of a state, and not jumps of a load.
[[nodiscard]] inline long changes_in(const std::map<std::string, long>& by_type) {
  long sum = 0;
  for (const auto& [type, count] : by_type) sum += type == to_string(EventType::time) ? 0 : count;
  return sum;
}

/// For `time` rows without a contact only t counts (contact == -1).
struct Event {
  double t = 0.0;
  int contact = -1;  ///< index into Model::contacts
  EventType type = EventType::time;
  State from = State::open, to = State::open;  ///< of a law of one's own: its states (number_of)
  std::optional<double> gap;                   ///< absent for sliders
  double N = 0.0, T = 0.0, N_after = 0.0, T_after = 0.0;
  double vn = 0.0, vn_after = 0.0, vt = 0.0, vt_after = 0.0;
  std::optional<double> impulse_n, impulse_t;  ///< at hits of rigid contacts only
  /// dg/dt of the guard that fell, just before; empty where the load's jump changed the state.
  std::optional<double> guard_rate;
  /// How far t may be off, from one instant's error of the guard: delta / |g'|, or what higher derivatives
  /// give where the guard grazes. Errors carried along from earlier events are not in it.
  std::optional<double> t_uncertainty;
};

struct EventColumn {
  using Field = std::variant<double Event::*, std::optional<double> Event::*, int Event::*,
                             EventType Event::*, State Event::*>;
  const char* name;
  const char* unit;  ///< in units of force, length, time; "" without
  Field field;       ///< int: the contact, by name
  const char* meaning;
  bool of_contact = true;  ///< empty in rows without a contact
};

inline constexpr std::array event_columns = {
    EventColumn{"t", "time", &Event::t, "the instant", false},
    EventColumn{"contact", "", &Event::contact, "its name"},
    EventColumn{"event", "", &Event::type, "what happens: see the types below", false},
    EventColumn{"from", "", &Event::from, "the state before everything that happens at that instant"},
    EventColumn{"to", "", &Event::to, "the state after it"},
    EventColumn{"gap", "length", &Event::gap, "the gap; empty for sliders, which have none"},
    EventColumn{"N", "force", &Event::N, "the normal force just before"},
    EventColumn{"T", "force", &Event::T, "the friction force just before"},
    EventColumn{"N_after", "force", &Event::N_after, "the normal force just after"},
    EventColumn{"T_after", "force", &Event::T_after, "the friction force just after"},
    EventColumn{"vn", "length/time", &Event::vn, "the rate of the gap just before"},
    EventColumn{"vn_after", "length/time", &Event::vn_after, "the rate of the gap just after"},
    EventColumn{"vt", "length/time", &Event::vt, "the rate of the tangential motion just before"},
    EventColumn{"vt_after", "length/time", &Event::vt_after, "the rate of the tangential motion just after"},
    EventColumn{"impulse_n", "force time", &Event::impulse_n,
                ">= 0, pushes the body along the normal; at hits of rigid contacts only"},
    EventColumn{"impulse_t", "force time", &Event::impulse_t, "the same along the tangent"},
    EventColumn{
        "guard_rate", "of the guard / time", &Event::guard_rate,
        "dg/dt of the condition that failed (g, -N, fs abs(N) - s T, or the slip rate), just before; empty "
        "where a load's jump changed the state"},
    EventColumn{
        "t_uncertainty", "time", &Event::t_uncertainty,
        "how far `t` may be off because of it: the error of the condition divided by its rate, or what its "
        "higher derivatives give where it grazes; empty where `guard_rate` is"},
};

/// Name of the column that shows a member: event_column(&Event::t_uncertainty).
template <class Value>
[[nodiscard]] constexpr const char* event_column(Value Event::*field) {
  for (const EventColumn& column : event_columns)
    if (column.field == EventColumn::Field(field)) return column.name;
  return "";
}

}  // namespace signorini
