#include "study/reduction/find_cutoff.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "model/assembly/parts.hpp"
#include "model/build.hpp"
#include "model/modes/frequencies.hpp"
#include "model/reduce/kept_modes.hpp"
#include "model/statics/mechanisms.hpp"
#include "signorini/error.hpp"
#include "signorini/simulate.hpp"
#include "study/reduction/excited_modes.hpp"

namespace signorini::reduction {
namespace {

Vector vector_of(const Combination& form, Eigen::Index n) {
  Vector x = Vector::Zero(n);
  form.add_to(x, 1.0);
  return x;
}

/// The displacement of a column as a form of the structure's displacements. A tied node moves with its body.
Vector form_of(const Column& column, const Model& full) {
  const Eigen::Index n = full.size();
  if (column.dof < n) return Vector::Unit(n, column.dof);
  return full.ties->rows.transpose() * Vector::Unit(full.ties->rows.rows(), column.dof - n);
}

}  // namespace

std::vector<RequestedPlace> requested_places(const Model& full) {
  std::vector<RequestedPlace> places;
  const Eigen::Index n = full.size();
  for (const Contact& contact : full.contacts) {
    if (!contact.normal_force_given())
      places.push_back({fmt::format("normal of contact '{}'", contact.name), vector_of(contact.normal, n)});
    if (contact.has_friction())
      places.push_back({fmt::format("tangent of contact '{}'", contact.name), vector_of(contact.tangent, n)});
  }
  for (const Column& column : full.columns)
    if (!column.velocity && column.dof >= 0 && !full.is_rotation(column))
      places.push_back({column.name, form_of(column, full)});
  return places;
}

TruncationError::TruncationError(const Model& full, const Eigen::VectorXd& square,
                                 const Eigen::MatrixXd& shapes, Eigen::Index kept, double step)
    : full_(full), step_(step) {
  const Eigen::Index n = full.size(), modes = square.size() - kept;
  const Eigen::MatrixXd phi = shapes.rightCols(modes);
  square_ = square.tail(modes).array();
  decay_ = (phi.array() * (full.damping * phi).array()).colwise().sum().transpose();
  const std::vector<RequestedPlace> places = requested_places(full);
  const Eigen::MatrixXd seen = full.basis ? Eigen::MatrixXd(*full.basis * phi) : phi;
  places_.resize(static_cast<Eigen::Index>(places.size()), modes);
  for (std::size_t p = 0; p < places.size(); ++p)
    places_.row(static_cast<Eigen::Index>(p)) = places[p].form.transpose() * seen;
  missed_.assign(places.size(), 0.0);
  inputs_.setZero(modes, full.force_count());
  for (std::size_t c = 0; c < full.contacts.size(); ++c) {
    inputs_.col(static_cast<Eigen::Index>(full.layout.normal(c))) =
        -phi.transpose() * vector_of(full.contacts[c].normal, n);
    inputs_.col(static_cast<Eigen::Index>(full.layout.tangent(c))) =
        -phi.transpose() * vector_of(full.contacts[c].tangent, n);
  }
  loads_.resize(modes, static_cast<Eigen::Index>(full.loads.size()));
  for (std::size_t i = 0; i < full.loads.size(); ++i)
    loads_.col(static_cast<Eigen::Index>(i)) = phi.transpose() * vector_of(full.loads[i].direction, n);
  z_ = (phi.transpose() * (full.mass * full.u0)).array();
  v_ = (phi.transpose() * (full.mass * full.v0)).array();
  to_z_z_.resize(modes);
  to_z_v_ = to_v_z_ = to_v_v_ = to_z_z_;
  for (Eigen::Index j = 0; j < modes; ++j) {
    const double half = 0.5 * decay_[j], inside = square_[j] - half * half,
                 size = std::sqrt(std::abs(inside));
    const double fall = std::exp(-half * step);
    double even = std::cos(size * step), odd = size > 0.0 ? std::sin(size * step) / size : step;
    if (inside < 0.0) {
      even = std::cosh(size * step);
      odd = std::sinh(size * step) / size;
    }
    to_z_z_[j] = fall * (even + half * odd);
    to_z_v_[j] = fall * odd;
    to_v_z_[j] = -fall * square_[j] * odd;
    to_v_v_[j] = fall * (even - half * odd);
  }
}

/// Advances the modes from the sample `from` to the next sample `to`. F = a0 + a1 s + a2 s^2 + a3 s^3;
/// parabolas through the neighbouring samples give the slopes at both ends.
void TruncationError::advance(const Array& before, const Array& from, const Array& to, const Array& after) {
  const double h = step_;
  const Array slope = 0.5 * (to - before) / h, end_slope = 0.5 * (after - from) / h, rise = (to - from) / h;
  const Array a3 = (slope + end_slope - 2.0 * rise) / (h * h),
              a2 = (3.0 * rise - 2.0 * slope - end_slope) / h;
  const Array p3 = a3 / square_, p2 = (a2 - 3.0 * decay_ * p3) / square_;
  const Array p1 = (slope - 2.0 * decay_ * p2 - 6.0 * p3) / square_;
  const Array p0 = (from - decay_ * p1 - 2.0 * p2) / square_;
  const Array y = z_ - p0, w = v_ - p1;
  z_ = to_z_z_ * y + to_z_v_ * w + p0 + h * (p1 + h * (p2 + h * p3));
  v_ = to_v_z_ * y + to_v_v_ * w + p1 + h * (2.0 * p2 + 3.0 * h * p3);
  observe(to);
}

void TruncationError::observe(const Array& force) {
  const Eigen::VectorXd off = places_ * (z_ - force / square_).matrix();
  for (std::size_t p = 0; p < missed_.size(); ++p)
    missed_[p] = std::max(missed_[p], std::abs(off[static_cast<Eigen::Index>(p)]));
}

void TruncationError::sample(double t, const std::vector<double>& forces) {
  if (square_.size() == 0) return;
  Eigen::VectorXd acting(static_cast<Eigen::Index>(full_.loads.size()));
  for (std::size_t i = 0; i < full_.loads.size(); ++i)
    acting[static_cast<Eigen::Index>(i)] = full_.loads[i].history.value(t);
  const Eigen::Map<const Eigen::VectorXd> contacts(forces.data(), static_cast<Eigen::Index>(forces.size()));
  Array now = (loads_ * acting + inputs_ * contacts).array();
  if (forces_.empty()) {
    observe(now);
    forces_.push_back(now);  // the first sample is its own neighbour
  }
  forces_.push_back(std::move(now));
  if (forces_.size() < 4) return;
  advance(forces_[0], forces_[1], forces_[2], forces_[3]);
  forces_.erase(forces_.begin());
}

void TruncationError::finish() {
  if (forces_.size() == 3) advance(forces_[0], forces_[1], forces_[2], forces_[2]);
}

namespace {

constexpr Eigen::Index min_modes = 6;  // number of modes with stiffness in the first trial; chosen value
// Phase of the cutoff frequency per sample: an oscillation at twice the cutoff exceeds its samples by at most 1 %.
constexpr double phase_per_sample = 0.15;
constexpr double max_growth = 4.0;    // largest ratio of the cutoffs of successive trials
constexpr double least_growth = 2.0;  // smallest ratio: the next trial then adds most of the missing part
// Limit for the phase in apart() if few instants are compared. It limits the correction factor to 1.85.
constexpr double max_radians = 1.0;
// Error of a trial if the finer trial misses as much or more: the whole displacement.
constexpr double unknown_error = 1.0;
// Order p in missed ~ cutoff^-p, assumed until two trials give an estimate.
constexpr double usual_order = 2.0;
constexpr int max_failures = 4;              // limit for successive trials that cannot run
constexpr int max_moves = 8;                 // limit for moves of a cutoff if modes cannot be counted
constexpr double cutoff_shift = 1.01;        // factor by which a cutoff is moved
constexpr double raised = 1.5;               // growth of a cutoff with too few modes below it
constexpr Eigen::Index min_compared = 2048;  // smallest number of compared instants; chosen value
// Limit of the number of displacements that a trial stores for the comparison: 32 MB.
constexpr Eigen::Index max_compared = 1 << 22;

[[noreturn]] void refuse(const Scene& scene, const std::string& why) {
  throw SceneError(scene.reduction->place, "reduction.tolerance", why);
}

/// Restricts a reduced model's displacements to the requested places. A run then computes the same motion, but its
/// samples have only a few rows. Parts of the model that refer to the structure's degrees of freedom are removed.
void restrict_to_places(const std::vector<RequestedPlace>& asked, Model& model) {
  const auto count = static_cast<Eigen::Index>(asked.size());
  Reduction& reduction = *model.reduction;
  Eigen::MatrixXd forms(count, reduction.shapes.rows());
  reduction.dofs.clear();
  for (Eigen::Index p = 0; p < count; ++p) {
    const RequestedPlace& place = asked[static_cast<std::size_t>(p)];
    forms.row(p) = place.form.transpose();
    reduction.dofs.push_back({place.name, "rate of " + place.name, false, false});
  }
  reduction.shapes = forms * reduction.shapes;
  for (LoadCorrection& seen : model.load_corrections) seen.displacements = forms * seen.displacements;
  model.ties.reset();
  model.columns.clear();
  model.outputs.clear();
  model.reaction_sums.clear();
  model.drawing.clear();
  model.drawn_nodes.clear();
}

/// Records displacements, and passes the forces of contacts to a TruncationError, at equal time steps.
class TrialRecorder final : public Recorder {
 public:
  /// samples: number of steps of the run; instants: number of compared instants. Both are min_compared times
  /// a power of two.
  TrialRecorder(TruncationError& left_out, Eigen::Index places, Eigen::Index samples, Eigen::Index instants,
                const std::function<bool()>& go_on)
      : truncation_(left_out), every_(samples / instants), go_on_(go_on) {
    at.setZero(places, instants + 1);
  }
  void event(const Event& /*event*/) override {}
  void sample(const Sample& s) override {
    const ForceLayout& layout = truncation_.layout();
    forces_.assign(layout.size(), 0.0);
    for (std::size_t k = 0; k < s.contacts.size(); ++k) {
      forces_[layout.normal(k)] = s.contacts[k].N;
      forces_[layout.tangent(k)] = s.contacts[k].T;
    }
    truncation_.sample(s.t, forces_);
    if (at.rows() > 0) greatest = std::max(greatest, s.u->head(at.rows()).cwiseAbs().maxCoeff());
    if (samples_ % every_ == 0 && samples_ / every_ < at.cols())
      at.col(samples_ / every_) = s.u->head(at.rows());
    ++samples_;
  }
  bool progress(double /*t*/) override { return go_on_(); }

