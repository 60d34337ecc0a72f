// ida_engine.hpp: engine `ida`: takes IDA's steps and proves that no zero crossing of a guard inside a step is missed.
//
//   advance: a step of IDA -> polynomials of the guards on this step (step_history.hpp, active_guards.hpp)
//            -> first zero crossing, refined with forces recomputed from u and v (locate.hpp)
//
// The works are integrals of polynomials that interpolate the powers at the ends of the last steps.
#pragma once

#include "engine/events/active_guards.hpp"
#include "engine/events/graze_detector.hpp"
#include "engine/events/step_history.hpp"
#include "engine/ida/bdf_integrator.hpp"
#include "engine/ida/locate.hpp"
#include "engine/ida/short_flight.hpp"
#include "engine/stepper.hpp"
#include "motion/consistent_motion.hpp"

namespace signorini::ida {

class IdaEngine final : public engine::Stepper, public engine::DenseOutput {
 public:
  /// The first three arguments must outlive the object. flight_tolerances: factor on the tolerance of gaps. The product decides
  /// which flights are so low that a Taylor series computes them (short_flight.hpp).
  IdaEngine(const Model& model, const linear::SystemMatrices& structure, motion::StateSystems& systems,
            const engine::Tolerance& tolerance, int max_order, double t_end, double flight_tolerances);

  /// True if a Taylor series can compute short flights: no coefficient of friction depends on the slip rate or on N.
  [[nodiscard]] static bool follows_low_flights(const Model& model);

  void start(const engine::Segment& segment) override;
  [[nodiscard]] engine::Step advance() override;
  [[nodiscard]] engine::DenseOutput& dense_output() override { return *this; }
  void evaluate(double t, motion::Point& point) override;
  void accelerate(double t, motion::Point& point) override;
  void integrate(double from, double to, motion::WorkIntegrals& works) override;
  [[nodiscard]] double residual() override;
  [[nodiscard]] double guard_error(const GuardForm& guard, const ContactMotion& motion,
                                   std::size_t contact) const override;
  [[nodiscard]] engine::StepFacts facts() const override;
  [[nodiscard]] engine::StepperReport report() override;

 private:
  struct Located {
    std::size_t slot;
    double time;
  };
  /// A guard that began at zero, other than a closing gap.
  struct ZeroStartGuard {
    std::size_t slot;
    double tolerance;  // tolerance of the guard's value
    bool known;        // N, T, u and v determine the guard's change in a step
    double off;        // bound on the sum of the errors of all steps of the segment so far
  };
  [[nodiscard]] bool has_undamped_massless_parts() const;
  void fill(double t, const motion::Point& point, double* out);
  void restart_history(const motion::Jet& jet, const RestartOrder& past);
  [[nodiscard]] double flight_level(const Contact& contact, const Vector& u) const;
  [[nodiscard]] std::optional<Located> first_event(const BdfStep& step, double resolution);
  [[nodiscard]] bool opens_instead(const Located& slip, const Located& opening, double x, double h) const;
  [[nodiscard]] bool is_touch(std::size_t slot, double x) const;
  void add_zero_start_guard(std::size_t slot);
  void add_errors();
  [[nodiscard]] double error_bound_since_start(std::size_t slot) const;

  const Model& model_;
  motion::ConsistentMotion consistent_;
  motion::JetMaker jets_;
  const engine::Tolerance tolerance_;
  const double flight_tolerances_;
  motion::Powers powers_;
  std::vector<ContactMotion> motions_;  // of each contact at the point that fill() evaluates
  BdfIntegrator bdf_;
  HistoryTurningPoints turns_;
  events::StepHistory history_;
  events::GuardMonitor guard_monitor_;
  events::GrazeDetector graze_detector_;
  events::NearHitDetector near_hits_;
  std::vector<std::size_t> triggered_slots_;  // slots of the guards whose zero crossings ended the segment
  ShortFlight flights_;
  std::optional<engine::Step> flight_;  // step of a short flight; nullopt: IDA computes the segment
  engine::Segment segment_;
  motion::Jet jet_;  // complete jet, used if the jet of the decision is incomplete
  motion::Point point_;
  std::vector<double> integrals_;
  bool guards_need_accelerations_ = false;         // at least one guard needs accelerations
  bool makes_points_consistent_ = false;           // forces and accelerations are recomputed at each point
  std::vector<ZeroStartGuard> zero_start_guards_;  // in ascending order of slots
  bool touch_warned_ = false;                      // the warning about a touch was issued
};

}  // namespace signorini::ida
