// relation_judge.hpp: does a related scene have the answer that follows from the first one's?
//
//   events     up to the end of both certain parts: the same of each contact, |t - t'| <= t_error + t_error'
//   rows       |x - x'| <= c max over earlier rows and neighbours of |x - x_n| + rounding
//   extremes   of outputs and of contacts' |N| and |T|, where both runs are certain to the end
//
// Neighbours of exact and newmark: every datum off by one rounding (transform.hpp); of ida: exact, and of laws
// that exact refuses rtol / 100, and 0.7 rtol; where newmark goes on, its steps are others: 0.5, 0.7 and 0.9 of the step. Rows within the errors
// of an event are left out of what jumps there.
#pragma once

#include <memory>

#include "differential/relation.hpp"
#include "differential/seen_run.hpp"

namespace signorini::differential {

struct Likeness {
  enum class Class {
    same,           ///< to the end, within all bounds
    ended_before,   ///< as long as both are certain
    other_order,    ///< the same but for the order of events closer than their errors
    stopped_alike,  ///< both refused, or both stopped at the same place
    too_long,       ///< given up
    undetermined,  ///< the start says that the data leave it open; or rigid contacts share a motion by friction, and one run is
    ///< refused for it, begins elsewhere or names other slips
    stopped_one_side,
    refused_one_side,
    understated,  ///< copies with every datum off by one rounding part as far: t_error, or the certain part, is too sharp
    unexplained
  } verdict = Class::same;
  std::string of;    ///< unexplained: "sequence", "time of an event", "row", "extreme", "peak"
  std::string what;  ///< contact or column, time, both values and the bound
  /// Of events: when the runs part, and by how much; infinite where their sequences do.
  struct Parting {
    double t = 0.0, off = 0.0;
  } at;
  double until = 0.0;
  double worst = 0.0;  ///< greatest difference over its bound
  std::size_t events = 0;
};
[[nodiscard]] const char* to_string(Likeness::Class verdict);
/// Nothing is wrong, or nothing could be compared.
[[nodiscard]] bool is_explained(Likeness::Class verdict);

/// One scene, computed once, against any number of related ones.
class RelationJudge {
 public:
  /// with_peaks: greatest |N| and |T| of contacts, too.
  RelationJudge(Scene scene, const Bounds& bounds, bool with_peaks = true);
  ~RelationJudge();
  [[nodiscard]] const Scene& scene() const;
  [[nodiscard]] const SeenRun& run() const;
  [[nodiscard]] Likeness compare(const Related& related) const;
  /// The same of a run that is there already: planted differences are noticed.
  [[nodiscard]] Likeness compare(const Related& related, SeenRun other) const;

 private:
  [[nodiscard]] Likeness compared(const Related& related, SeenRun other) const;
  struct Members;
  std::unique_ptr<Members> m_;
};

}  // namespace signorini::differential
