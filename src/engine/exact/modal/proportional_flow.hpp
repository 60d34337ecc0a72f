// proportional_flow.hpp: ModalFlow in the uncoupled modes of a contact state, for the damping alpha M.
//
//   z'' + alpha z' + L z = Y p,   q = X z           modal_system.hpp, modal_proof.hpp, modal_works.hpp
#pragma once

#include "engine/exact/modal/modal_flow.hpp"
#include "engine/exact/modal/modal_works.hpp"

namespace signorini::modal {

class ProportionalFlow final : public ModalFlow {
 public:
  /// All arguments except t_end must outlive the object.
  ProportionalFlow(const Model& model, const UnconstrainedBasis& basis, double t_end);

  [[nodiscard]] std::string start(const engine::Segment& segment, const Vector& q, const Vector& rate,
                                  ModalPoint& now) override;
  [[nodiscard]] Passage pass(const ModalPoint& at, double remaining) override {
    return proof_.pass(at, remaining);
  }
  void rearm(const ModalPoint& at) override { proof_.rearm(at); }
  void advance(const ModalPoint& from, double time, ModalPoint& to) const override {
    oscillators_.advance(from, forces_, time, to);
  }
  void motion(const ModalPoint& at, Vector& q, Vector& rate, Vector* change) const override;
  void forces(const ModalPoint& at, motion::Point& point) const override;
  [[nodiscard]] double slope(std::size_t slot, const ModalPoint& at, const motion::Point& point,
                             double t) const override;
  [[nodiscard]] double magnitude(std::size_t slot, const ModalPoint& at) const override {
    return proof_.magnitude(slot, at);
  }
  void find_turning_points(const ModalPoint& from, double begin, double length, bool observed,
                           events::TurningPointDetector& turning, LastTurningTimes& turns) override;
  void add_works(const ModalPoint& from, const ModalPoint& to, double time,
                 motion::WorkIntegrals& works) const override {
    works_.add(proof_, from, to, time, works);
  }
  [[nodiscard]] std::optional<engine::FastModeBound> fast_mode_bound(const ModalPoint& from, double time,
                                                                     double omega) const override;
  [[nodiscard]] ModalSystem* modes() override { return &system_; }
  [[nodiscard]] double eigenvector_condition() const override {
    return state_ ? state_->spectrum.condition() : 1.0;
  }
  [[nodiscard]] long states_made() const override { return system_.made(); }

 private:
  [[nodiscard]] std::string unsupported_reason(const engine::Segment& segment);

  const Model& model_;
  const double t_end_;
  ModalSystem system_;
  ModalProof proof_;
  ModalWorkIntegrals works_;
  const engine::Segment* segment_ = nullptr;
  std::shared_ptr<const StateModes> state_;  // keeps the modes alive while proof_ and works_ refer to them
  Oscillators oscillators_;
  Amplitudes forces_;
};

}  // namespace signorini::modal