  double greatest = 0.0;  ///< largest displacement
  Eigen::MatrixXd at;     ///< displacements: places x compared instants

 private:
  TruncationError& truncation_;
  Eigen::Index every_, samples_ = 0;
  const std::function<bool()>& go_on_;
  std::vector<double> forces_;
};

/// The structure and, if it is small enough, all of its modes.
class SystemMatrices {
 public:
  explicit SystemMatrices(const Scene& scene)
      : model(built(scene)),
        null_(statics::null_motions(model.stiffness)),
        mass_dof_count_(assembly::degrees_with_mass(model.mass)) {
    if (mass_dof_count_ > reduce::all_modes_up_to) return;
    try {
      all_ = reduce::modes_up_to(std::numeric_limits<double>::max(), model.mass, model.stiffness, null_);
    } catch (const reduce::NotReducible& e) {
      refuse(scene, e.what());
    }
  }

  [[nodiscard]] Eigen::Index free() const { return null_.cols(); }
  [[nodiscard]] Eigen::Index all() const { return all_ ? all_->squares.size() : mass_dof_count_; }

  struct Cutoff {
    double omega = 0.0;
    Eigen::Index kept = 0;  ///< number of modes below omega; -1: cannot be counted
  };
  /// A cutoff above all modes up to the frequency `omega`, and above at least `least` modes.
  [[nodiscard]] Cutoff cutoff_above(double omega, Eigen::Index least) const {
    least = std::min(least, all());
    if (all_) {
      const Eigen::Index below = std::count_if(all_->squares.begin(), all_->squares.end(),
                                               [&](double square) { return square <= omega * omega; });
      const Eigen::Index kept = std::clamp(below, least, all());
      const double last = std::sqrt(all_->squares[kept - 1]);
      return {kept == all() ? 2.0 * last : 0.5 * (last + std::sqrt(all_->squares[kept])), kept};
    }
    for (int failures = 0; failures < max_moves;) {
      const int below = modes::count_modes_below(model.mass, model.stiffness, omega * omega);
      if (below >= least) return {omega, below};
      failures += below < 0;
      omega *= below < 0 ? cutoff_shift : raised;
    }
    return {omega, -1};
  }

