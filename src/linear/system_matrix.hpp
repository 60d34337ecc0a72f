// system_matrix.hpp: the matrix of all linear solves of the engines.
//
//   | M w_a + C w_v + K w_u    n   t |   columns of the degrees of freedom carry weights
//   | rows of the contacts         . |   (acceleration, velocity, displacement) each
//
// The weights define the unknown of a column:
//   IDA                  dv with mass: (cj, 1, 1/cj),  du without mass: (0, cj, 1)
//   expansion in time    v' with mass, u' of damped and u of undamped massless degrees of freedom
//                        (motion/state_systems.hpp)
//   Newmark              (1, h/2, h^2/4)
//
// Order of unknowns and rows: the n degrees of freedom, then N_k and T_k of each contact in turn. The pattern
// is the union over all states, one for the whole run. Rigid contacts that constrain one motion together have
// the additional entries s z (D y)', so that forces are unique (linear/redundant_rows.hpp). If a degree of
// freedom represents a motion z without mass (linear/undamped_motion.hpp), its column is that of the motion:
// the sum of z_i times the columns that the degrees of freedom i would have with its weights.
#pragma once

#include <vector>

#include "contact/contact_states.hpp"
#include "contact/law.hpp"
#include "linear/klu.hpp"
#include "linear/redundant_rows.hpp"
#include "linear/system_matrices.hpp"
#include "linear/undamped_motion.hpp"

namespace signorini::linear {

/// Acceleration, velocity and displacement per unit of the unknown in a column.
struct Weights {
  double acceleration = 0.0, velocity = 0.0, displacement = 0.0;
};

/// Factor of a degree of freedom in a form; 0 if the form does not contain it.
[[nodiscard]] double component(const Combination& combination, int dof);

/// Entry of a contact's row in the column of a degree of freedom with these components of normal and tangent.
[[nodiscard]] inline double entry_of(const Form& f, double n, double t, const Weights& w) {
  return n * (f.gap * w.displacement + f.vn * w.velocity + f.an * w.acceleration) +
         t * (f.ut * w.displacement + f.vt * w.velocity + f.at * w.acceleration);
}

/// Rows of all contacts in a contact state.
[[nodiscard]] std::vector<Rows> rows_of(const Model& model, const contact::ContactStates& states);

class SystemMatrix {
 public:
  SystemMatrix(const Model& model, const SystemMatrices& structure);

  /// Fills and factors the matrix; weights: one for each degree of freedom. `fresh`: choose new pivots (after
  /// a state change). False: the matrix is singular.
  bool set(const std::vector<Rows>& rows, const std::vector<Weights>& weights, bool fresh,
           const std::vector<UndampedMotion>& undamped = {});
  /// b := A^-1 b, length size().
  void solve(double* b) { klu_.solve(b); }
  [[nodiscard]] const RedundantRows& redundant_rows() const { return shared_; }
  /// Shared forces in the rows that were set last.
  [[nodiscard]] const std::vector<SharedForces>& shared_forces() const { return in_force_; }
  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] const Klu& klu() const { return klu_; }

 private:
  struct ContactSlots {  // positions in values_ of the entries of one contact
    std::vector<int> dof;
    std::vector<double> n, t;                          // components at dof
    std::vector<std::size_t> normal_row, tangent_row;  // row of the contact, column dof
    std::vector<std::size_t> N_column, T_column;       // row dof, column of the force
    std::size_t NN, NT, TN, TT;
  };
  /// values_ of column `to` += factor times the entries that `from` has with these weights.
  void add_column(int to, int from, double factor, const Weights& weights, const std::vector<Rows>& rows);
  void add_shared(const std::vector<Rows>& rows);
  [[nodiscard]] std::size_t slot(int row, int column) const;

  int size_;
  const ForceLayout layout_;
  const SystemMatrices& structure_;
  RedundantRows shared_;
  std::vector<SharedForces> in_force_;
  bool united_;  // some columns also have the rows of others
  std::vector<std::int64_t> column_start_, row_;
  std::vector<std::size_t> structure_slot_;  // position of the structure's entry p
  std::vector<ContactSlots> contacts_;
  std::vector<std::size_t> unused_;  // diagonal of places without a force
  std::vector<double> values_;
  Klu klu_;
};

}  // namespace signorini::linear
