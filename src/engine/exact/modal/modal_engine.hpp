// modal_engine.hpp: engine `exact` in modes. The cost of a step depends on the motion and hardly on the mesh.
//
//   start     unconstrained modes q = Phi^T M u,  modes of the contact state z = Y q
//   advance   find an interval that provably contains no event; z at its end in closed form
//   event     q = X z,  u = Phi q
//
// The Taylor series of ExactEngine computes the other segments: those with forces that have no closed form in modes, and those
// whose modes are not accurate enough. These segments are counted, and a warning reports the first one.
#pragma once

#include "engine/exact/exact_engine.hpp"
#include "engine/exact/modal/modal_flow.hpp"

namespace signorini::modal {

/// Options of ModalEngine.
struct ModalOptions {
  SharedModalData* share = nullptr;              ///< data shared with a listener, or null
  bool peaks = true;                             ///< true: search for turning points of the contacts
  std::uint64_t step_seed = 0;                   ///< seed of random step lengths of the Taylor series
  std::optional<std::vector<int>> watched = {};  ///< entries of u for evaluate_watched(); nullopt: all
};

class ModalEngine final : public engine::Stepper, public engine::DenseOutput, private engine::FastModes {
 public:
  /// All arguments except t_end must outlive the object. Computes the unconstrained modes; if this fails, the Taylor series
  /// computes all segments.
  ModalEngine(const Model& model, const linear::SystemMatrices& structure, motion::StateSystems& systems,
              double t_end, const ModalOptions& use = {});

  void start(const engine::Segment& segment) override;
  [[nodiscard]] engine::Step advance() override;
  [[nodiscard]] engine::DenseOutput& dense_output() override { return *this; }
  /// Evaluates u, v and forces. Inside a step, the accelerations are omitted, which saves two thirds of the time.
  void evaluate(double t, motion::Point& point) override;
  void evaluate_watched(double t, std::optional<std::size_t> contact, motion::Point& point) override;
  void accelerate(double t, motion::Point& point) override;
  void set_energy(motion::Point& point) const override;
  void interpolate(double t, motion::Point& point) override;
  void integrate(double from, double to, motion::WorkIntegrals& works) override;
  [[nodiscard]] double residual() override;
  [[nodiscard]] double guard_error(const GuardForm& guard, const ContactMotion& motion,
                                   std::size_t contact) const override {
    return modal_ ? 0.0 : taylor_.guard_error(guard, motion, contact);
  }
  [[nodiscard]] engine::StepFacts facts() const override;
  /// The uncoupled modes that the engine uses. Null if the engine uses complex modes or no modes.
  [[nodiscard]] ModalSystem* modes() { return flow_ ? flow_->modes() : nullptr; }
  [[nodiscard]] engine::StepperReport report() override;

 private:
  [[nodiscard]] std::optional<engine::FastModeBound> fast_mode_bound(double omega) const override;
  [[nodiscard]] engine::FastModeBound term_sizes() const override;
  [[nodiscard]] double form_norm(const Combination& form) const override {
    return basis_.amplitudes_of(form).norm();
  }
  /// A part of a step, with the motion at its beginning.
  struct Part {
    double begin = 0.0, length = 0.0;
    ModalPoint at;
  };
  void warn_of_fallback(double t, const std::string& why);
  [[nodiscard]] engine::Step fall_back_to_series();
  [[nodiscard]] std::string start_modes(const engine::Segment& segment);
  [[nodiscard]] ModalPoint at(double t) const;
  [[nodiscard]] motion::StructureEnergy energy_of(const Vector& q, const Vector& rate) const;
  /// Amplitudes q of the unconstrained modes, their rates, and their accelerations (change; empty if not needed).
  struct Motion {
    Vector q, rate, change;
  };
  [[nodiscard]] Motion motion(const ModalPoint& z, bool accelerations) const;
  /// Some degrees of freedom and their rows of Phi.
  struct Rows {
    std::vector<int> dofs;
    RowMatrix shapes;
  };
  [[nodiscard]] Rows rows_of(std::vector<int> dofs) const;
  void fill(const ModalPoint& z, Motion&& motion, motion::Point& point);
  void fill_rest(const ModalPoint& z, const Motion& motion, motion::Point& point) const;
  void fill_rows(const Rows& rows, const ModalPoint& z, const Motion& motion, motion::Point& point) const;
  struct ZeroCrossing {
    double offset = 0.0, uncertainty = 0.0;  // time of the zero minus t_, and its error bound
  };
  [[nodiscard]] ZeroCrossing crossing_of(std::size_t slot, const motion::Point& point) const;
  [[nodiscard]] double refine_crossing(std::size_t slot, double begin_rest);
  void update_cancellation();
  void warn_of_touches(const Passage& passage, double begin);

  const Model& model_;
  const linear::SystemMatrices& structure_;
  std::shared_ptr<ModalCache::Entry> kept_;  // null if no ModalCache is used
  std::unique_ptr<UnconstrainedBasis> own_basis_;
  const UnconstrainedBasis& basis_;
  Rows watched_, contact_shape_rows_;
  std::unique_ptr<ModalFlow> flow_;  // null if there are no unconstrained modes
  exact::ExactEngine taylor_;
  events::TurningPointDetector turning_points_;
  bool peaks_;
  bool modal_ = false;
  long fallbacks_ = 0, steps_ = 0, proofs_ = 0, restarts_ = 0;
  engine::Segment segment_;
  std::vector<Part> parts_;  // parts of the last step
  ModalPoint now_;           // point at the end of the last step
  double t_ = 0.0;
  double rest_ = 0.0;  // exact time of now_ minus t_
  Vector q_, rate_;    // amplitudes and rates at the end of the last step
  motion::Point end_;
  // Largest norms |u|_M and |v|_M of the motion so far.
  double max_displacement_ = 0.0, max_velocity_ = 0.0;
  double cancellation_ = 1.0;  // see update_cancellation(); for the last step
  double works_end_ = 0.0;     // end of the interval of the last call of integrate()
  ModalPoint works_point_;
  bool has_works_ = false;
  LastTurningTimes last_turning_times_;  // turning points of the last step
  std::vector<double> turning_times_;
  int touches_ = 0;
};

}  // namespace signorini::modal
