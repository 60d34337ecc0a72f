// system_matrix.hpp: the matrix of all linear systems that the engines solve.
//
//   | M w_a + C w_v + K w_u    n   t |   w_a, w_v, w_u: weights of acceleration, velocity and displacement,
//   | rows of the contacts         . |   one set for the column of each degree of freedom
//
// The weights define the unknown that belongs to a column:
//   IDA                  dv of a dof with mass: (cj, 1, 1/cj);  du of one without mass: (0, cj, 1)
//   expansion in time    acceleration of a dof with mass: (1, 0, 0); velocity of a damped massless one: (0, 1, 0);
//                        displacement of an undamped massless one: (0, 0, 1)     (motion/state_systems.hpp)
//   Newmark              (1, h/2, h^2/4)
//
// Order of unknowns and rows: the n degrees of freedom, then N_k and T_k contact by contact. The pattern is the union over
// all states, so it stays the same during a run. Rigid contacts that constrain the same motion have additional entries s z (D
// y)', which make forces unique (linear/redundant_rows.hpp). If a degree of freedom represents a massless motion z
// (linear/undamped_motion.hpp), its column is that of the motion: the sum of z_i times the columns of the degrees of freedom
// i, with the weights of the representing one.
#pragma once

#include <vector>

#include "contact/contact_states.hpp"
#include "contact/law.hpp"
#include "linear/klu.hpp"
#include "linear/redundant_rows.hpp"
#include "linear/system_matrices.hpp"
#include "linear/undamped_motion.hpp"

namespace signorini::linear {

/// Acceleration, velocity and displacement of a degree of freedom per unit of the unknown of its column.
struct Weights {
  double acceleration = 0.0, velocity = 0.0, displacement = 0.0;
};

/// Factor of a degree of freedom in a form; 0 if the form does not contain it.
[[nodiscard]] double component(const Combination& combination, int dof);

/// Entry of a contact's row in the column of a degree of freedom; n, t: components of this degree of freedom in normal and
/// tangent.
[[nodiscard]] inline double entry_of(const Form& f, double n, double t, const Weights& w) {
  return n * (f.gap * w.displacement + f.vn * w.velocity + f.an * w.acceleration) +
         t * (f.ut * w.displacement + f.vt * w.velocity + f.at * w.acceleration);
}

/// Rows of all contacts in these contact states.
[[nodiscard]] std::vector<Rows> rows_of(const Model& model, const contact::ContactStates& states);

class SystemMatrix {
 public:
  SystemMatrix(const Model& model, const SystemMatrices& structure);

  /// Fills and factors the matrix. weights: one per degree of freedom; fresh: choose new pivots (after a change of state).
  /// False: the matrix is singular.
  bool set(const std::vector<Rows>& rows, const std::vector<Weights>& weights, bool fresh,
           const std::vector<UndampedMotion>& undamped = {});
  /// b := A^-1 b; b has length size().
  void solve(double* b) { klu_.solve(b); }
  [[nodiscard]] const RedundantRows& redundant_rows() const { return shared_; }
  /// Shared forces of the rows that were set last.
  [[nodiscard]] const std::vector<SharedForces>& shared_forces() const { return in_force_; }
  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] const Klu& klu() const { return klu_; }

 private:
  struct ContactSlots {  // entries of one contact: positions in values_
    std::vector<int> dof;
    std::vector<double> n, t;                          // components of n and t at dof[i]
    std::vector<std::size_t> normal_row, tangent_row;  // row of the contact, column dof
    std::vector<std::size_t> N_column, T_column;       // row dof, column of the force
    std::size_t NN, NT, TN, TT;
  };
  /// Adds to column `to` of values_ `factor` times the entries that column `from` would have with these weights.
  void add_column(int to, int from, double factor, const Weights& weights, const std::vector<Rows>& rows);
  void add_shared(const std::vector<Rows>& rows);
  [[nodiscard]] std::size_t slot(int row, int column) const;

  int size_;
  const ForceLayout layout_;
  const SystemMatrices& structure_;
  RedundantRows shared_;
  std::vector<SharedForces> in_force_;
  bool
      has_united_columns_;  // true: the pattern of some columns contains the rows of other columns (Pattern::unite)
  std::vector<std::int64_t> column_start_, row_;
  std::vector<std::size_t> structure_slot_;  // position in values_ of entry p of the structure
  std::vector<ContactSlots> contacts_;
  std::vector<std::size_t> unused_;  // positions in values_ of the diagonal entries of places without a force
  std::vector<double> values_;
  Klu klu_;
};

}  // namespace signorini::linear
