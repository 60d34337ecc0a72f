// rate_record.hpp: records events, rows and contact results together with their derivatives, in the scene's units.
//
//   peak of q:        at an extreme: derivative q_p, derivative of its time -(q'_p)/q''
//                     at an instant: derivative Dq, derivative of its time dt/dp
//   residual value:   the value at the last output time
#pragma once

#include <limits>

#include "run/forwarding_recorder.hpp"
#include "run/scene_units.hpp"
#include "sensitivity/tangent_run.hpp"

namespace signorini::sensitivity {

class RateRecord final : public TangentListener, public run::ForwardingRecorder {
 public:
  /// computed: the model in internal units; recorder: may be nullptr. All arguments must outlive the object.
  RateRecord(const Model& computed, const std::vector<ModelDerivative>& derivatives, Recorder* recorder,
             Sensitivities& result, bool losses);

  void sample(const TangentSample& sample, bool row, bool turn) override;
  void at_instant(const InstantMotion& motion, const std::vector<TangentState>& states) override;
  [[nodiscard]] bool exceeds(std::size_t contact, std::size_t which, double value) const override {
    return std::abs(value) > peaks_[contact][which].size;
  }

  void event(const Event& event) override;
  void sample(const Sample& sample) override;

  /// Adds peaks and residual values to the result, and with `losses` also losses and landings. The report of the result must
  /// already be set.
  void finish();

 private:
  /// Peak of one quantity of a contact, with its derivatives.
  struct Peak {
    double size = 0.0, value = 0.0, t = 0.0;
    bool turn = false;  // true: an extreme between instants
    std::vector<double> rates, t_rates;
  };
  /// A value that replaces the peak if its magnitude is larger.
  struct PeakCandidate {
    double value = 0.0;
    bool turn = false;
    std::vector<double> rates, t_rates;
  };
  void add_row(const TangentSample& sample);
  void add_energies(const TangentSample& sample, std::size_t parameter, std::vector<double>& row) const;
  void add_losses();
  void add_landings();
  void update_peak(std::size_t contact, std::size_t which, double t, PeakCandidate seen);
  void update_at_turning_point(const TangentSample& sample, std::size_t contact);
  void update_at_instant(const InstantMotion& motion, const std::vector<TangentState>& states,
                         std::size_t contact);
  [[nodiscard]] double factor(const Unit& of) const { return scene::factor_of(of, model_.unit); }

  const Model& model_;
  const std::vector<ModelDerivative>& derivatives_;
  Sensitivities& result_;
  const std::vector<TangentState>* states_ = nullptr;  // states after the last instant
  // Time and resolution of the last instant.
  double instant_ = -std::numeric_limits<double>::infinity(), resolution_ = 0.0;
  std::vector<std::array<Peak, 4>> peaks_;
  std::optional<LandingRecord> landings_;  // used only with losses
};

}  // namespace signorini::sensitivity
