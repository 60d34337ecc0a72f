// verification_runs.hpp: comparison of a run of IDA with three runs of newmark and one of exact (verify.hpp).
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "study/verify/richardson.hpp"
#include "study/verify/verify.hpp"

namespace signorini::verify {

class VerificationRuns {
 public:
  static constexpr std::size_t runs = 3;

  /// The model must outlive the object.
  VerificationRuns(const Model& model, double t_end);

  /// Adds a run of newmark; only the last three runs are compared.
  void add(double dt_of_run, ObservedRun run);
  /// True if the sequence and the orders of the last three runs have settled, up to the end of IDA's certain sequence.
  [[nodiscard]] bool settled();
  /// Sets verdict, sentence, kinds and events of the result.
  void evaluate(Verification& result);

  ObservedRun ida;
  const Certificate* certificate = nullptr;
  std::optional<ObservedRun> exact;
  std::vector<ObservedRun> newmark;  ///< runs with the steps h, h/2, h/4
  std::vector<double> dt;

 private:
  /// A series of one quantity, with the rows of events or of output times at which it was taken.
  struct Series {
    std::string name;
    std::vector<StepTriple> values;
    std::vector<std::size_t> rows;
  };
  struct Kind {
    std::string name, unit;
    std::vector<Series> series;
    ConvergenceOrder order;
    double scale = 0.0;
  };
  /// Time up to which the three sequences of newmark are equal, and equal to IDA's sequence.
  struct Sequence {
    double until = 0.0;
    std::string reason;  ///< reason why the sequences differ after `until`; empty: they are equal to the end
    bool differs = false;      ///< true if IDA's sequence certainly differs from newmark's
    double exact_until = 0.0;  ///< time up to which exact's sequence equals IDA's
  };

  [[nodiscard]] Sequence sequence() const;
  [[nodiscard]] std::vector<Kind> kinds(double until) const;
  [[nodiscard]] Kind event_times(double until) const;
  /// Adds the series of all columns to their kinds.
  void add_column_series(double until, std::vector<Kind>& kinds) const;
  /// For each event of IDA, the time in another run of the event with the same number at the same contact.
  [[nodiscard]] std::vector<std::optional<double>> times_in(const certify::EventSequence& track) const;
  [[nodiscard]] std::vector<bool> rows_at_events(double until) const;
  [[nodiscard]] Observation observation(const Series& series, std::size_t i, bool is_event,
                                        const Extrapolation& extrapolated, std::size_t column) const;
  [[nodiscard]] VerifiedKind verified(const Kind& kind, Verification& result) const;
  void add_extremes(Verification& result) const;
  static void count(const Observation& o, const std::string& where, VerifiedKind& kind);
  void conclude(const Sequence& sequence, Verification& result) const;
  [[nodiscard]] std::string differences(const Verification& result) const;

  const Model& model_;
  double t_end_;
  std::vector<std::string> names_;
  std::vector<ObservedColumn> columns_;
};

}  // namespace signorini::verify
