// patched_series.hpp: the motion on a step as a Taylor series, parts of which may be expanded about a later time.
//
//   u_i(x) = sum_k u_ik (x - o_i)^k,    same form for N and T;    x = (t - t_0)/s
//
// The series of the whole structure is expanded about t_0, so all o_i = 0. If an event changes the motion near some contacts,
// the series of the degrees of freedom there are expanded again about the event (motion/local_series.hpp). All other series
// stay valid.
#pragma once

#include <array>
#include <vector>

#include "engine/events/first_root.hpp"
#include "motion/contact_series.hpp"
#include "motion/local_series.hpp"
#include "motion/point.hpp"

namespace signorini::exact {

class PatchedSeries {
 public:
  explicit PatchedSeries(const Model& model);

  /// Series of the whole structure. The owner of this object fills `whole` and then calls set_complete().
  motion::Series whole;
  /// Call set_complete() after `whole` has been filled. degree: u, v, a and forces are complete up to this degree; at most
  /// max_root_degree.
  void set_complete(std::size_t degree);
  /// Replaces the series of the degrees of freedom and forces in `near` by expansions about x, valid on [x, x + reach].
  void patch(const motion::LocalSeries::LocalExpansion& near, double x, double reach);
  /// Calls ContactSeries::bound_rates(x) for all contacts: bounds their rates up to the distance x from the origin.
  void bound_rates(double x) {
    for (motion::ContactSeries& contact : contacts_) contact.bound_rates(x);
  }

  [[nodiscard]] std::size_t degree() const { return degree_; }
  [[nodiscard]] const std::vector<motion::ContactSeries>& contacts() const { return contacts_; }
  /// Origin o_i of each degree of freedom. Empty: all origins are zero.
  [[nodiscard]] const std::vector<double>& origins() const { return origins_; }

  /// Writes the coefficients of an expansion about x to `out`: whole.levels + 3 numbers for a degree of freedom, and
  /// whole.levels + 1 numbers for a force.
  void displacement(int dof, double x, double* out) const;
  void force(std::size_t slot, double x, double* out) const;

  /// Evaluates u, v and forces at the place x. evaluate_at() also evaluates the accelerations.
  void evaluate_without_accelerations(double x, motion::Point& point) const;
  void evaluate_at(double x, motion::Point& point) const;
  /// Evaluates u, v and forces of one contact only; the results are bitwise equal to those of the whole evaluation.
  void evaluate_without_accelerations(double x, std::size_t contact, motion::Point& point) const;

 private:
  [[nodiscard]] double origin_of(std::size_t dof) const { return origins_.empty() ? 0.0 : origins_[dof]; }
  void evaluate_patches(double x, motion::Point& point) const;

  const Model& model_;
  std::size_t degree_ = 0;
  // (k + 1)/s, and (k + 1) (k + 2)/s^2
  std::array<double, events::max_root_degree + 1> to_rate_{}, to_acceleration_{};
  std::vector<motion::ContactSeries> contacts_;
  std::vector<double> origins_, force_origins_;              // empty: all origins are zero
  mutable std::vector<double> dof_offsets_, force_offsets_;  // x - o_i; work arrays
};

}  // namespace signorini::exact
