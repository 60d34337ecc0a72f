// ida_problem.hpp: residual, error weights and root functions for IDA, without state of the integrator.
//
//   r1 = u' - v,   r2 = M v' + C v + K (u - r1/cj) - P + n N + t T,   contact rows at u - r1/cj
//
// The condensed solver needs the terms with r1/cj on its right-hand side (engine/ida/ida_linear_solver.hpp). With these terms
// in the residual, a solve needs no additional product with K. The solution does not change, because r1 = 0 there.
#pragma once

#include "decide/guard_signs.hpp"
#include "engine/events/active_guards.hpp"
#include "engine/ida/ida_linear_solver.hpp"
#include "engine/stepper.hpp"
#include "engine/tolerance.hpp"
#include "linear/system_matrices.hpp"

namespace signorini::ida {

class IdaProblem {
 public:
  IdaProblem(const Model& model, const linear::SystemMatrices& structure, const engine::Tolerance& tolerance);

  void start(const engine::Segment& segment, const events::GuardMonitor& watch);

  /// Computes the residual r for cj = 1/step. step = 0: the terms with r1/cj are omitted.
  void residual(double t, double step, const double* y, const double* yp, double* r);
  /// Passes the linearised rows of contacts with rate-dependent friction to the linear solver.
  void linearise(double t, const double* y, const double* yp);
  /// Largest magnitude of an entry of the residual of the equation of motion. Unit: force.
  [[nodiscard]] double imbalance(double t, const double* y, const double* yp) const;
  /// Writes the error weights w of all unknowns: factor_ / tolerance. rate: 1/h of the last step, for rounding errors that grow
  /// with 1/h; 0 if no step length is known yet.
  void weights(const double* y, double rate, double* w) const;
  /// Writes the scaled guards, one for each slot; +1 for guards that are not armed and for slots without a guard.
  void guards(double t, const double* y, const double* yp, double* g) const;
  /// Writes y (derivative = 0) or y' (derivative = 1) at the time x after the jet's instant, from the Taylor polynomials of the
  /// jet.
  void evaluate_jet(const motion::Jet& jet, double x, int derivative, double* y) const;
  /// Writes the derivative y^(order) at the jet's instant.
  void fill(const motion::Jet& jet, std::size_t order, double* y) const;
  /// Reads u, v and forces from IDA's vectors.
  void read(const double* y, const double* yp, motion::Point& point) const;

  [[nodiscard]] const Layout& layout() const { return layout_; }
  [[nodiscard]] std::size_t slots() const { return layout_.contacts.guard_count(); }

  /// True if a contact slips in this segment and its friction rises with the slip rate.
  [[nodiscard]] bool has_rate_dependent_friction() const { return rate_dependent_; }

  /// N, T, gap, ut, vn and vt of a contact for the change `of` of the unknowns. vn and vt do not include the velocities of
  /// massless degrees of freedom, which are not unknowns.
  [[nodiscard]] ContactMotion change(std::size_t contact, const double* of) const;

  [[nodiscard]] IdaLinearSolver& linear() { return linear_; }

 private:
  void add_shared(const double* y, double* r) const;
  /// Motion of contact k at the displacements u - step (u' - v).
  [[nodiscard]] ContactMotion motion(std::size_t k, double t, const double* y, const double* yp,
                                     double step = 0.0) const;

  /// Vector view whose entry i is f(i, v), where v is the index of the velocity of degree of freedom i, or -1.
  template <class F>
  struct ByDof {
    const Layout& layout;
    F f;
    double operator[](int i) const {
      const auto dof = static_cast<std::size_t>(i);
      return f(dof, layout.velocity[dof]);
    }
  };
  template <class F>
  [[nodiscard]] ByDof<F> by_dof(F f) const {
    return {layout_, f};
  }

  /// Raises the tolerances of massless degrees of freedom, and of the contact forces on them, to the rounding of the forces
  /// that determine them.
  void widen_massless(const double* y, double* w) const;

  /// Lists the guards of the segment in watched_guards_.
  void list_watched_guards();
  /// Adds an entry to stopped_masses_ if a degree of freedom in the form has mass. force: index of the force in y.
  void add_stopped_mass(const Combination& form, int force);

  const Model& model_;
  const linear::SystemMatrices& structure_;
  Layout layout_;
  IdaLinearSolver linear_;
  const engine::Tolerance tolerance_;
  engine::Segment segment_;
  const events::GuardMonitor* guard_monitor_ = nullptr;
  // IDA's error norm is a mean over all unknowns, to which the few unknowns of contacts on a large structure contribute little.
  // So each contact has two groups of unknowns: N and T, and the u and v of its degrees of freedom. All other unknowns are one
  // more group. factor_ scales the weights so that an error of one group contributes like the same error in all unknowns.
  std::vector<double> factor_, atol_;
  std::vector<int> unused_;  // indices of unused forces in y
  // Data of a degree of freedom without mass. Forces K u determine its motion; after a long slide these forces are differences
  // of large numbers, with large rounding errors.
  struct Massless {
    int dof = 0;
    double stiffness = 0.0;                      ///< diagonal entry of K plus the springs of contacts
    std::vector<std::pair<int, double>> forces;  ///< contact forces on `dof`: index in y, |factor|
  };
  std::vector<Massless> massless_;
  // Constraint force that stops a mass m. The force corrects the rounding error of the velocity v within one step, so the error
  // of the force is m v eps / h. A smaller tolerance cannot be met, and a shorter step increases this error.
  struct StoppedMass {
    const Combination* form;
    int force;
    double mass;  ///< mass that the form moves, from the diagonal of M
  };
  std::vector<StoppedMass> stopped_masses_;
  /// A guard that IDA's root finder evaluates: any guard of the segment that contains no acceleration.
  struct WatchedGuard {
    std::size_t contact = 0, slot = 0;
    const GuardForm* guard = nullptr;
    decide::QuickForm form;  ///< linear part of the guard
    double unit = 1.0;       ///< a linear guard is divided by this unit, so that its values are of order 1
  };
  std::vector<WatchedGuard> watched_guards_;
  std::vector<linear::SharedForces> shared_;  // redundant rows in the contact states of this segment
  std::vector<std::size_t> nonlinear_;  // contacts in this segment that slip with rate-dependent friction
  bool rate_dependent_ = false;
  linear::StructuralForces structural_forces_;
  std::vector<double> forces_;  // forces on all degrees of freedom, if some have no mass
  std::vector<double> u_;       // displacements u - r1/cj in residual()
};

}  // namespace signorini::ida
