// laws.hpp: the laws of an instant, one function each; what they share.
//
//   W_k = (n, t)^T M^-1 (n, t) of one contact: what its own forces do to its own accelerations
//
// Every function adds what it finds to `found`.
#pragma once

#include <array>
#include <optional>

#include "witness/sight.hpp"

namespace signorini {

/// Engines re-arm a guard ten tolerances from its zero, and its terms are two. Times a tolerance.
inline constexpr double of_tolerance = 20.0;
/// Where no motion goes on, slip rates up to sixteen times the speeds that count as rest are taken as rest, too
/// (docs/theory.md, "Rigid contacts").
inline constexpr double with_slow_slips = 16.0;
/// A time is uncertain by t_uncertainty to first order; the rest of the motion's series, and a second guard at the same
/// instant, are given as much again. Chosen.
inline constexpr double of_uncertainty = 3.0;

namespace seen {
inline constexpr Unit force{1, 0, 0}, length{0, 1, 0}, velocity{0, 1, -1}, impulse{1, 0, 1},
    moment_impulse{1, 1, 1};
}

/// Accelerations by unit forces of a contact, where all its degrees of freedom have mass: of the structure, and its own.
struct OwnResponse {
  Vector by_n, by_t;
  double nn = 0.0, nt = 0.0, tt = 0.0;
};

/// What laws know of the model.
class Bench {
 public:
  Bench(const Model& model, const WitnessLimits& limits);
  ~Bench();
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  /// M^-1 x on degrees of freedom with mass, 0 elsewhere. Empty: M is not regular there.
  [[nodiscard]] Vector per_mass(const Vector& x) const;
  /// The greatest sqrt((M^-1)_ii), of translations and of rotations.
  [[nodiscard]] const std::array<double, 2>& lightness() const;
  /// Null: contact k acts where there is no mass.
  [[nodiscard]] const OwnResponse* own_response(std::size_t k) const;
  /// The greatest sum of the terms of M a + C v + K u and of contact forces: what forces that hold accelerations are differences of.
  [[nodiscard]] double balance(const WitnessedSide& side) const;
  [[nodiscard]] bool has_mass(int dof) const { return massive_[static_cast<std::size_t>(dof)]; }
  /// An acceleration that its forces may have held.
  [[nodiscard]] double pull(const InstantRecord& record, std::size_t k) const;
  /// Slower than this a contact that leaves may be taken as rest.
  [[nodiscard]] double slowest(const InstantRecord& record, std::size_t k) const;

  const Model& model;
  const WitnessLimits limits;

 private:
  struct Factor;
  std::vector<bool> massive_;
  std::unique_ptr<Factor> factor_;
  mutable std::vector<std::optional<OwnResponse>> responses_;
  mutable std::optional<std::array<double, 2>> lightness_;
};

/// The laws at one instant.
class Finder {
 public:
  Finder(const Bench& bench, const InstantRecord& record, std::vector<Violation>& found)
      : bench_(bench), model_(bench.model), record_(record), found_(found) {}
  void momentum();
  void captures();
  void restitution();
  void states();
  void transitions();
  void continuity();

 private:
  void add(int contact, const char* law, double value, double limit, const Unit& unit, bool grave);
  /// Velocities along n and t of a contact that was hit once, where its hit began and where it ended.
  struct Strike {
    double dg_before = 0.0, dg_after = 0.0, dut_after = 0.0;
    double unsure = 0.0;  // what captures have moved, before or after
  };
  /// Nothing: it was hit more than once, or beside it another was, or it acts where there is no mass.
  [[nodiscard]] std::optional<Strike> strike_of(std::size_t k, const Sight& before, const Sight& after) const;
  void restitution_of(std::size_t k, double greatest);
  void friction_impulse(std::size_t k, double greatest);
  void state_of(std::size_t k);
  void friction_of(std::size_t k, const Sight& m);
  void necessity(std::size_t k);
  void guard_of(const RecordedEvent& event);
  void friction_continuity(std::size_t k);
  [[nodiscard]] std::optional<Sight> as_before(std::size_t k) const;
  [[nodiscard]] bool jumps(std::size_t k) const;
  [[nodiscard]] bool moves_at_once(std::size_t k) const;
  [[nodiscard]] double zero_of(const SeenGuard& guard, const Contact& contact) const;
  [[nodiscard]] const RecordedEvent* event_of(std::size_t k) const;
  /// Rounding of forces that hold accelerations.
  [[nodiscard]] double force_noise() const;

  const Bench& bench_;
  const Model& model_;
  const InstantRecord& record_;
  std::vector<Violation>& found_;
  mutable std::optional<double> force_noise_;
};

}  // namespace signorini
