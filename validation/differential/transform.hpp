// transform.hpp: the same problem written in another way: its answer is the same, too.
//
//   turned      nodes, normals, tangents, springs, loads, gravity, initial values by an angle
//   mirrored    x -> -x, contacts keep their rule t = (ny, -nx): slip+ <-> slip-, T and vt change sign
//   permuted    nodes, members, masses, springs, supports, contacts, loads in another order
//   reversed    members from their other end
//   rescaled    other units of force, length and time ([matrices]: of force and time)
//   disturbed   no transformation: all data off by one rounding, which is what its answer is good for
//
//   const std::optional<Transformed> other = turned(scene, 0.5);
//   const Track same = mapped_back(run(build_model(other->scene), other->scene.run), *other, reference);
#pragma once

#include <cstdint>
#include <optional>

#include "differential/track.hpp"
#include "scene/quantities.hpp"
#include "signorini/scene.hpp"

namespace signorini::differential {

struct Transformed {
  std::string name;  ///< "turned by 30 degrees"
  Scene scene;
  Factors factors;  ///< of its units
  bool mirrored = false;
};

/// Angle in degrees. Nothing for [matrices], and where a support holds one translation of a node only unless
/// by a multiple of 90.
[[nodiscard]] std::optional<Transformed> turned(const Scene& scene, double degrees);
/// Nothing for [matrices], and for meshes, whose elements would be inside out.
[[nodiscard]] std::optional<Transformed> mirrored(const Scene& scene);
/// Nodes stay in order beside meshes, contacts beside seams, and where one touches at a static start without a force.
[[nodiscard]] Transformed permuted(const Scene& scene, std::uint64_t seed);
/// Nothing where there is no member.
[[nodiscard]] std::optional<Transformed> reversed(const Scene& scene);
/// Nothing for [matrices] and a factor of lengths other than 1.
[[nodiscard]] std::optional<Transformed> in_units(const Scene& scene, const Factors& factors);
/// Numbers times 1 + r eps, coordinates and components of vectors off by r eps of the structure's size or of
/// the vector's length; r in [-1, 1]. Times of the run stay.
[[nodiscard]] Scene disturbed(const Scene& scene, std::uint64_t seed);

/// A transformed run as one of the scene itself: times, forces, states, the order of contacts. Rows keep
/// their contacts only, at the times of the reference's.
[[nodiscard]] Track mapped_back(Track track, const Transformed& from, const Track& reference,
                                const Scene& scene);

}  // namespace signorini::differential
