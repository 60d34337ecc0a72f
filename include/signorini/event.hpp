// event.hpp: an event, which is a change of a contact's state and a row of events.csv.
//
// Members without suffix are values just before the instant, members with the suffix `_after` are values just after all
// changes at the instant.
//
// all_event_types lists the event types, event_columns the columns of events.csv. All code that writes, reads, compares or
// documents events.csv uses these tables. A new column needs a member, a row in event_columns, and a line in
// run/event_log.cpp that fills the member. A new type needs a row in all_event_types, a rule in run/event_log.cpp, and a
// colour in result/plot_parts.hpp.
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
  const char* name;     ///< name in events.csv
  const char* meaning;  ///< text for the documentation
};

/// Event types in the order of lists and tables. The index of a row is the value of its EventType.
inline constexpr std::array all_event_types = {
    EventTypeName{EventType::slip, "slip", "a contact that stuck begins to slide"},
    EventTypeName{EventType::stick, "stick", "a contact that slid comes to rest"},
    EventTypeName{EventType::reversal, "reversal", "slip turns into the opposite slip"},
    EventTypeName{EventType::separation, "separation", "a contact opens"},
    EventTypeName{EventType::contact, "contact", "a contact closes"},
    EventTypeName{EventType::impact, "impact",
                  "a hit of a rigid contact, whatever its next state is (`open` to `open` is a rebound)"},
    EventTypeName{
        EventType::time, "time",
        "a jump of a load: one row without a contact, and one with `from` = `to` for each contact whose "
        "forces jump without a change of state"},
};

[[nodiscard]] constexpr const char* to_string(EventType type) {
  return all_event_types[static_cast<std::size_t>(type)].name;
}

/// Number of events that change a state; jumps of loads are not counted.
[[nodiscard]] inline long count_state_changes(const std::map<std::string, long>& by_type) {
  long sum = 0;
  for (const auto& [type, count] : by_type) sum += type == to_string(EventType::time) ? 0 : count;
  return sum;
}

/// One event. Rows of type `time` may have no contact (contact == -1); only t is meaningful in such a row.
struct Event {
  double t = 0.0;
  int contact = -1;  ///< index into Model::contacts
  EventType type = EventType::time;
  State from = State::open, to = State::open;  ///< built-in states, or states of a user law
  std::optional<double> gap;                   ///< absent for sliders, which have no gap
  double N = 0.0, T = 0.0, N_after = 0.0, T_after = 0.0;
  double vn = 0.0, vn_after = 0.0, vt = 0.0, vt_after = 0.0;
  std::optional<double> impulse_n, impulse_t;  ///< only for impacts of rigid contacts
  /// dg/dt, just before the instant, of the guard that reached zero; empty if a jump of a load changed the state.
  std::optional<double> guard_rate;
  /// Error bound of t from the error delta of the guard at this instant: delta / |g'|, or a bound by higher derivatives if
  /// the guard grazes zero. Errors carried over from earlier events are not included.
  std::optional<double> t_uncertainty;
  /// Only for a rigid contact that touched: ratio of the departure speed to the speed below which the contact stays closed.
  /// That speed is capture_velocity, or follows from the rounding error of the gap. A ratio above 1: the contact rebounded.
  /// Not a column of events.csv.
  std::optional<double> departure;
};

struct EventColumn {
  using Field = std::variant<double Event::*, std::optional<double> Event::*, int Event::*,
                             EventType Event::*, State Event::*>;
  const char* name;
  const char* unit;  ///< in units of force, length, time; "" for a plain number
  Field field;       ///< a field of type int is the index of a contact; the cell shows the contact's name
  const char* meaning;
  bool of_contact = true;  ///< true: the cell is empty in rows without a contact
};

inline constexpr std::array event_columns = {
    EventColumn{"t", "time", &Event::t, "time of the event", false},
    EventColumn{"contact", "", &Event::contact, "name of the contact"},
    EventColumn{"event", "", &Event::type, "type of the event, see below", false},
    EventColumn{"from", "", &Event::from, "the state before all changes at that instant"},
    EventColumn{"to", "", &Event::to, "the state after all changes at that instant"},
    EventColumn{"gap", "length", &Event::gap, "the gap; empty for sliders, which have none"},
    EventColumn{"N", "force", &Event::N, "the normal force just before"},
    EventColumn{"T", "force", &Event::T, "the friction force just before"},
    EventColumn{"N_after", "force", &Event::N_after, "the normal force just after"},
    EventColumn{"T_after", "force", &Event::T_after, "the friction force just after"},
    EventColumn{"vn", "length/time", &Event::vn, "rate of the gap just before"},
    EventColumn{"vn_after", "length/time", &Event::vn_after, "rate of the gap just after"},
    EventColumn{"vt", "length/time", &Event::vt, "rate of the tangential motion just before"},
    EventColumn{"vt_after", "length/time", &Event::vt_after, "rate of the tangential motion just after"},
    EventColumn{"impulse_n", "force time", &Event::impulse_n,
                "impulse along the normal, >= 0: pushes the body away; at hits of rigid contacts only"},
    EventColumn{"impulse_t", "force time", &Event::impulse_t,
                "impulse along the tangent; at hits of rigid contacts only"},
    EventColumn{
        "guard_rate", "of the guard / time", &Event::guard_rate,
        "dg/dt of the condition that failed (g, -N, fs abs(N) - s T, or the slip rate), just before; empty "
        "if a jump of a load changed the state"},
    EventColumn{
        "t_uncertainty", "time", &Event::t_uncertainty,
        "error bound of `t` at this event alone: error of the condition divided by its rate, or a bound from "
        "its higher derivatives where it grazes zero; empty where `guard_rate` is empty"},
};

/// Name of the column of events.csv that shows a member: event_column(&Event::t_uncertainty) is "t_uncertainty".
template <class Value>
[[nodiscard]] constexpr const char* event_column(Value Event::*field) {
  for (const EventColumn& column : event_columns)
    if (column.field == EventColumn::Field(field)) return column.name;
  return "";
}

}  // namespace signorini
