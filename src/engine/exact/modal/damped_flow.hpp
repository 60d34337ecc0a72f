// damped_flow.hpp: ModalFlow in the complex modes of a contact state, for linear laws and for histories in closed form.
//
//   motion: damped_motion.hpp, proof: damped_proof.hpp, works: damped_works.hpp
#pragma once

#include "engine/exact/modal/damped_pencil.hpp"
#include "engine/exact/modal/damped_proof.hpp"
#include "engine/exact/modal/damped_works.hpp"
#include "engine/exact/modal/modal_flow.hpp"

namespace signorini::modal {

class DampedFlow final : public ModalFlow {
 public:
  /// All arguments except t_end must outlive the object. kept: see DampedMotion.
  DampedFlow(const Model& model, const UnconstrainedBasis& basis, double t_end, DampedSystem* kept = nullptr)
      : motion_(model, basis, t_end, kept),
        proof_(motion_),
        works_(motion_),
        made_before_(motion_.system().made()) {}

  [[nodiscard]] std::string start(const engine::Segment& segment, const Vector& q, const Vector& rate,
                                  ModalPoint& now) override;
  [[nodiscard]] Passage pass(const ModalPoint& at, double remaining) override {
    return proof_.pass(at, remaining);
  }
  void rearm(const ModalPoint& at) override { proof_.rearm(at); }
  void advance(const ModalPoint& from, double time, ModalPoint& to) const override {
    motion_.advance(from, time, to);
  }
  void motion(const ModalPoint& at, Vector& q, Vector& rate, Vector* change) const override {
    motion_.motion(at, q, rate, change);
  }
  void forces(const ModalPoint& at, motion::Point& point) const override;
  [[nodiscard]] double slope(std::size_t slot, const ModalPoint& at, const motion::Point& /*point*/,
                             double /*t*/) const override {
    return proof_.slope(slot, at);
  }
  [[nodiscard]] double magnitude(std::size_t slot, const ModalPoint& at) const override {
    return proof_.magnitude(slot, at);
  }
  void find_turning_points(const ModalPoint& from, double begin, double length, bool observed,
                           events::TurningPointDetector& turning, LastTurningTimes& turns) override;
  void add_works(const ModalPoint& from, const ModalPoint& to, double /*time*/,
                 motion::WorkIntegrals& works) const override {
    works_.add(from, to, works);
  }
  [[nodiscard]] std::optional<engine::FastModeBound> fast_mode_bound(const ModalPoint& from, double time,
                                                                     double omega) const override {
    return motion_.fast_mode_bound(from, time, omega);
  }
  [[nodiscard]] double eigenvector_condition() const override { return motion_.eigenvector_condition(); }
  [[nodiscard]] SumTerms terms(const ModalPoint& at) const override { return motion_.terms(at); }
  [[nodiscard]] long states_made() const override { return motion_.system().made() - made_before_; }

 private:
  DampedMotion motion_;
  DampedProof proof_;
  DampedWorkIntegrals works_;
  long made_before_;
};

// Accuracy test of complex modes: a motion that is converted to modes and back must be unchanged.
//
//   | Re X y - q |,  | Re X L y - q' |   for   y = Y_q q + Y_r q',   relative to a motion of size 1

/// Tests the modes with a motion that satisfies the constraints and has an energy of about 1 in each mode. Sets round_trip, and
/// failure if the error is too large or the modes are nearly linearly dependent. The modes must refer to the rotated
/// coordinates of the pencil (DampedPencil::rotations()).
void test_round_trip(const DampedPencil& pencil, DampedModes& modes);

}  // namespace signorini::modal
