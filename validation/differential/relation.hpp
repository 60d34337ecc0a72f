// relation.hpp: a scene and another one whose answer follows from the first one's.
//
//   t' = s_t (t + later),      x'(t') = s_x x(t)       for t >= from
//
//   turned, mirrored, permuted, reversed      transform.hpp
//   shifted       all histories later by s, from a start at rest: nothing happens before s
//   going on      from the state that a run in a directory has kept at t1: the rest of the whole
//   in units      other units of force, length and time, and a body beside that touches nothing
//   split         a compliant contact as two of half the stiffness, a member without mass as twice the
//                 elements, a spring as two of half the stiffness
//
//   for (const RelationKind& kind : relation_kinds)
//     if (const auto related = kind.of(scene, seed)) ...
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/quantities.hpp"
#include "signorini/result.hpp"
#include "signorini/scene.hpp"

namespace signorini::differential {

struct Related {
  std::string name;  ///< "shifted by 0.2"
  Scene scene;
  Factors factors = {};
  double later = 0.0;  ///< in the time of the first scene
  double from = 0.0;
  bool mirrored = false;
  bool same_steps = true;       ///< newmark: it stops nowhere else
  bool same_energy = true;      ///< nothing was added beside
  bool jumps_at_start = false;  ///< of loads at t = 0: before energies of the first run are counted
  std::map<std::string, std::string> twins = {};      ///< contacts that share what one contact takes
  std::map<std::string, double> output_factors = {};  ///< of the first scene's value, of the other's
  std::map<std::string, double> extreme_signs = {};   ///< of extremes beside a column of magnitudes
  std::vector<OutputExtremes> extremes_before = {};   ///< of what happened before `from`; of the
                                                      ///< rest before `later`, which the first one has not
};

struct RelationKind {
  const char* name;
  std::optional<Related> (*of)(const Scene& scene, std::uint64_t seed);
};

/// Nothing where the relation does not apply to the scene.
[[nodiscard]] std::optional<Related> related_turned(const Scene& scene, std::uint64_t seed);
[[nodiscard]] std::optional<Related> related_mirrored(const Scene& scene, std::uint64_t seed);
[[nodiscard]] std::optional<Related> related_permuted(const Scene& scene, std::uint64_t seed);
[[nodiscard]] std::optional<Related> related_reversed(const Scene& scene, std::uint64_t seed);
/// newmark: by a multiple of dt.
[[nodiscard]] std::optional<Related> related_shifted(const Scene& scene, std::uint64_t seed);
/// Runs the first part into a directory of its own, which is removed again.
[[nodiscard]] std::optional<Related> related_going_on(const Scene& scene, std::uint64_t seed);
/// The same at a given time; nothing where the run does not come so far.
[[nodiscard]] std::optional<Related> related_going_on_at(const Scene& scene, double at);
/// At the very time of an event.
[[nodiscard]] std::optional<Related> related_split_at_event(const Scene& scene, std::uint64_t seed);
/// The scene from a state at time `at` on.
[[nodiscard]] Scene going_on_from(Scene scene, double at, SavedState state);
/// Where atol and all capture velocities are given: else both follow from scales of the scene.
[[nodiscard]] std::optional<Related> related_in_units(const Scene& scene, std::uint64_t seed);
[[nodiscard]] std::optional<Related> related_split_contact(const Scene& scene, std::uint64_t seed);
[[nodiscard]] std::optional<Related> related_split_member(const Scene& scene, std::uint64_t seed);
[[nodiscard]] std::optional<Related> related_split_spring(const Scene& scene, std::uint64_t seed);

inline constexpr std::array relation_kinds = {
    RelationKind{"turned", related_turned},
    RelationKind{"mirrored", related_mirrored},
    RelationKind{"permuted", related_permuted},
    RelationKind{"reversed", related_reversed},
    RelationKind{"shifted", related_shifted},
    RelationKind{"going on", related_going_on},
    RelationKind{"in units", related_in_units},
    RelationKind{"contact split", related_split_contact},
    RelationKind{"member split", related_split_member},
    RelationKind{"spring split", related_split_spring},
};

/// What an output is measured in; of a combination: that of its first term.
[[nodiscard]] Unit unit_of(const Scene& scene, const OutputSpec& output);
/// Its sign where x turns into -x: -1 of rotations, V, M, T and slip.
[[nodiscard]] double mirror_sign(const Scene& scene, const OutputSpec& output);

}  // namespace signorini::differential
