// ida_engine.hpp: engine `ida`: IDA's steps, and proof that no guard reaches zero unnoticed inside one.
//
//   advance: a step of IDA -> the guards' polynomials on it (step_history.hpp, active_guards.hpp) -> the first
//            zero crossing, refined with forces recomputed from u and v (locate.hpp)
//
// Works are integrals of the polynomials through the powers at the ends of steps.
#pragma once

#include "engine/events/active_guards.hpp"
#include "engine/events/near_events.hpp"
#include "engine/events/step_history.hpp"
#include "engine/ida/bdf_integrator.hpp"
#include "engine/ida/locate.hpp"
#include "engine/ida/short_flight.hpp"
#include "engine/stepper.hpp"
#include "motion/consistent.hpp"

namespace signorini {

class IdaEngine final : public Stepper, public DenseOutput {
 public:
  /// The first three arguments must outlive the object.
  IdaEngine(const Model& model, const Structure& structure, ModeSystems& systems, const Tolerance& tolerance,
            int max_order, double t_end, double flight_tolerances);

  /// True if friction is linear during short flights, so that their series can take them.
  [[nodiscard]] static bool follows_low_flights(const Model& model);

  void start(const Segment& segment) override;
  [[nodiscard]] Step advance() override;
  [[nodiscard]] DenseOutput& dense_output() override { return *this; }
  void evaluate(double t, Point& point) override;
  void accelerate(double t, Point& point) override;
  void integrate(double from, double to, Works& works) override;
  [[nodiscard]] double residual() override;
  [[nodiscard]] double guard_error(const GuardForm& guard, const ContactMotion& motion,
                                   std::size_t contact) const override;
  [[nodiscard]] StepFacts facts() const override;
  [[nodiscard]] StepperReport report() override;

 private:
  struct Located {
    std::size_t slot;
    double time;
  };
  /// A guard that began at zero, other than a closing gap.
  struct Touchable {
    std::size_t slot;
    double tolerance;  // tolerance of its value
    bool known;        // its change in a step follows from N, T, u and v
    double off;        // possible error of the steps so far
  };
  [[nodiscard]] bool follows_at_once() const;
  void fill(double t, const Point& point, double* out);
  void remember(const Jet& jet, const Rehearsal& past);
  [[nodiscard]] double lowest_flight(const Contact& contact, const Vector& u) const;
  [[nodiscard]] std::optional<Located> first_event(const BdfStep& step, double resolution);
  [[nodiscard]] bool opens_instead(const Located& slip, const Located& opening, double x, double h) const;
  [[nodiscard]] bool only_touches(std::size_t slot, double x) const;
  void add_touchable(std::size_t slot);
  void add_errors();
  [[nodiscard]] double allowance(std::size_t slot) const;

  const Model& model_;
  ConsistentMotion consistent_;
  JetMaker jets_;
  const Tolerance tolerance_;
  const double flight_tolerances_;
  Powers powers_;
  BdfIntegrator bdf_;
  HistoryTurns turns_;
  StepHistory history_;
  Watch watch_;
  Grazes grazes_;
  NearHits near_hits_;
  std::vector<std::size_t> fallen_;  // guards whose zero crossings ended the segment
  ShortFlight flights_;
  std::optional<Step> flight_;  // the step taken by a short flight
  Segment segment_;
  Jet jet_;  // whole jet, if the decision's jet is not
  Point point_;
  std::vector<double> integrals_;
  bool accelerations_ = false;        // at least one guard needs accelerations
  bool consistently_ = false;         // points of the segment are made consistent
  std::vector<Touchable> touchable_;  // ascending slots
  bool touched_ = false;              // the warning has been issued
};

}  // namespace signorini
