// data_perturbation.hpp: perturbed copies of a model: every datum is changed by about one rounding error.
//
//   x -> x (1 + delta r),   delta = 1e-15,  |r| in [1/2, 1], the same r for M_ij and M_ji
//
// For a reduced model, the data of the structure are perturbed: the product x^T K y of two mode shapes changes by the
// rounding of its terms, which may cancel, so stiffnesses and shapes change (perturb_shapes). A static start is computed
// again from the perturbed data (perturbed_start). These data do not change: times of breakpoints, the
// initial state of touching contacts, displacements of other static starts, closed gaps, and zeros. So laws, contact
// states at the start and the symmetry of matrices are those of the model. The same seed gives the same result.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "signorini/model.hpp"

namespace signorini::certify {

/// Pseudo-random 1 or -1, a function of seed and number.
[[nodiscard]] double random_sign(std::uint64_t seed, std::uint64_t number);

/// Copy of the model with all data changed by about one rounding error.
[[nodiscard]] Model perturbed(const Model& model, std::uint64_t seed);

// Perturbation of the mode shapes of a reduced model by rounding errors of K.
//
//   x_i' = x_i + sum_j C_ij x_j,   C_ij = d_ij / (lambda_i m_j - K_jj),   lambda_i = K_ii/m_i, i with mass
//   d_ij = delta r_ij |x_i|^T |K| |x_j|,   r_ij = r_ji,   1/2 <= |r_ij| <= 1
//
// A rounding error of each entry of K couples two shapes by d; this does not change K_ii, but rotates the shapes. So the
// forms of contacts and loads and the initial state change. The shape of a soft motion of stiff members changes by ten
// thousand rounding errors. Shapes with nearly equal frequencies are not changed, because any two shapes in their plane
// are equivalent.

/// Perturbs the shapes of `model`, which must be reduced. coupling: delta r_ij, equal for (i, j) and (j, i).
void perturb_shapes(const std::function<double(Eigen::Index, Eigen::Index)>& coupling, Model& model);

// A static start of its own for perturbed data.
//
//   u0', T': equilibrium of the perturbed data in the contact states of the start (model/statics/start_refinement.hpp)
//   sliding points do not move:  T' = T kt'/kt + kt' t . (u0' - u0);   at the friction limit T' = s f' |N'|
//   n . (u0' - u0) = 0           for touching contacts without force
//
// The error of u0 is (condition number of K) * rounding error: ten million rounding errors if a frame stands on springs
// that are ten million times softer. Companions with the same initial state would not reveal this error, nor one that the
// start of the run has besides: so u0' balances the perturbed data by itself, and w contains the error of u0, too. The
// contact states of the start do not change.

struct PerturbedStart {
  Vector w;                    ///< change of u0
  std::vector<double> shears;  ///< T' of each contact
};
/// Change of the static start of `model` if its data become those of `near`, which has the same closed gaps. nullopt if
/// the start is not static, a contact has a sliding point or a curved surface, a motion has neither stiffness nor a
/// contact, or a contact state would change.
[[nodiscard]] std::optional<PerturbedStart> perturbed_start(const Model& model, const Model& near);

}  // namespace signorini::certify
