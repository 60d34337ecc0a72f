// forcing.hpp: all prescribed functions of time that act on the structure.
//
//   P(t) = sum_i d_i f_i(t),   q_k(t) compression of sliders,   s_k(t) motion of surfaces
//
// A Forcing contains the pieces that are valid on one side of an instant and continues them smoothly. So an
// integrator that evaluates it at a discontinuity gets the values of the side from which it approaches.
#pragma once

#include "signorini/model.hpp"

namespace signorini::motion {

enum class Side { before, after };

/// Taylor coefficients of a Forcing: rows of `count`, one for each varying load, one for each contact.
struct ForcingSeries {
  std::size_t count = 0;
  std::vector<double> loads, applied_normal_force, surface;
  std::vector<double> rounding;  ///< rounding of each surface's velocity
  /// Contacts whose rows may be nonzero.
  std::vector<std::size_t> loaded_contacts, moving_surfaces;
};

class Forcing {
 public:
  /// The pieces that are valid just before or just after t.
  Forcing(const Model& model, double t, Side side);
  /// A forcing without loads or prescribed motion.
  [[nodiscard]] static Forcing none(const Model& model);
  /// The same pieces on a part of the model. Load i of the part is loads[i] of the whole model, and likewise
  /// for contacts. `more`, with the length of the part, is an additional constant load. Both models must
  /// outlive the object.
  [[nodiscard]] Forcing on_part(const Model& part, const std::vector<int>& dofs,
                                const std::vector<std::size_t>& loads,
                                const std::vector<std::size_t>& contacts, const Vector& more) const;

  /// Layout of the forces of the model's contacts.
  [[nodiscard]] const ForceLayout& layout() const { return model_->layout; }
  /// P += factor times the derivative of the given order of the load vector; length n.
  void add_load(double t, int order, double* P, double factor = 1.0) const;
  /// Constant part of the load on a degree of freedom.
  [[nodiscard]] double constant_load(std::size_t dof) const { return constant_.data()[dof]; }
  /// P += the varying part of the load at t, from those loads i with wanted(i).
  template <class Wanted>
  void add_varying(double t, const Wanted& wanted, double* P) const;
  /// Coefficients scale^k / k! f^(k)(t), 0 <= k < count, of all loads, compressions and surfaces.
  void expand(double t, double scale, std::size_t count, ForcingSeries& out) const;
  /// P += coefficient k of the load vector.
  void add_load(const ForcingSeries& series, std::size_t k, double* P) const;
  /// Same with the magnitudes of the terms, to which the rounding error of loads that balance each other is
  /// relative.
  void add_load_terms(const ForcingSeries& series, std::size_t k, double* P) const;
  /// False: no load acts.
  [[nodiscard]] bool has_loads() const { return loaded_; }
  /// P(t) . v
  [[nodiscard]] double power(double t, const double* v) const;
  /// True unless the surface of contact k rests at its initial place.
  [[nodiscard]] bool surface_moves(std::size_t k) const { return moves_[k]; }
  /// False: all loads, compressions and surfaces are constant.
  [[nodiscard]] bool varies() const { return varies_; }
  /// True if the compression of contact k or the place of its surface varies with time.
  [[nodiscard]] bool is_driven(std::size_t k) const { return driven_[k]; }
  /// Greatest circular frequency in the forcing, and in the motions of surfaces alone. Unit: rad per time.
  [[nodiscard]] double max_omega() const;
  [[nodiscard]] double surface_omega() const;
  /// Greatest degree of a polynomial in the forcing.
  [[nodiscard]] std::size_t max_degree() const;
  /// Derivative of the given order of normal_force of contact k (order 0: its value).
  [[nodiscard]] double applied_normal_force(std::size_t k, double t, int order) const {
    return presses_[k]  ? applied_normal_force_[k]->value(t, order)
           : order == 0 ? constant_normal_force_[k]
                        : 0.0;
  }
  /// Derivative of the given order of the motion of the surface of contact k (order 1: surface velocity).
  [[nodiscard]] double surface(std::size_t k, double t, int order) const {
    return moves_[k] ? surface_[k]->value(t, order) : order == 0 ? constant_surface_[k] : 0.0;
  }
  /// Coefficients scale^j / j! s_k^(j)(t), j < count, of the motion of a surface.
  void expand_surface(std::size_t k, double t, double scale, std::size_t count, double* out) const {
    surface_[k]->taylor(t, scale, count, out);
  }
  /// Number of coefficients that represent a surface's motion on a step of up to a quarter of a radian. The
  /// relative remainder of a sine is then 0.25^13 / 13!.
  [[nodiscard]] std::size_t surface_terms(std::size_t k) const;
  /// Rounding error of the velocity of the surface of contact k at t.
  [[nodiscard]] double surface_rounding(std::size_t k, double t) const;
  /// True while the compression of slider k is zero over an interval.
  [[nodiscard]] bool is_unloaded(std::size_t k) const { return unloaded_[k]; }

 private:
  explicit Forcing(const Model& model)
      : model_(&model), constant_(Vector::Zero(model.size())), constant_terms_(constant_) {}

  const Model* model_;
  Vector constant_, constant_terms_;                           // constant loads; sums of their magnitudes
  std::vector<std::pair<std::size_t, const Piece*>> varying_;  // load and its piece
  std::vector<const Piece*> applied_normal_force_, surface_;
  std::vector<bool> unloaded_, moves_, presses_, driven_;
  // Contacts with nonzero compression; contacts with moving surface.
  std::vector<std::size_t> loaded_contacts_, moving_surfaces_;
  std::vector<double> constant_normal_force_, constant_surface_;  // used if the forcing is constant
  bool varies_ = false, loaded_ = false;
};

template <class Wanted>
void Forcing::add_varying(double t, const Wanted& wanted, double* P) const {
  for (const auto& [load, p] : varying_)
    if (wanted(load)) model_->loads[load].direction.add_to(P, p->value(t, 0));
}

}  // namespace signorini::motion
