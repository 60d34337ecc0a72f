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
// Of the cutoff: what swings twice as fast is 1 % greater between two samples.
constexpr double radians_a_sample = 0.15;
constexpr double most_growth = 4.0;   // of the cutoff from one trial to the next
constexpr double least_growth = 2.0;  // so that what the next one adds is most of what is missing
constexpr double most_radians = 1.0;  // in half a step, where few instants are compared: a factor of 1.85
constexpr double nothing_known =
    1.0;  // error of a trial beside one that misses no less: all of the displacement
constexpr double usual_order = 2.0;              // of what is missed, in the cutoff, until two trials tell
constexpr Eigen::Index fewest_compared = 2048;   // instants at which trials are compared; chosen
constexpr Eigen::Index most_compared = 1 << 22;  // displacements that a trial keeps for that: 32 MB

[[noreturn]] void refuse(const Scene& scene, const std::string& why) {
  throw SceneError(scene.reduction->place, "reduction.tolerance", why);
}

/// Forces of contacts and displacements, at equal steps.
class Watcher final : public Recorder {
 public:
  /// samples: steps of the run; both numbers are fewest_compared times a power of two.
  Watcher(LeftOut& left_out, const Eigen::MatrixXd& places, Eigen::Index samples, Eigen::Index instants,
          const std::function<bool()>& go_on)
      : left_out_(left_out), places_(places), every_(samples / instants), go_on_(go_on) {
    at.setZero(places.rows(), instants + 1);
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
    if (samples_ % every_ == 0 && samples_ / every_ < at.cols()) at.col(samples_ / every_) = now;
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
  CutoffTrial told = {};
};

/// Steps of a run that resolve this frequency.
Eigen::Index samples_for(double omega, double t_end) {
  Eigen::Index samples = fewest_compared;
  while (static_cast<double>(samples) < t_end * omega / radians_a_sample) samples *= 2;
  return samples;
}

Trial trial(const Scene& scene, const Model& full, const Modes& modes, Eigen::Index kept,
            const std::function<bool()>& go_on) {
  Model model = build_model(scene);
  const double highest = std::max(model.reduction->highest_kept, 1.0 / scene.run.t_end);
  const Eigen::Index samples = samples_for(highest, scene.run.t_end);
  const double step = scene.run.t_end / static_cast<double>(samples);
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
  Eigen::Index instants = samples;
  while (instants > fewest_compared && instants * places.rows() > most_compared) instants /= 2;
  Watcher watcher(left_out, places, samples, instants, go_on);
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

/// Greatest difference of displacements, from the instants that both have. What swings at twice the cutoff, as most of
/// it does, is greater between two of them by 1 / cos(omega h), h apart.
double apart(const Trial& a, const Trial& b, double t_end) {
  const Eigen::Index n = std::min(a.at.cols(), b.at.cols()) - 1;
  const Eigen::Index every_a = (a.at.cols() - 1) / n, every_b = (b.at.cols() - 1) / n;
  double most = 0.0;
  for (Eigen::Index i = 0; i <= n; ++i)
    most = std::max(most, (a.at.col(i * every_a) - b.at.col(i * every_b)).cwiseAbs().maxCoeff());
  const double half_a_step = a.told.cutoff_omega * t_end / static_cast<double>(n);
  return most / std::cos(std::min(half_a_step, most_radians));
}

/// By how much what is missed turned out to be too little. 1: it was not.
double feedback(const Trial& trial) {
  return trial.missed > 0.0 ? std::max(1.0, trial.told.error / trial.missed) : 1.0;
}

/// What a trial is off by, beside one with more modes: error = moved + missed_finer max(1, error / missed), solved.
void judge(Trial& trial, const Trial& finer, double t_end) {
  if (!(finer.greatest > 0.0)) return;
  const double moved = apart(trial, finer, t_end) / finer.greatest;
  trial.told.moved = moved;
  trial.told.error = moved + finer.missed;
  if (finer.missed == 0.0 || trial.missed == 0.0) return;
  const double left = finer.missed / trial.missed;
  trial.told.error = std::max(trial.told.error, left < 1.0 ? moved / (1.0 - left) : nothing_known);
}

/// Trials with more and more modes, and the first of them that is sharp enough.
class Search {
 public:
  Search(Scene scene, const std::function<bool()>& go_on)
      : scene_(std::move(scene)), go_on_(go_on), full_(whole(scene_)), modes_(all_modes_of(scene_, full_)) {}

  Scene run() {
    const Eigen::Index all = modes_.square.size();
    for (Eigen::Index kept = std::min(all, modes_.free + fewest_modes);; kept = next(kept)) {
      ReductionSpec& spec = *scene_.reduction;
      spec.cutoff_omega = cutoff_after(modes_, kept);
      // Where what the last one misses is too much already, nothing is to be tried: all modes are kept.
      const bool needed = kept < all || (!trials_.empty() && estimated() <= *spec.tolerance);
      Trial now = needed ? trial(scene_, full_, modes_, kept, go_on_) : Trial{};
      if (now.ended) return scene_;
      now.told = {spec.cutoff_omega, static_cast<int>(kept), now.missed, 0.0, now.missed};
      trials_.push_back(std::move(now));
      if (trials_.size() > 1 && needed) judge(trials_[trials_.size() - 2], trials_.back(), scene_.run.t_end);
      for (std::size_t i = 0; i + 1 < trials_.size() && needed; ++i)
        if (trials_[i].told.error <= *spec.tolerance) return found(i);
      if (kept == all) return found(trials_.size() - 1);
    }
  }

 private:
  static Model whole(Scene scene) {
    scene.reduction.reset();
    return build_model(scene);
  }

  /// What the last trial is off by, as far as is known before the next one.
  [[nodiscard]] double estimated() const {
    const double before = trials_.size() > 1 ? feedback(trials_[trials_.size() - 2]) : 1.0;
    return trials_.back().missed * before;
  }

  [[nodiscard]] Eigen::Index next(Eigen::Index kept) const {
    double order = usual_order;
    const Trial& last = trials_.back();
    if (trials_.size() > 1 && last.missed > 0.0) {
      const Trial& before = trials_[trials_.size() - 2];
      order = std::clamp(
          std::log(before.missed / last.missed) / std::log(last.told.cutoff_omega / before.told.cutoff_omega),
          1.0, 6.0);
    }
    const double growth = std::clamp(1.1 * std::pow(estimated() / *scene_.reduction->tolerance, 1.0 / order),
                                     least_growth, most_growth);
    return std::clamp(modes_below(modes_, growth * last.told.cutoff_omega), kept + 1, modes_.square.size());
  }

  /// The last one told is in force.
  Scene found(std::size_t i) {
    ReductionSpec& spec = *scene_.reduction;
    for (std::size_t j = 0; j < trials_.size(); ++j)
      if (j != i) spec.tried.push_back(trials_[j].told);
    spec.tried.push_back(trials_[i].told);
    spec.cutoff_omega = trials_[i].told.cutoff_omega;
    return std::move(scene_);
  }

  Scene scene_;
  const std::function<bool()>& go_on_;
  const Model full_;
  const Modes modes_;
  std::vector<Trial> trials_;
};

}  // namespace

Scene find_cutoff(Scene scene, const std::function<bool()>& go_on) {
  if (!scene.reduction || !scene.reduction->tolerance || !scene.reduction->tried.empty()) return scene;
  return Search(std::move(scene), go_on).run();
}

Scene find_cutoff(Scene scene, const std::optional<ReductionSpec>& found) {
  if (found && found->tolerance && scene.reduction && scene.reduction->tolerance == found->tolerance)
    scene.reduction = found;
  return find_cutoff(std::move(scene));
}

}  // namespace signorini