  [[nodiscard]] TruncationError left_out(const Cutoff& cutoff, double step) const {
    if (all_) return {model, all_->squares, all_->shapes, cutoff.kept, step};
    const ExcitedModes others =
        excited_modes(model, reduce::modes_up_to(cutoff.omega, model.mass, model.stiffness, null_));
    return {model, others.squares, others.shapes, 0, step};
  }

  const Model model;

 private:
  static Model built(Scene scene) {
    scene.reduction->cutoff_omega = 1.0;  // initial gaps are checked as in a reduced model
    return model::build_structure(scene);
  }

  Eigen::MatrixXd null_;
  Eigen::Index mass_dof_count_;
  std::optional<reduce::KeptModes> all_;
};

/// A trial run with one cutoff.
struct Trial {
  bool ended = false;   // true if go_on ended the run
  std::string failure;  // reason why the trial could not run; empty: it ran
  double missed = 0.0, greatest = 0.0;
  Eigen::MatrixXd at;
  CutoffTrial reported = {};
};

/// Number of time steps that resolve this circular frequency.
Eigen::Index samples_for(double omega, double t_end) {
  Eigen::Index samples = min_compared;
  while (static_cast<double>(samples) < t_end * omega / phase_per_sample) samples *= 2;
  return samples;
}

Trial trial(const Scene& scene, const SystemMatrices& structure, const SystemMatrices::Cutoff& cutoff,
            const std::function<bool()>& go_on) {
  Model model = build_model(scene);
  const double highest = std::max(model.reduction->highest_kept, 1.0 / scene.run.t_end);
  const Eigen::Index samples = samples_for(highest, scene.run.t_end);
  const double step = scene.run.t_end / static_cast<double>(samples);
  TruncationError left_out = structure.left_out(cutoff, step);
  const std::vector<RequestedPlace> asked = requested_places(structure.model);
  restrict_to_places(asked, model);
  RunSpec run = scene.run;
  run.output_times.reset();
  run.frames.clear();
  run.output_dt = step;
  const auto places = static_cast<Eigen::Index>(asked.size());
  Eigen::Index instants = samples;
  while (instants > min_compared && instants * places > max_compared) instants /= 2;
  TrialRecorder watcher(left_out, places, samples, instants, go_on);
  const Report report = simulate(model, run, watcher);
  Trial result;
  result.ended = report.outcome.kind == Outcome::Kind::interrupted;
  if (result.ended) return result;
  if (report.outcome.kind == Outcome::Kind::stopped) {
    result.failure = fmt::format("a trial with {} stopped at t = {:.6g}: {}",
                                 base::count_text(static_cast<std::size_t>(cutoff.kept), "mode"),
                                 report.outcome.t, report.outcome.reason);
    return result;
  }
  left_out.finish();
  double most = 0.0;
  for (const double missed : left_out.missed()) most = std::max(most, missed);
  result.missed = watcher.greatest > 0.0 ? most / watcher.greatest : 0.0;
  result.greatest = watcher.greatest;
  result.at = std::move(watcher.at);
  return result;
}

/// Largest difference of displacements at common instants, divided by cos(omega h): most of the difference
/// oscillates at twice the cutoff omega, and its extremes lie between two instants h apart.
double apart(const Trial& a, const Trial& b, double t_end) {
  const Eigen::Index n = std::min(a.at.cols(), b.at.cols()) - 1;
  const Eigen::Index every_a = (a.at.cols() - 1) / n, every_b = (b.at.cols() - 1) / n;
  double most = 0.0;
  for (Eigen::Index i = 0; i <= n; ++i)
    most = std::max(most, (a.at.col(i * every_a) - b.at.col(i * every_b)).cwiseAbs().maxCoeff());
  const double half_a_step = a.reported.cutoff_omega * t_end / static_cast<double>(n);
  return most / std::cos(std::min(half_a_step, max_radians));
}

/// Factor by which `missed` underestimates the error of a trial; at least 1.
double feedback(const Trial& trial) {
  return trial.missed > 0.0 ? std::max(1.0, trial.reported.error / trial.missed) : 1.0;
}

/// Sets the error of a trial by comparison with a finer trial: the solution of
/// error = moved + missed_finer max(1, error / missed).
void judge(Trial& trial, const Trial& finer, double t_end) {
  if (!(finer.greatest > 0.0)) return;
  const double moved = apart(trial, finer, t_end) / finer.greatest;
  trial.reported.moved = moved;
  trial.reported.error = moved + finer.missed;
  if (finer.missed == 0.0 || trial.missed == 0.0) return;
  const double left = finer.missed / trial.missed;
  trial.reported.error = std::max(trial.reported.error, left < 1.0 ? moved / (1.0 - left) : unknown_error);
}

/// Runs trials with increasing numbers of modes, until the first one that is accurate enough.
class Search {
 public:
  Search(Scene scene, const std::function<bool()>& go_on)
      : scene_(std::move(scene)), go_on_(go_on), structure_(scene_) {}

