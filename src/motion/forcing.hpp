// forcing.hpp: all prescribed functions of time that act on the structure, on one side of an instant.
//
//   P(t) = sum_i d_i f_i(t) loads,   q_k(t) applied normal forces of sliders,   s_k(t) motions of surfaces
//
// A Forcing contains the pieces that are valid on one side of an instant and continues them smoothly. So an integrator that
// evaluates the forcing exactly at a discontinuity gets the values of the side from which it approaches.
#pragma once

#include "signorini/model.hpp"

namespace signorini::motion {

enum class Side { before, after };

/// Taylor coefficients of a Forcing, in rows of `count` numbers: one row per varying load, one row per contact.
struct ForcingSeries {
  std::size_t count = 0;
  std::vector<double> loads, applied_normal_force, surface;
  std::vector<double> rounding;  ///< rounding error of the velocity of each contact's surface
  /// Contacts whose rows in applied_normal_force and in surface may be nonzero.
  std::vector<std::size_t> loaded_contacts, moving_surfaces;
};

class Forcing {
 public:
  /// Takes the pieces that are valid just before or just after t.
  Forcing(const Model& model, double t, Side side);
  /// A forcing without loads and without prescribed motion.
  [[nodiscard]] static Forcing none(const Model& model);
  /// The same pieces for a part of the model. Degree of freedom, load and contact i of the part are dofs[i], loads[i] and
  /// contacts[i] of the whole model. more: additional constant load on the part. Both models must outlive the object.
  [[nodiscard]] Forcing on_part(const Model& part, const std::vector<int>& dofs,
                                const std::vector<std::size_t>& loads,
                                const std::vector<std::size_t>& contacts, const Vector& more) const;

  /// Layout of the forces of the model's contacts.
  [[nodiscard]] const ForceLayout& layout() const { return model_->layout; }
  /// P += factor times the derivative of the given order of the load vector at t; P has length n.
  void add_load(double t, int order, double* P, double factor = 1.0) const;
  /// Constant part of the load on a degree of freedom.
  [[nodiscard]] double constant_load(std::size_t dof) const { return constant_.data()[dof]; }
  /// P += the varying part of the load at t, but only of loads i for which wanted(i) is true.
  template <class Wanted>
  void add_varying(double t, const Wanted& wanted, double* P) const;
  /// Computes the coefficients scale^k / k! f^(k)(t), 0 <= k < count, of all loads, applied normal forces and surfaces.
  void expand(double t, double scale, std::size_t count, ForcingSeries& out) const;
  /// P += coefficient k of the load vector, from the series.
  void add_load(const ForcingSeries& series, std::size_t k, double* P) const;
  /// P += the magnitudes of all terms of coefficient k of the load vector. The rounding error of loads that balance each other
  /// is relative to these magnitudes.
  void add_load_terms(const ForcingSeries& series, std::size_t k, double* P) const;
  /// True if some load acts.
  [[nodiscard]] bool has_loads() const { return has_loads_; }
  /// Power of the loads, P(t) . v
  [[nodiscard]] double power(double t, const double* v) const;
  /// True if the motion of the surface of contact k varies with time.
  [[nodiscard]] bool surface_moves(std::size_t k) const { return moves_[k]; }
  /// True if any load, applied normal force or surface varies with time.
  [[nodiscard]] bool varies() const { return varies_; }
  /// True if the applied normal force of contact k or the position of its surface varies with time.
  [[nodiscard]] bool is_driven(std::size_t k) const { return driven_[k]; }
  /// Largest circular frequency in the forcing. Unit: rad per time.
  [[nodiscard]] double max_omega() const;
  /// Largest circular frequency in the motions of surfaces. Unit: rad per time.
  [[nodiscard]] double surface_omega() const;
  /// Largest degree of a polynomial in the forcing.
  [[nodiscard]] std::size_t max_degree() const;
  /// Derivative of the given order of the applied normal force q of contact k at t (order 0: its value).
  [[nodiscard]] double applied_normal_force(std::size_t k, double t, int order) const {
    return normal_force_varies_[k] ? applied_normal_force_[k]->value(t, order)
           : order == 0            ? constant_normal_force_[k]
                                   : 0.0;
  }
  /// Derivative of the given order of the motion of contact k's surface at t (order 0: position, order 1: velocity).
  [[nodiscard]] double surface(std::size_t k, double t, int order) const {
    return moves_[k] ? surface_[k]->value(t, order) : order == 0 ? constant_surface_[k] : 0.0;
  }
  /// out[j] = scale^j / j! s_k^(j)(t) for j < count: Taylor coefficients of the motion s_k of contact k's surface.
  void expand_surface(std::size_t k, double t, double scale, std::size_t count, double* out) const {
    surface_[k]->taylor(t, scale, count, out);
  }
  /// Number of coefficients that represent a surface's motion on a step of up to a quarter of a radian, for which the
  /// relative remainder of a sine is 0.25^13 / 13!.
  [[nodiscard]] std::size_t surface_terms(std::size_t k) const;
  /// Rounding error of the velocity of contact k's surface at t.
  [[nodiscard]] double surface_rounding(std::size_t k, double t) const;
  /// True if contact k is a slider whose applied normal force is zero on the whole piece.
  [[nodiscard]] bool is_unloaded(std::size_t k) const { return unloaded_[k]; }

 private:
  explicit Forcing(const Model& model)
      : model_(&model), constant_(Vector::Zero(model.size())), constant_terms_(constant_) {}

  const Model* model_;
  Vector constant_, constant_terms_;  // constant loads; sums of the magnitudes of their terms
  std::vector<std::pair<std::size_t, const Piece*>> varying_;  // varying load and its present piece
  std::vector<const Piece*> applied_normal_force_, surface_;
  std::vector<bool> unloaded_, moves_, normal_force_varies_, driven_;
  // Contacts with a nonzero applied normal force; contacts whose surface is not at zero.
  std::vector<std::size_t> loaded_contacts_, moving_surfaces_;
  std::vector<double> constant_normal_force_, constant_surface_;  // values of pieces that are constant
  bool varies_ = false, has_loads_ = false;
};

template <class Wanted>
void Forcing::add_varying(double t, const Wanted& wanted, double* P) const {
  for (const auto& [load, p] : varying_)
    if (wanted(load)) model_->loads[load].direction.add_to(P, p->value(t, 0));
}

}  // namespace signorini::motion
