// ida_linear_solver.hpp: IDA's linear systems, condensed to one unknown for each degree of freedom.
//
//   | cj   -1          | |du|   |r1|        du = (dv + r1) / cj
//   | K  cj M + C  n t | |dv| = |r2|   =>   (cj M + C + K/cj) dv + n dN + t dT = r2 - K r1 / cj
//   | rows of contacts | |dF|   |r3|        du is eliminated from the contact rows in the same way
//
// r2 and r3 of the residual already contain the terms with r1/cj (engine/ida/ida_problem.hpp), so they are the right-hand side.
// With c contacts, the matrix has n + 2 c rows instead of 2 n + 2 c. For large structures with compliant contacts and a narrow
// band, the matrix has only n rows (linear/condensed_matrix.hpp).
#pragma once

#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

#include <optional>

#include "linear/condensed_matrix.hpp"
#include "linear/system_matrix.hpp"
#include "linear/undamped_motion.hpp"
#include "linear/unknowns.hpp"

namespace signorini::ida {

/// Indices of u, v, N and T in IDA's vector y: first u of all n degrees of freedom, then v of the degrees of freedom with mass,
/// then the forces of all contacts.
struct Layout {
  explicit Layout(const Model& model);

  int dofs = 0, massive = 0, forces = 0;
  ForceLayout contacts;
  /// Index in y of v_i; -1 for a degree of freedom without mass, whose velocity is u_i'.
  std::vector<int> velocity;
  [[nodiscard]] int normal(std::size_t contact) const { return force(contacts.normal(contact)); }
  [[nodiscard]] int tangent(std::size_t contact) const { return force(contacts.tangent(contact)); }
  /// Index in y of a contact force. place: index of this force among the forces of all contacts.
  [[nodiscard]] int force(std::size_t place) const { return dofs + massive + static_cast<int>(place); }
  [[nodiscard]] int size() const { return dofs + massive + forces; }
};

class IdaLinearSolver {
 public:
  IdaLinearSolver(const Model& model, const linear::SystemMatrices& structure, const Layout& layout);

  /// Sets the rows of new contact states. The next factorisation then chooses new pivots.
  void set_contact_states(const contact::ContactStates& states);
  void set_cj(double cj) { cj_ = cj; }
  [[nodiscard]] double cj() const { return cj_; }
  [[nodiscard]] bool factor();
  void solve(const double* b, double* x);
  [[nodiscard]] const std::vector<Rows>& rows() const { return rows_; }
  [[nodiscard]] const linear::RedundantRows& shared_rows() const { return matrix_.redundant_rows(); }
  /// Replaces the tangential row of a contact by its linearisation.
  void linearise(std::size_t contact, const Form& tangent) {
    rows_[contact].tangent = tangent;
    if (condensed_rows_) condensed_rows_->set_rows(contact, rows_[contact]);
  }
  [[nodiscard]] long factorisations() const {
    return matrix_.klu().factorisations + (condensed_ ? condensed_->factorisations : 0);
  }
  [[nodiscard]] long refactorisations() const { return matrix_.klu().refactorisations; }

  /// Creates SUNDIALS' handles of the matrix and of the solver. This object must outlive both.
  SUNMatrix make_matrix(SUNContext context);
  SUNLinearSolver make_solver(SUNContext context);

 private:
  const Model& model_;
  const Layout& layout_;
  const linear::Unknowns unknowns_;  // unknowns of the condensed system
  linear::SystemMatrix matrix_;
  std::optional<linear::CondensedRows> condensed_rows_;  // set if a condensed matrix saves time
  std::optional<linear::CondensedMatrix> condensed_;     // matrix of condensed_rows_
  bool uses_condensed_ = false;                          // the last factors are those of condensed_
  std::vector<Rows> rows_;
  std::vector<linear::Weights> weights_;
  // Degrees of freedom whose acceleration a contact row prescribes. solve() sets the prescribed values, because elimination
  // would add rounding errors.
  std::vector<linear::PrescribedDof> prescribed_dofs_;
  std::vector<double> held_;  // solution for each entry of prescribed_dofs_
  std::vector<double> rhs_;
  double cj_ = 1.0;
  bool fresh_ = true;
};

}  // namespace signorini::ida