  Scene run() {
    const ReductionSpec& spec = *scene_.reduction;
    const Eigen::Index all = structure_.all();
    for (cutoff_ = first();; cutoff_ = next()) {
      if (cutoff_.kept < 0) refuse(scene_, "the modes below the cutoff cannot be counted; give cutoff_omega");
      // If the last trial's estimated error exceeds the tolerance and the next trial would keep all modes,
      // all modes are kept without a trial.
      const bool needed = cutoff_.kept < all || (!trials_.empty() && estimated() <= *spec.tolerance);
      Trial now = needed ? tried() : Trial{};
      if (now.ended) return scene_;
      if (!now.failure.empty()) {
        if (cutoff_.kept == all || ++failures_ == max_failures) refuse(scene_, now.failure);
        continue;
      }
      failures_ = 0;
      now.reported = {cutoff_.omega, static_cast<int>(cutoff_.kept), now.missed, 0.0, now.missed};
      trials_.push_back(std::move(now));
      if (trials_.size() > 1 && needed) judge(trials_[trials_.size() - 2], trials_.back(), scene_.run.t_end);
      for (std::size_t i = 0; i + 1 < trials_.size() && needed; ++i)
        if (trials_[i].reported.error <= *spec.tolerance) return found(i);
      if (cutoff_.kept == all) return found(trials_.size() - 1);
    }
  }

