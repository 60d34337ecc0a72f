// patched_series.hpp: the motion on a step as a series with locally updated parts, which have a later origin.
//
//   u_i(x) = sum_k u_ik (x - o_i)^k,    N and T likewise;    x = (t - t_0)/s
//
// A series of the whole structure is expanded about t_0, with o_i = 0. If an event changes the motion near
// some contacts, that part is expanded anew about the event (motion/local_series.hpp); the rest stays valid.
// Shapes: n degrees of freedom, two forces for each contact.
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

  /// Series of the whole structure, filled by the owner of this object, who then calls set_complete().
  motion::Series whole;
  /// Called once `whole` is filled: u, v, a and forces are complete up to this degree, max_root_degree at
  /// most.
  void set_complete(std::size_t degree);
  /// Replaces a part of the series on [x, x + reach].
  void patch(const motion::LocalSeries::LocalExpansion& near, double x, double reach);
  /// Bounds the rates of all contacts up to x from the origin: ContactSeries::bound_rates.
  void bound_rates(double x) {
    for (motion::ContactSeries& contact : contacts_) contact.bound_rates(x);
  }

  [[nodiscard]] std::size_t degree() const { return degree_; }
  [[nodiscard]] const std::vector<motion::ContactSeries>& contacts() const { return contacts_; }
  /// o for each degree of freedom. Empty: all are zero.
  [[nodiscard]] const std::vector<double>& origins() const { return origins_; }

  /// Writes the coefficients about x: whole.levels + 3 for a degree of freedom, whole.levels + 1 for a force.
  void displacement(int dof, double x, double* out) const;
  void force(std::size_t slot, double x, double* out) const;

  /// Evaluates all but accelerations; evaluate_at(): all.
  void evaluate_without_accelerations(double x, motion::Point& point) const;
  void evaluate_at(double x, motion::Point& point) const;
  /// Evaluates the degrees of freedom and forces of one contact, by the same sums.
  void evaluate_without_accelerations(double x, std::size_t contact, motion::Point& point) const;

 private:
  [[nodiscard]] double origin_of(std::size_t dof) const { return origins_.empty() ? 0.0 : origins_[dof]; }
  void evaluate_patches(double x, motion::Point& point) const;

  const Model& model_;
  std::size_t degree_ = 0;
  std::array<double, events::max_root_degree + 1> to_rate_{},
      to_acceleration_{};  // (k + 1)/s, (k + 1) (k + 2)/s^2
  std::vector<motion::ContactSeries> contacts_;
  std::vector<double> origins_, force_origins_;              // empty: all are zero
  mutable std::vector<double> dof_offsets_, force_offsets_;  // x - o; scratch
};

}  // namespace signorini::exact
