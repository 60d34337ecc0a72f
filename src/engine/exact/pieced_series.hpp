// pieced_series.hpp: the motion on a step as a series, parts of which begin later than the others.
//
//   u_i(x) = sum_k u_ik (x - o_i)^k,    N and T likewise;    x = (t - t_0)/s
//
// A series is made of the whole structure about t_0, o = 0. Where an event changes the motion near some contacts, their part
// is made anew about it (motion/near_series.hpp), and the rest goes on.
// Shapes: n degrees of freedom, two forces a contact.
#pragma once

#include <array>
#include <vector>

#include "engine/falls/first_fall.hpp"
#include "motion/contact_series.hpp"
#include "motion/near_series.hpp"
#include "motion/point.hpp"

namespace signorini {

class PiecedSeries {
 public:
  explicit PiecedSeries(const Model& model);

  /// Of the whole structure, to be made anew: its coefficients are its owner's until taken().
  Series whole;
  /// `whole` has been made: u, v, a and forces are complete up to this degree, most_fall_degree at most.
  void taken(std::size_t degree);
  /// The part of it from x on, up to `reach` further.
  void take_over(const NearSeries::Made& near, double x, double reach);
  /// Of all contacts, up to x from the origin: ContactSeries::bound_rates.
  void bound_rates(double x) {
    for (ContactSeries& contact : contacts_) contact.bound_rates(x);
  }

  [[nodiscard]] std::size_t degree() const { return degree_; }
  [[nodiscard]] const std::vector<ContactSeries>& contacts() const { return contacts_; }
  /// o, one a degree of freedom. Empty: all are zero.
  [[nodiscard]] const std::vector<double>& origins() const { return origins_; }

  /// The coefficients about x, whole.levels + 3 of a degree of freedom; whole.levels + 1 of a force.
  void displacement(int dof, double x, double* out) const;
  void force(std::size_t slot, double x, double* out) const;

  /// All but accelerations, and all.
  void place_at(double x, Point& point) const;
  void evaluate_at(double x, Point& point) const;
  /// Of the degrees of freedom and forces of one contact, the same sums.
  void place_at(double x, std::size_t contact, Point& point) const;

 private:
  [[nodiscard]] double origin_of(std::size_t dof) const { return origins_.empty() ? 0.0 : origins_[dof]; }
  void pieces_at(double x, Point& point) const;

  const Model& model_;
  std::size_t degree_ = 0;
  std::array<double, most_fall_degree + 1> to_rate_{}, to_acceleration_{};  // (k + 1)/s, (k + 1) (k + 2)/s^2
  std::vector<ContactSeries> contacts_;
  std::vector<double> origins_, force_origins_;      // empty: all are zero
  mutable std::vector<double> of_dofs_, of_forces_;  // x - o; room
};

}  // namespace signorini
