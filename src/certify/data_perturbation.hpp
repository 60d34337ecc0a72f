// data_perturbation.hpp: a perturbed copy of a model: every datum is changed by about one rounding.
//
//   x -> x (1 + delta r),   delta = 1e-15,  |r| in [1/2, 1], the same r for M_ij and M_ji
//
// For a reduced model the perturbed data are those of the structure. The product x^T K y of two shapes
// changes by the rounding of its terms, which may cancel, so stiffnesses and shapes change (perturb_shapes).
// A static start follows its data if friction is below its limit (perturbed_start). Unchanged are: times of
// breakpoints, the initial state of touching contacts, displacements of other static starts, closed gaps, and
// zeros. So laws, states at the start and symmetry of the matrices are those of the model. The same seed
// gives the same model.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "signorini/model.hpp"

namespace signorini::certify {

/// Pseudo-random 1 or -1, the same for the same numbers.
[[nodiscard]] double random_sign(std::uint64_t seed, std::uint64_t number);

/// The model with all data changed by about one rounding.
[[nodiscard]] Model perturbed(const Model& model, std::uint64_t seed);

// Perturbation of a reduced model's shapes by roundings of K.
//
//   x_i' = x_i + sum_j C_ij x_j,   C_ij = d_ij / (lambda_i m_j - K_jj),   lambda_i = K_ii/m_i, i with mass
//   d_ij = delta r_ij |x_i|^T |K| |x_j|,   r_ij = r_ji,   1/2 <= |r_ij| <= 1
//
// A rounding of each entry of K couples two shapes by d, which leaves K_ii unchanged and rotates the shapes. So the
// forms of contacts, loads and the initial state change; the structure is the same. If a soft motion consists of stiff
// members, its shape is off by ten thousand roundings. Shapes with nearly equal frequencies are unchanged: any two
// shapes of their plane are equivalent.

/// The model must be reduced; coupling: delta r_ij of a pair, the same for (i, j) and (j, i).
void perturb_shapes(const std::function<double(Eigen::Index, Eigen::Index)>& coupling, Model& model);

// Change of a static start by a perturbation of its data.
//
//   r = P - K u0 - sum_closed n N - sum_stuck t T
//   (K' + sum_closed kn' n' n'^T + sum_stuck kt' t' t'^T) w = r' - r
//   n' . w = 0                   for closed rigid contacts, and for touching contacts without force
//   T' = T kt'/kt + kt' t' . w   so that the sliding point is unchanged
//
// N = kn g for springs; for rigid contacts N is that of the start. T is initial_shear.
//
// The error of u0 is the condition of K times a rounding: ten million roundings if a frame stands on springs that are
// ten million times softer. Companions with the same initial state would not show this. The contact states of the start
// do not change.

struct PerturbedStart {
  Vector w;                    ///< change of near.u0
  std::vector<double> shears;  ///< T' of each contact
};
/// Change of the static start of `model` if its data become those of `near`, which has the same closed gaps.
/// nullopt if the start is not static, friction is at its limit or holds rigidly, the matrix is singular, or
/// a contact's state would change.
[[nodiscard]] std::optional<PerturbedStart> perturbed_start(const Model& model, const Model& near);

}  // namespace signorini::certify
