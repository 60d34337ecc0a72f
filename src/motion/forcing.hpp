// forcing.hpp: everything that acts on the structure as a known function of time.
//
//   P(t) = sum_i d_i f_i(t),   q_k(t) compression of sliders,   s_k(t) motion of surfaces
//
// A Forcing holds the pieces in force on one side of an instant and continues them smoothly, so that an
// integrator that evaluates at a discontinuity sees the side that it came from.
#pragma once

#include "signorini/model.hpp"

namespace signorini {

enum class Side { before, after };

/// Taylor coefficients of a Forcing: rows of `count`, one a varying load, one a contact.
struct ForcingSeries {
  std::size_t count = 0;
  std::vector<double> loads, pressing, surface;
  std::vector<double> rounding;  ///< of each surface's velocity
  /// Contacts whose rows may hold more than zeros.
  std::vector<std::size_t> pressed, carried;
};

class Forcing {
 public:
  Forcing(const Model& model, double t, Side side);
  /// Nothing acts and nothing moves.
  [[nodiscard]] static Forcing none(const Model& model);
  /// The same pieces, on a part of the model: loads[i] and contacts[i] are the numbers in the whole of the part's. `more`, as
  /// long as the part, acts besides and does not change. Both models must outlive it.
  [[nodiscard]] Forcing on_part(const Model& part, const std::vector<int>& dofs,
                                const std::vector<std::size_t>& loads,
                                const std::vector<std::size_t>& contacts, const Vector& more) const;

  /// Of the forces of the model's contacts.
  [[nodiscard]] const ForceLayout& layout() const { return model_->layout; }
  /// P += factor times the derivative of the given order of the load vector; length n.
  void add_load(double t, int order, double* P, double factor = 1.0) const;
  /// Constant part of the load on a degree of freedom.
  [[nodiscard]] double standing_load(std::size_t dof) const { return constant_.data()[dof]; }
  /// P += the rest of it at t, of those loads alone whose numbers are `wanted`.
  template <class Wanted>
  void add_varying(double t, const Wanted& wanted, double* P) const;
  /// Coefficients scale^k / k! f^(k)(t), 0 <= k < count, of everything.
  void expand(double t, double scale, std::size_t count, ForcingSeries& out) const;
  /// P += coefficient k of the load vector.
  void add_load(const ForcingSeries& series, std::size_t k, double* P) const;
  /// The same, magnitudes of its terms: what loads that balance each other leave uncertain.
  void add_load_terms(const ForcingSeries& series, std::size_t k, double* P) const;
  /// False: no load acts.
  [[nodiscard]] bool loaded() const { return loaded_; }
  /// P(t) . v
  [[nodiscard]] double power(double t, const double* v) const;
  /// True while the surface of contact k is not at rest where it began.
  [[nodiscard]] bool moves(std::size_t k) const { return moves_[k]; }
  /// False: all loads, compressions and surfaces stand still.
  [[nodiscard]] bool varies() const { return varies_; }
  /// True while the compression or the surface of contact k changes.
  [[nodiscard]] bool drives(std::size_t k) const { return drives_[k]; }
  /// Greatest circular frequency in it, and in the motions of surfaces alone. Unit: rad per time.
  [[nodiscard]] double greatest_omega() const;
  [[nodiscard]] double surface_omega() const;
  /// Greatest degree of a polynomial in it.
  [[nodiscard]] std::size_t greatest_degree() const;
  /// Derivative of normal_force of contact k.
  [[nodiscard]] double pressing(std::size_t k, double t, int order) const {
    return presses_[k] ? pressing_[k]->value(t, order) : order == 0 ? still_pressing_[k] : 0.0;
  }
  /// Derivative of the motion of the surface of contact k (order 1: surface velocity).
  [[nodiscard]] double surface(std::size_t k, double t, int order) const {
    return moves_[k] ? surface_[k]->value(t, order) : order == 0 ? still_surface_[k] : 0.0;
  }
  /// Coefficients scale^j / j! s_k^(j)(t), j < count, of the motion of a surface.
  void expand_surface(std::size_t k, double t, double scale, std::size_t count, double* out) const {
    surface_[k]->taylor(t, scale, count, out);
  }
  /// So many coefficients say all of it on a step of up to a quarter of a radian: of a wave 0.25^13 / 13! is left.
  [[nodiscard]] std::size_t surface_terms(std::size_t k) const;
  /// Rounding of the surface velocity at t.
  [[nodiscard]] double surface_rounding(std::size_t k, double t) const;
  /// True while the compression of slider k is zero over an interval.
  [[nodiscard]] bool lifted(std::size_t k) const { return lifted_[k]; }

 private:
  explicit Forcing(const Model& model)
      : model_(&model), constant_(Vector::Zero(model.size())), constant_terms_(constant_) {}

  const Model* model_;
  Vector constant_, constant_terms_;  // the loads that do not change; sum of magnitudes
  std::vector<std::pair<std::size_t, const Piece*>> varying_;  // load, its piece
  std::vector<const Piece*> pressing_, surface_;
  std::vector<bool> lifted_, moves_, presses_, drives_;
  std::vector<std::size_t> pressed_, carried_;  // contacts whose compression, whose surface is not zero
  std::vector<double> still_pressing_, still_surface_;  // where nothing changes
  bool varies_ = false, loaded_ = false;
};

template <class Wanted>
void Forcing::add_varying(double t, const Wanted& wanted, double* P) const {
  for (const auto& [load, p] : varying_)
    if (wanted(load)) model_->loads[load].direction.add_to(P, p->value(t, 0));
}

}  // namespace signorini
