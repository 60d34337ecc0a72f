#include "engine/ida/ida_linear_solver.hpp"

#include <nvector/nvector_serial.h>

#include <algorithm>

namespace signorini::ida {

Layout::Layout(const Model& model)
    : dofs(model.size()), forces(static_cast<int>(model.force_count())), contacts(model.layout) {
  for (const Dof& dof : model.dofs) velocity.push_back(dof.massless ? -1 : dofs + massive++);
}

IdaLinearSolver::IdaLinearSolver(const Model& model, const linear::SystemMatrices& structure,
                                 const Layout& layout)
    : model_(model),
      layout_(layout),
      unknowns_{static_cast<std::size_t>(layout.dofs), layout.contacts},
      matrix_(model, structure),
      weights_(static_cast<std::size_t>(layout.dofs)),
      rhs_(static_cast<std::size_t>(matrix_.size())) {
  if (linear::saves_factorisations(model, structure, matrix_.redundant_rows()))
    condensed_rows_ = linear::CondensedRows::create(model, structure, linear::CondensedMatrix::max_width);
  if (condensed_rows_) condensed_.emplace(*condensed_rows_);
}

void IdaLinearSolver::set_contact_states(const contact::ContactStates& states) {
  rows_ = linear::rows_of(model_, states);
  fresh_ = true;
  if (condensed_rows_) condensed_rows_->set_rows(rows_);
  prescribed_dofs_ = linear::prescribed_dofs(model_, rows_);
  held_.resize(prescribed_dofs_.size());
}

bool IdaLinearSolver::factor() {
  uses_condensed_ = condensed_ && condensed_->set({cj_, 1.0, 1.0 / cj_});
  if (uses_condensed_) return true;
  for (std::size_t i = 0; i < weights_.size(); ++i)
    weights_[i] =
        layout_.velocity[i] >= 0 ? linear::Weights{cj_, 1.0, 1.0 / cj_} : linear::Weights{0.0, cj_, 1.0};
  const bool ok = matrix_.set(rows_, weights_, fresh_);
  fresh_ = !ok;
  return ok;
}

void IdaLinearSolver::solve(const double* b, double* x) {
  const auto n = static_cast<std::size_t>(layout_.dofs), massive = static_cast<std::size_t>(layout_.massive);
  const bool all_massive = n == massive;
  if (all_massive) {
    std::copy(b + n, b + n + rhs_.size(), rhs_.data());
  } else {
    for (std::size_t i = 0; i < n; ++i) rhs_[i] = layout_.velocity[i] >= 0 ? b[layout_.velocity[i]] : b[i];
    std::copy(b + n + massive, b + massive + rhs_.size(), rhs_.data() + n);
  }
  const linear::Unknowns& at = unknowns_;
  for (std::size_t i = 0; i < held_.size(); ++i) {
    const linear::PrescribedDof& p = prescribed_dofs_[i];
    held_[i] =
        (p.normal * rhs_[at.normal(p.contact)] + p.tangent * rhs_[at.tangent(p.contact)]) / (cj_ * p.divisor);
  }
  uses_condensed_ ? condensed_->solve(rhs_.data()) : matrix_.solve(rhs_.data());
  for (std::size_t i = 0; i < held_.size(); ++i) rhs_[prescribed_dofs_[i].dof] = held_[i];
  const double step = 1.0 / cj_;
  if (all_massive) {
    for (std::size_t i = 0; i < n; ++i) x[i] = step * (rhs_[i] + b[i]);
    std::copy(rhs_.begin(), rhs_.end(), x + n);
    return;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const int v = layout_.velocity[i];
    if (v >= 0) {
      x[v] = rhs_[i];
      x[i] = step * (rhs_[i] + b[i]);
    } else {
      x[i] = rhs_[i];
    }
  }
  std::copy(rhs_.begin() + static_cast<std::ptrdiff_t>(n), rhs_.end(), x + n + massive);
}

SUNMatrix IdaLinearSolver::make_matrix(SUNContext context) {
  SUNMatrix matrix = SUNMatNewEmpty(context);
  matrix->content = this;
  matrix->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
  matrix->ops->zero = [](SUNMatrix) { return SUNMAT_SUCCESS; };
  matrix->ops->destroy = [](SUNMatrix m) { SUNMatFreeEmpty(m); };
  return matrix;
}

SUNLinearSolver IdaLinearSolver::make_solver(SUNContext context) {
  SUNLinearSolver solver = SUNLinSolNewEmpty(context);
  solver->content = this;
  solver->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  solver->ops->setup = [](SUNLinearSolver s, SUNMatrix) {
    return static_cast<IdaLinearSolver*>(s->content)->factor() ? SUNLS_SUCCESS : SUNLS_LUFACT_FAIL;
  };
  solver->ops->solve = [](SUNLinearSolver s, SUNMatrix, N_Vector x, N_Vector b, realtype) {
    static_cast<IdaLinearSolver*>(s->content)->solve(NV_DATA_S(b), NV_DATA_S(x));
    return static_cast<int>(SUNLS_SUCCESS);
  };
  solver->ops->free = [](SUNLinearSolver s) {
    SUNLinSolFreeEmpty(s);
    return static_cast<int>(SUNLS_SUCCESS);
  };
  return solver;
}

}  // namespace signorini::ida
