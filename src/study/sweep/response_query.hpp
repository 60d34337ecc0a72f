// response_query.hpp: what a sweep asks of every run: one column each.
//
//   max:NAME  min:NAME  abs:NAME      greatest, least, greatest magnitude of an [[output]]
//   tmax:NAME  tmin:NAME  end:NAME    when, and its value at the end
//   residual:CONTACT                  slip at the end less that at the start
//   count:EVENT  count:EVENT@CONTACT  how many events of a type, of all contacts or one
//   impulse:CONTACT  impulse:CONTACT@2     the greatest impulse of its landings, or that of the second one
//
// What a run has not come to, as the end of one that stopped, is no number: an empty cell.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "study/sweep/event_query.hpp"

namespace signorini {

struct ResponseQuery {
  enum class Kind { max, min, abs, tmax, tmin, end, residual, count, impulse } kind = Kind::max;
  std::string text;        ///< as given: the name of the column
  std::string name;        ///< of an output or a contact; count: empty for all
  EventQuery event;        ///< count
  std::size_t number = 0;  ///< impulse: of the landing, from 1; 0: the greatest

  [[nodiscard]] bool of_output() const { return kind <= Kind::end; }
};

/// Errors: UsageError, naming what the model has instead.
[[nodiscard]] ResponseQuery parse_query(const std::string& text, const Model& model);

/// Hears a run for the queries.
class Answers : public Recorder {
 public:
  /// Both must outlive it.
  Answers(const std::vector<ResponseQuery>& queries, const Model& model);

  void event(const Event& event) override;
  void sample(const Sample& sample) override;

  /// One a query; NaN where there is none.
  [[nodiscard]] std::vector<double> values(const Report& report) const;
  /// Of contacts, types and new states of all events in their order: equal for equal sequences.
  [[nodiscard]] std::string sequence() const;

 private:
  [[nodiscard]] double value(const ResponseQuery& query, std::size_t i, const Report& report) const;

  const std::vector<ResponseQuery>& queries_;
  const Model& model_;
  std::vector<double> counts_;                      // a query
  std::uint64_t sequence_ = 14695981039346656037U;  // FNV-1a
  std::vector<double> first_slip_, last_slip_;      // a contact
};

/// The unit of the answer, "" where it has none.
[[nodiscard]] std::string unit_of(const ResponseQuery& query, const Model& model);

}  // namespace signorini
