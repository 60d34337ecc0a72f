// bdf_integrator.hpp: SUNDIALS IDA on the first-order form.
//
//   0 = u' - v
//   0 = M v' + C v + K u - P(t) + sum_k ( n_k N_k + t_k T_k )
//   0 = rows of the contact states (two per contact)
//
// y = [u, v, N, T]. A degree of freedom without mass has no v and no first equation; u' is its velocity in the second equation,
// and the system has index 1. The contact rows of a segment stay in use until the next segment starts, even after an event.
// Guards are IDA's root functions: a guard is positive before its event, and IDA reports only downward crossings. The root
// function of a guard that is idle or not armed is +1.
#pragma once

#include <memory>

#include "engine/events/active_guards.hpp"
#include "engine/ida/restart_order.hpp"
#include "engine/stepper.hpp"
#include "engine/tolerance.hpp"

namespace signorini::ida {

/// A step of IDA. Guards may have further zero crossings in the step, which IDA does not report.
struct BdfStep {
  enum class Kind { accepted, root, failed } kind = Kind::accepted;
  double begin = 0.0, end = 0.0;  ///< ends of the accepted step
  double root = 0.0;              ///< Kind::root: time at which a guard reached zero, begin < root <= end
  std::vector<decide::TriggeredGuard> triggered;  ///< guards that reached zero; only for Kind::root
  double length = 0.0;                            ///< IDA's step length, without the rounding of end - begin
  int order = 1;                                  ///< degree of the solution's polynomial on the step
  std::string reason;                             ///< reason of the failure; only for Kind::failed
};

class BdfIntegrator {
 public:
  /// counters: receives the counts, which are complete after count().
  BdfIntegrator(const Model& model, const linear::SystemMatrices& structure,
                const engine::Tolerance& tolerance, int max_order, Counters& counters);
  ~BdfIntegrator();
  BdfIntegrator(const BdfIntegrator&) = delete;
  BdfIntegrator& operator=(const BdfIntegrator&) = delete;

  /// Starts a segment. jet: complete jet at the segment's beginning; watch: monitor that stores which guards are armed. Both
  /// must stay valid until the next start. Returns the steps that IDA has taken along the jet before the segment
  /// (restart_order.hpp).
  RestartOrder start(const engine::Segment& segment, const motion::Jet& jet,
                     const events::GuardMonitor& watch);
  [[nodiscard]] BdfStep advance();
  /// Interpolates u, v and forces at a time t of the last step.
  void evaluate(double t, motion::Point& point);
  /// Stores the correction of the last step: solution minus prediction. The local error is proportional to the correction; the
  /// factor is 1/(k + 1) for equal steps of order k.
  void keep_correction();
  /// N, T, gap, ut, vn and vt of a contact in the stored correction. Velocities of massless parts are not included.
  [[nodiscard]] ContactMotion correction(std::size_t contact) const;
  /// See DenseOutput::residual().
  [[nodiscard]] double residual();
  /// Adds IDA's counts since the last call to the counters.
  void count();

 private:
  struct Memory;
  Counters& counters_;
  std::unique_ptr<Memory> m_;
};

}  // namespace signorini::ida
