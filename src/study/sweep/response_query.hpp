// response_query.hpp: results that a sweep extracts from every run: one column each.
//
//   max:NAME  min:NAME  abs:NAME      largest, smallest value, largest magnitude of an [[output]]
//   tmax:NAME  tmin:NAME  end:NAME    times of the maximum and the minimum; final value
//   residual:CONTACT                  slip at the end minus slip at the start
//   count:EVENT  count:EVENT@CONTACT  number of events of a type, at all contacts or one
//   impulse:CONTACT  impulse:CONTACT@2     largest impulse of the contact's landings, or impulse of the second landing
//
// A missing result is NaN, an empty cell: all results of a run that stops early, and landings that do not occur.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "signorini/result.hpp"

namespace signorini::sweep {

/// Events of one type, at all contacts or at one; in options EVENT or EVENT@CONTACT.
struct EventQuery {
  EventType type{};
  std::string contact;  ///< empty: all contacts

  [[nodiscard]] bool matches(const Event& event, const Model& model) const {
    if (event.type != type || contact.empty()) return event.type == type;
    return event.contact >= 0 && model.contacts[static_cast<std::size_t>(event.contact)].name == contact;
  }
};

/// Names of all event types, as options use them.
[[nodiscard]] std::vector<std::string> event_names();
/// Parses EVENT or EVENT@CONTACT; nullopt if EVENT is not an event type. option: beginning of error messages.
/// Errors: UsageError for an unknown contact.
[[nodiscard]] std::optional<EventQuery> parse_event_query(const std::string& option, const std::string& text,
                                                          const Model& model);

/// Checks that `name` is one of `known`. Errors: UsageError, OPTION: unknown WHAT "NAME", with similar names.
void check_known(const std::string& option, const char* what, const std::string& name,
                 const std::vector<std::string>& known);

template <class List>
[[nodiscard]] std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> names;
  for (const auto& item : list) names.emplace_back(item.name);
  return names;
}

struct ResponseQuery {
  enum class Kind { max, min, abs, tmax, tmin, end, residual, count, impulse } kind = Kind::max;
  std::string text;        ///< as given; also the name of the column
  std::string name;        ///< name of an output or a contact; for Kind::count empty: all contacts
  EventQuery event;        ///< only for Kind::count
  std::size_t number = 0;  ///< only for Kind::impulse: number of the landing, from 1; 0: the largest impulse

  [[nodiscard]] bool of_output() const { return kind <= Kind::end; }
};

/// Parses a query. Errors: UsageError that lists the model's names.
[[nodiscard]] ResponseQuery parse_query(const std::string& text, const Model& model);

/// Records a run's results for the queries.
class QueryRecorder : public Recorder {
 public:
  /// Both arguments must outlive the object.
  QueryRecorder(const std::vector<ResponseQuery>& queries, const Model& model);

  void event(const Event& event) override;
  void sample(const Sample& sample) override;

  /// Results, one per query; NaN if the run has none.
  [[nodiscard]] std::vector<double> values(const Report& report) const;
  /// Hash of contact, type and new state of all events in their order: equal for equal sequences of events.
  [[nodiscard]] std::string sequence() const;

 private:
  [[nodiscard]] double value(const ResponseQuery& query, std::size_t i, const Report& report) const;

  const std::vector<ResponseQuery>& queries_;
  const Model& model_;
  std::vector<double> counts_;                      // number of events, one per query
  std::uint64_t sequence_ = 14695981039346656037U;  // FNV-1a hash, with its standard initial value
  std::vector<double> first_slip_, last_slip_;      // slip at the start and at the end, one per contact
};

/// The unit of a query's result; empty if the result has no unit.
[[nodiscard]] std::string unit_of(const ResponseQuery& query, const Model& model);

}  // namespace signorini::sweep
