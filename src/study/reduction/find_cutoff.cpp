#include "study/reduction/find_cutoff.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "model/reduce/kept_modes.hpp"
#include "model/statics/null_motions.hpp"
#include "signorini/error.hpp"
#include "signorini/simulate.hpp"
#include "study/reduction/left_out.hpp"

namespace signorini {
namespace {

constexpr Eigen::Index fewest_modes = 6;  // with stiffness, in the first trial; chosen
constexpr double radians_a_sample = 0.3;  // of the cutoff: a cubic is off by 2e-5 of a force that swings so
constexpr double most_growth = 4.0;       // of the cutoff from one trial to the next
constexpr double least_growth = 1.25;
constexpr double usual_order = 2.0;  // of what is missed, in the cutoff, until two trials tell

[[noreturn]] void refuse(const Scene& scene, const std::string& why) {
  throw SceneError(scene.reduction->place, "reduction.tolerance", why);
}

/// Forces of contacts and greatest displacements, at equal steps.
class Watcher final : public Recorder {
 public:
  Watcher(LeftOut& left_out, const Eigen::MatrixXd& places, const std::function<bool()>& go_on)
      : left_out_(left_out), places_(places), go_on_(go_on) {}
  void event(const Event& /*event*/) override {}
  void sample(const Sample& s) override {
    forces_.clear();
    for (const ContactSample& contact : s.contacts) {
      forces_.push_back(contact.N);
      forces_.push_back(contact.T);
    }
    left_out_.sample(s.t, forces_);
    greatest = std::max(greatest, (places_ * s.u->head(places_.cols())).cwiseAbs().maxCoeff());
  }
  bool progress(double /*t*/) override { return go_on_(); }

  double greatest = 0.0;  ///< displacement

 private:
  LeftOut& left_out_;
  const Eigen::MatrixXd& places_;
  const std::function<bool()>& go_on_;
  std::vector<double> forces_;
};

struct Modes {
  Eigen::VectorXd square;
  Eigen::MatrixXd shapes;
  Eigen::Index free = 0;
};

Modes all_modes_of(const Scene& scene, const Model& full) {
  if (full.basis || std::any_of(full.contacts.begin(), full.contacts.end(),
                                [](const Contact& contact) { return contact.shear.has_value(); }))
    refuse(scene,
           "contacts with tangential_damping, and motions without mass and damping, have no modes that "
           "could be counted in or out; give cutoff_omega");
  try {
    KeptModes all = modes_up_to(std::numeric_limits<double>::max(), full.mass, full.stiffness,
                                null_motions(full.stiffness));
    return {std::move(all.squares), std::move(all.shapes), all.free};
  } catch (const NotReducible& e) {
    refuse(scene, e.what());
  }
}

/// The run with a cutoff: what is missed, over the greatest displacement; negative: it was told to end.
double trial(const Scene& scene, const Model& full, const Modes& modes, Eigen::Index kept,
             const std::function<bool()>& go_on) {
  Model model = build_model(scene);
  const double highest = std::max(model.reduction->highest_kept, 1.0 / scene.run.t_end);
  const auto steps = std::ceil(scene.run.t_end * highest / radians_a_sample);
  const double step = scene.run.t_end / steps;
  LeftOut left_out(full, modes.square, modes.shapes, kept, step);
  const std::vector<AskedPlace> asked = asked_places(full);
  Eigen::MatrixXd places(static_cast<Eigen::Index>(asked.size()), model.reduction->shapes.cols());
  for (std::size_t p = 0; p < asked.size(); ++p)
    places.row(static_cast<Eigen::Index>(p)) = asked[p].form.transpose() * model.reduction->shapes;
  model.reduction.reset();  // rows in amplitudes
  model.columns.clear();
  model.outputs.clear();
  RunSpec run = scene.run;
  run.output_times.reset();
  run.frames.clear();
  run.output_dt = step;
  Watcher watcher(left_out, places, go_on);
  const Report report = simulate(model, run, watcher);
  if (report.outcome.kind == Outcome::Kind::interrupted) return -1.0;
  if (report.outcome.kind == Outcome::Kind::stopped)
    refuse(scene, fmt::format("a trial with {} modes stopped at t = {:.6g}: {}", kept, report.outcome.t,
                              report.outcome.reason));
  left_out.finish();
  double most = 0.0;
  for (const double missed : left_out.missed()) most = std::max(most, missed);
  return watcher.greatest > 0.0 ? most / watcher.greatest : 0.0;
}

/// Of all modes, those up to a frequency; a cutoff between the last one and the next.
Eigen::Index modes_below(const Modes& modes, double omega) {
  return std::count_if(modes.square.begin(), modes.square.end(),
                       [&](double square) { return square <= omega * omega; });
}
double cutoff_after(const Modes& modes, Eigen::Index kept) {
  const double last = std::sqrt(modes.square[kept - 1]);
  return kept == modes.square.size() ? 2.0 * last : 0.5 * (last + std::sqrt(modes.square[kept]));
}

}  // namespace

Scene find_cutoff(Scene scene, const std::function<bool()>& go_on) {
  if (!scene.reduction || !scene.reduction->tolerance || !scene.reduction->tried.empty()) return scene;
  Scene whole = scene;
  whole.reduction.reset();
  const Model full = build_model(whole);
  const Modes modes = all_modes_of(scene, full);
  ReductionSpec& spec = *scene.reduction;
  const Eigen::Index all = modes.square.size();
  Eigen::Index kept = std::min(all, modes.free + fewest_modes);
  double order = usual_order;
  while (true) {
    spec.cutoff_omega = cutoff_after(modes, kept);
    const double missed = kept == all ? 0.0 : trial(scene, full, modes, kept, go_on);
    if (missed < 0.0) return scene;
    if (!spec.tried.empty() && missed > 0.0) {
      const auto& last = spec.tried.back();
      const double seen = std::log(last.missed / missed) / std::log(spec.cutoff_omega / last.cutoff_omega);
      order = std::clamp(seen, 1.0, 6.0);
    }
    spec.tried.push_back({spec.cutoff_omega, static_cast<int>(kept), missed});
    if (missed <= *spec.tolerance) return scene;
    const double growth =
        std::clamp(1.1 * std::pow(missed / *spec.tolerance, 1.0 / order), least_growth, most_growth);
    kept = std::clamp(modes_below(modes, growth * spec.cutoff_omega), kept + 1, all);
  }
}

}  // namespace signorini
