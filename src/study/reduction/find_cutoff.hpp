// find_cutoff.hpp: finds the cutoff of a reduced model for a given tolerance.
//
//   few modes -> run -> contribution of the modes left out (TruncationError) -> more modes -> run -> ...
//   error = |u - u_finer| + missed_finer max(1, error / missed)
//   the first trial with error <= tolerance is used
//
// missed: largest contribution of the modes left out, by TruncationError; finer: the next trial.
//
// The missing contribution changes contact forces, which emit waves, shift events and may change their
// sequence. An estimate from one run includes none of these effects, and no forces that jump between its
// samples. Therefore each trial is compared with a run with at least twice the cutoff, at all common sample
// instants. The contribution that the finer run misses also changes the motion; this effect is scaled by the
// ratio error / missed of the trial. If the finer run has all modes, the error is the difference from the
// full model.
// Errors are relative to the largest displacement of all places (requested_places()) during the run.
#pragma once

#include <functional>
#include <optional>

#include "signorini/model.hpp"
#include "signorini/scene.hpp"

namespace signorini::reduction {

// Dynamic contribution of the modes that a reduction leaves out.
//
//   z'' + c z' + omega^2 z = phi . F(t),    missed(p) = sum over modes left out  phi(p) (z - phi . F / omega^2)
//
// F: loads and contact forces of a reduced run, which includes the static part phi . F / omega^2 already. Between
// samples F is a cubic with slopes from five samples, for which z is exact. The effect of the missing motion at
// contacts on their forces is neglected.

/// A place at which displacements are evaluated.
struct RequestedPlace {
  std::string name;  ///< "normal of contact 'first'", "A.ux"
  Vector form;       ///< linear form of the structure's displacements, without motions of supports
};

/// The places: contacts along normal and tangent, and displacements of named nodes. full: result of build_structure().
[[nodiscard]] std::vector<RequestedPlace> requested_places(const Model& full);

class TruncationError {
 public:
  /// full: result of build_structure(), must outlive the object; square, shapes: omega^2 and shapes of its
  /// modes, ascending; kept: number of modes that the reduction keeps. With kept = 0, square and shapes
  /// belong to the vectors that replace the modes left out (excited_modes.hpp).
  TruncationError(const Model& full, const Eigen::VectorXd& square, const Eigen::MatrixXd& shapes,
                  Eigen::Index kept, double step);

  [[nodiscard]] const ForceLayout& layout() const { return full_.layout; }
  /// Adds a sample: the forces of contacts, in the order of the model's layout, at the times 0, step, 2 step, ...
  void sample(double t, const std::vector<double>& forces);
  /// Completes the last step. Must be called after the last sample.
  void finish();
  /// Largest |missed(p)| at each place.
  [[nodiscard]] const std::vector<double>& missed() const { return missed_; }

 private:
  using Array = Eigen::ArrayXd;
  void advance(const Array& before, const Array& from, const Array& to, const Array& after);
  void observe(const Array& force);

  const Model& full_;
  double step_;
  Eigen::MatrixXd places_, inputs_;                           // places x modes, modes x (contact forces)
  Eigen::MatrixXd loads_;                                     // modes x loads
  Array square_, decay_, to_z_z_, to_z_v_, to_v_z_, to_v_v_;  // coefficients of the free motion over a step
  Array z_, v_;
  std::vector<Array> forces_;  // modal forces of the last four samples
  std::vector<double> missed_;
};

/// The scene with the cutoff that satisfies its reduction.tolerance. Errors: SceneError at
/// reduction.tolerance if no number of modes satisfies it, or if trial runs stop. go_on: called periodically;
/// if it returns false, the search ends and the scene is returned unchanged.
[[nodiscard]] Scene find_cutoff(
    Scene scene, const std::function<bool()>& go_on = [] { return true; });

/// The scene with the cutoff `found` for another scene, if both scenes have the same tolerance; otherwise a search
/// finds the scene's own cutoff. Thus compared runs use the same model, and only the first one needs a search.
[[nodiscard]] Scene find_cutoff(Scene scene, const std::optional<ReductionSpec>& found);

}  // namespace signorini::reduction
