// friction_series.hpp: friction that depends on the slip rate or on N, along a series of the motion.
//
//   T_k + s sum_(j = 0..k) f_j N_(k-j) = 0       f_j: contact/friction.hpp
//
// f_0 stands in the matrix of the system; what the higher ones do is known at level k, since p'_k is. A sliding point
// without mass (a shear element) has p'_k as an unknown of level k:
//
//   T_k + s f_0 N_k + f'(s p'_0) N_0 p'_k = -s sum' f_j N_(k-j)     sum': without what p'_k does to f_k
//
// and p'_0 follows from T_0 (contact/massless_slip.hpp). Where friction is at its greatest, or N_0 is zero, the point
// follows at once: its displacement is the unknown, and friction's coefficient stays.
//
// Of friction that depends on N, F'(|N_0|) stands in the matrix (contact/friction_limit.hpp):
//   T_k + s F' N_k = s ( F_k - F' |N|_k )
#pragma once

#include <optional>

#include "contact/friction.hpp"
#include "motion/series.hpp"

namespace signorini {

class FrictionSeries {
 public:
  /// At the beginning of a series whose u_0 and u_1 are known, u_1 where there is mass. s: direction of slip; contact
  /// number `index`; normal: its row.
  FrictionSeries(const Contact& contact, std::size_t index, int s, const Form& normal, const Series& series);

  [[nodiscard]] std::size_t contact() const { return index_; }
  /// The tangent row that stands in the matrix.
  [[nodiscard]] const Form& row() const { return row_; }
  /// What a point without mass moves by at once where N has fallen so far that friction does not hold it at any rate
  /// near its own; else zero. Unit: length.
  [[nodiscard]] double jump() const { return jump_; }
  /// Friction is at its greatest, the pull tells no rate, and how fast N grows depends on accelerations, by a dashpot: row() is
  /// that of a rate at which friction just reaches it.
  [[nodiscard]] bool doubtful() const { return doubtful_; }
  /// It follows at once instead: what accelerations say.
  void follow_at_once();
  /// Its rate along the slip, of a series in which it follows at once.
  [[nodiscard]] double rate_in(const Series& series) const { return sign_ * slip_rate(0, series); }
  [[nodiscard]] double greatest_rate() const;
  /// What else of the row is known; to be called for k = 0, 1, 2, ... in turn.
  [[nodiscard]] double known(int k, const Series& series);

 private:
  void begin_by_force(const Form& normal, const Series& series);
  void begin_massless(int s, const Form& normal, const Series& series);
  [[nodiscard]] double slip_rate(std::size_t k, const Series& series) const;

  const Contact* contact_;
  std::size_t index_;
  int sign_;
  Form row_;
  double jump_ = 0.0;
  bool constant_ = false;  // friction's coefficient stays
  bool doubtful_ = false;
  FrictionRecursion friction_;
  std::optional<LimitSeries> limit_;  // of friction that depends on N
};

}  // namespace signorini