 private:
  /// First cutoff. If the structure is too large to compute all modes, the cutoff is above the lowest
  /// frequency of the structure on its contacts.
  [[nodiscard]] SystemMatrices::Cutoff first() const {
    const bool known = structure_.all() <= reduce::all_modes_up_to;
    const double lowest = structure_.model.omega1 > 0.0 ? structure_.model.omega1 : 1.0 / scene_.run.t_end;
    return structure_.cutoff_above(known ? 0.0 : lowest, structure_.free() + min_modes);
  }

  /// Runs a trial. If a model is refused because its cutoff is too near a mode, the cutoff is moved slightly.
  Trial tried() {
    Trial failed;
    for (int moves = 0; moves < max_failures; ++moves) {
      scene_.reduction->cutoff_omega = cutoff_.omega;
      try {
        return trial(scene_, structure_, cutoff_, go_on_);
      } catch (const SceneError& e) {
        failed.failure = e.what();
      } catch (const reduce::NotReducible& e) {
        failed.failure = e.what();
      }
      if (structure_.all() <= reduce::all_modes_up_to || cutoff_.kept == structure_.all()) break;
      cutoff_ = structure_.cutoff_above(cutoff_shift * cutoff_.omega, cutoff_.kept);
    }
    return failed;
  }

  /// Estimated error of the last trial, before a finer trial has been computed.
  [[nodiscard]] double estimated() const {
    const double before = trials_.size() > 1 ? feedback(trials_[trials_.size() - 2]) : 1.0;
    return trials_.back().missed * before;
  }

  [[nodiscard]] SystemMatrices::Cutoff next() const {
    if (trials_.empty()) return structure_.cutoff_above(least_growth * cutoff_.omega, cutoff_.kept + 1);
    double order = usual_order;
    const Trial& last = trials_.back();
    if (trials_.size() > 1 && last.missed > 0.0) {
      const Trial& before = trials_[trials_.size() - 2];
      order = std::clamp(std::log(before.missed / last.missed) /
                             std::log(last.reported.cutoff_omega / before.reported.cutoff_omega),
                         1.0, 6.0);
    }
    const double growth = std::clamp(1.1 * std::pow(estimated() / *scene_.reduction->tolerance, 1.0 / order),
                                     least_growth, max_growth);
    return structure_.cutoff_above(growth * cutoff_.omega, cutoff_.kept + 1);
  }

  /// Returns the scene with the cutoff of the i-th trial, and records all trials; the i-th trial is recorded last.
  Scene found(std::size_t i) {
    ReductionSpec& spec = *scene_.reduction;
    for (std::size_t j = 0; j < trials_.size(); ++j)
      if (j != i) spec.trials.push_back(trials_[j].reported);
    spec.trials.push_back(trials_[i].reported);
    spec.cutoff_omega = trials_[i].reported.cutoff_omega;
    return std::move(scene_);
  }

  Scene scene_;
  const std::function<bool()>& go_on_;
  const SystemMatrices structure_;
  SystemMatrices::Cutoff cutoff_;
  int failures_ = 0;  // number of failed trials since the last trial that ran
  std::vector<Trial> trials_;
};

}  // namespace

Scene find_cutoff(Scene scene, const std::function<bool()>& go_on) {
  if (!scene.reduction || !scene.reduction->tolerance || !scene.reduction->trials.empty()) return scene;
  return Search(std::move(scene), go_on).run();
}

Scene find_cutoff(Scene scene, const std::optional<ReductionSpec>& found) {
  if (found && found->tolerance && scene.reduction && scene.reduction->tolerance == found->tolerance)
    scene.reduction = found;
  return find_cutoff(std::move(scene));
}

}  // namespace signorini::reduction
