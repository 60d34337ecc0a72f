// check.hpp: what a scene holds, found by everything that a run does except its time loop.
//
//   read_scene -> build_model -> simulate, stopped after the first step        the same code as a run
//
// so a scene that passes can be run, and one that cannot be run is refused with the same words.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/modes/frequencies.hpp"
#include "run/effort.hpp"
#include "run/trial.hpp"
#include "signorini/model.hpp"
#include "signorini/result.hpp"

namespace signorini {

/// Of the scene, parts that supports hold included; node scenes only.
struct MassFacts {
  double total = 0.0;
  double x = 0.0, y = 0.0;                ///< centre
  double moving_x = 0.0, moving_y = 0.0;  ///< r M r of a unit translation of all that is not fixed
};

/// Stiffness of a contact's spring against that of all the rest at its place: 1 / (a . K_rest^-1 a), K_rest
/// the structure with all other springs of contacts. 0: nothing else resists there.
struct StiffnessRatio {
  int contact = 0;
  bool normal = true;
  double stiffness = 0.0, rest = 0.0;
};

/// Where a load, a compression or a surface velocity is not smooth, in [0, t_end].
struct Discontinuity {
  double t = 0.0;
  bool jump = false;  ///< else a kink
  std::string what;   ///< "load 1", "normal_force of contact 'pad'"
};

/// Of the time loop, by order of magnitude.
struct Cost {
  long unknowns = 0;
  double omega_max = 0.0;  ///< of the structure with its contacts stuck, and of harmonic loads
  Effort effort;
  std::optional<double> exact;  ///< seconds that exact would take instead of ida, by the same rule
  std::vector<Trial> trials;    ///< measured, where measure_cost() was asked; none else
};

/// Of the structure as the scene has it, also where the run is to use a reduced model of it; frequencies,
/// free motions and stiffness, too.
struct CheckReport {
  long degrees_of_freedom = 0, massless = 0;
  std::optional<MassFacts> mass;
  double least_mass = 0.0, greatest_mass = 0.0;  ///< on the diagonal of M, zeros left aside
  std::vector<ContactSample> contacts;           ///< right after t = 0
  std::vector<std::string> warnings;             ///< of the run, and what may be a mistake
  std::vector<std::string> free_motions;  ///< of the structure on its closed contacts, and what holds them
  Frequencies open, closed, stuck;        ///< all contacts alike
  std::optional<std::vector<double>> load_factors;  ///< run.geometric: Geometric::load_factors
  std::vector<StiffnessRatio> stiffness;
  std::vector<Discontinuity> discontinuities;  ///< ascending
  Method method;
  Cost cost;
  std::size_t rows = 0;  ///< of history.csv
};

/// Errors: SceneError when the run could not start, with the reason.
[[nodiscard]] CheckReport check(const Scene& scene, const Model& model);

/// Tries the first steps of each engine that takes the scene; with these cutoffs of [reduction], in cycles per time, or where
/// none is given and the run is long one that suits its frequencies. Takes half a second an engine.
void measure_cost(const Scene& scene, const Model& model, std::vector<double> cutoffs, CheckReport& report);

/// The same as JSON, numbers in the scene's units.
[[nodiscard]] std::string check_json(const Scene& scene, const Model& model, const CheckReport& report);

}  // namespace signorini
