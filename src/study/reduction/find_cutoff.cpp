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
constexpr double usual_order = 2.0;     // of what is missed, in the cutoff, until two trials tell
constexpr Eigen::Index compared = 256;  // parts of the run at whose ends trials are compared; chosen

[[noreturn]] void refuse(const Scene& scene, const std::string& why) {
  throw SceneError(scene.reduction->place, "reduction.tolerance", why);
}

/// Forces of contacts and greatest displacements, at equal steps.
class Watcher final : public Recorder {
 public:
  Watcher(LeftOut& left_out, const Eigen::MatrixXd& places, Eigen::Index every,
          const std::function<bool()>& go_on)
      : left_out_(left_out), places_(places), every_(every), go_on_(go_on) {
    at.setZero(places.rows(), compared + 1);
  }
  void event(const Event& /*event*/) override {}
  void sample(const Sample& s) override {
    forces_.clear();
    for (const ContactSample& contact : s.contacts) {
      forces_.push_back(contact.N);
      forces_.push_back(contact.T);
    }
    left_out_.sample(s.t, forces_);
    const Vector now = places_ * s.u->head(places_.cols());
    greatest = std::max(greatest, now.cwiseAbs().maxCoeff());
    if (samples_ % every_ == 0 && samples_ / every_ <= compared) at.col(samples_ / every_) = now;
    ++samples_;
  }
  bool progress(double /*t*/) override { return go_on_(); }

  double greatest = 0.0;  ///< displacement
  Eigen::MatrixXd at;     ///< places x instants of comparison

 private:
  LeftOut& left_out_;
  const Eigen::MatrixXd& places_;
  Eigen::Index every_, samples_ = 0;
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

/// A run with a cutoff.
struct Trial {
  bool ended = false;  // it was told to
  double missed = 0.0, greatest = 0.0;
  Eigen::MatrixXd at;
};

Trial trial(const Scene& scene, const Model& full, const Modes& modes, Eigen::Index kept,
            const std::function<bool()>& go_on) {
  Model model = build_model(scene);
  const double highest = std::max(model.reduction->highest_kept, 1.0 / scene.run.t_end);
  const double every = std::ceil(scene.run.t_end * highest / radians_a_sample / compared);
  const double step = scene.run.t_end / (every * compared);
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
  Watcher watcher(left_out, places, static_cast<Eigen::Index>(every), go_on);
  const Report report = simulate(model, run, watcher);
  if (report.outcome.kind == Outcome::Kind::interrupted) return {true, 0.0, 0.0, {}};
  if (report.outcome.kind == Outcome::Kind::stopped)
    refuse(scene, fmt::format("a trial with {} modes stopped at t = {:.6g}: {}", kept, report.outcome.t,
                              report.outcome.reason));
  left_out.finish();
  double most = 0.0;
  for (const double missed : left_out.missed()) most = std::max(most, missed);
  return {false, watcher.greatest > 0.0 ? most / watcher.greatest : 0.0, watcher.greatest,
          std::move(watcher.at)};
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

/// What a trial tells, beside the one before it: the error that a trial had, over what it missed, is that of
/// the next one, too.
CutoffTrial judged(double omega, Eigen::Index kept, const Trial& now, const Trial& before) {
  CutoffTrial told{omega, static_cast<int>(kept), now.missed, 0.0, now.missed};
  if (before.at.size() == 0 || !(now.greatest > 0.0)) return told;
  told.moved = (now.at - before.at).cwiseAbs().maxCoeff() / now.greatest;
  if (before.missed > 0.0) told.error = now.missed * std::max(1.0, told.moved / before.missed);
  return told;
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
  Trial before;
  while (true) {
    spec.cutoff_omega = cutoff_after(modes, kept);
    Trial now = kept == all ? Trial{} : trial(scene, full, modes, kept, go_on);
    if (now.ended) return scene;
    if (!spec.tried.empty() && now.missed > 0.0) {
      const auto& last = spec.tried.back();
      const double seen =
          std::log(last.missed / now.missed) / std::log(spec.cutoff_omega / last.cutoff_omega);
      order = std::clamp(seen, 1.0, 6.0);
    }
    spec.tried.push_back(judged(spec.cutoff_omega, kept, now, before));
    const double error = spec.tried.back().error;
    if (error <= *spec.tolerance && (spec.tried.size() > 1 || kept == all)) return scene;
    const double growth =
        std::clamp(1.1 * std::pow(error / *spec.tolerance, 1.0 / order), least_growth, most_growth);
    kept = std::clamp(modes_below(modes, growth * spec.cutoff_omega), kept + 1, all);
    before = std::move(now);
  }
}

Scene find_cutoff(Scene scene, const std::optional<ReductionSpec>& found) {
  if (found && found->tolerance && scene.reduction && scene.reduction->tolerance == found->tolerance)
    scene.reduction = found;
  return find_cutoff(std::move(scene));
}

}  // namespace signorini
