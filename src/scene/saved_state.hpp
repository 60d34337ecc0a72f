// saved_state.hpp: states that a run saves in states.csv, with all data needed to continue the motion.
//
//   t,A.ux,A.uy,...,A.vx,A.vy,...,first.T,first.state
//   1.2,0.0103,...
//
// Columns in addition to displacements and velocities, for a support B and a contact c:
//   "support B.uy", "support B.vy"   moving supports      "c.T", "c.state"      contacts with friction
//   "c.slip"                         shear elements       "c.own", "c.memory"   user laws
//   "c.surface"                      moving surfaces
// A column "x.state" that contains numbers belongs to a degree of freedom named "x.state".
#pragma once

#include <filesystem>
#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "signorini/scene.hpp"

namespace signorini::scene {

/// Name in SavedState::motions of the mass-proportional Rayleigh factor in use, 1/time. With alpha_over_omega1, omega1
/// refers to the contacts that were closed at the start of the first run.
inline constexpr const char* saved_alpha = "alpha";

/// Value of `name` in SavedState::motions; nullopt if the state has no such value.
[[nodiscard]] std::optional<double> saved_motion(const SavedState& state, const std::string& name);

struct SavedStates {
  std::optional<SavedState> state;
  std::vector<std::string> times;  ///< times of all states, as written in the file
};

/// Reads the state at t, or the last state without t. Errors: SceneError at the line of the file; `key` begins the
/// message.
[[nodiscard]] SavedStates read_saved_states(std::istream& in, const std::string& file, const std::string& key,
                                            std::optional<double> t);

// States of the contacts at the end of a run, from contacts.csv.
//
//   t,contact,state,gap,ut,vt,slip,N,T   further columns are ignored
//
// A continued motion does not depend on these rows; the law checker compares the motion with them
// (src/law_check).

/// Rows of contacts.csv at time t; empty if there are none, or if the file is not the contacts.csv of a run.
[[nodiscard]] std::vector<SavedState::FinalContact> read_final_contacts(const std::filesystem::path& path,
                                                                        double t);

// The file geometric.csv: the forces whose stiffness acted in a run with run.geometric.
//
//   what,from,to,N_from,N_to,stiffness
//   member,A,A-B.1,-12.5,-12.25,
//   rigid,block,,,,-98.1
//
// The file has one row for each finite element and each rigid body, in model order. read_prestress() reads it
// for a continued run.

inline constexpr const char* prestress_file = "geometric.csv";
/// Heading of geometric.csv.
[[nodiscard]] const std::vector<std::string>& prestress_columns();

/// Reads geometric.csv; nullopt if it does not exist. Errors: SceneError at the line of the file; `key` begins the
/// message.
[[nodiscard]] std::optional<Prestress> read_prestress(const std::filesystem::path& path,
                                                      const std::string& key);

}  // namespace signorini::scene
