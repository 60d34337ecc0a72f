#include "differential/relation_judge.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/eigen_dense.hpp"
#include "differential/transform.hpp"
#include "model/assembly/springs.hpp"

namespace signorini::differential {
namespace {

using Class = Likeness::Class;
constexpr double never = std::numeric_limits<double>::infinity();
constexpr double eps = std::numeric_limits<double>::epsilon();
/// Times what neighbours do. Chosen: two disturbed copies do not reach what every rounding may do together.
constexpr double of_roundings = 30.0;
/// Both runs may be as far off as the one is from its better neighbour, and neighbours err as well.
constexpr double of_steps = 5.0;
// Chosen: three tell most pairs, and of two a third lies thirty times as far once in some hundred pairs.
constexpr std::size_t few_copies = 3, many_copies = 9;
/// Sums over a hundred terms.
constexpr double rounding_of_sums = 100.0 * eps;
/// Of a difference of a few terms.
constexpr double rounding_of_terms = 8.0 * eps;

std::string mirror_image(const std::string& state) {
  return state == "slip+" ? "slip-" : state == "slip-" ? "slip+" : state;
}

/// A run of the related scene in the units, times and signs of the first one.
class WrittenBack {
 public:
  WrittenBack(const SeenRun& first, const Related& related, SeenRun& other)
      : first_(first), related_(related), other_(other) {}

  void events() {
    std::vector<compare::LoggedEvent> kept;
    for (compare::LoggedEvent event : other_.events) {
      if (std::find(first_.contacts.begin(), first_.contacts.end(), event.contact) == first_.contacts.end())
        continue;
      event.t = time(event.t);
      event.uncertainty /= related_.factors.time;
      if (related_.mirrored) {
        event.from = mirror_image(event.from);
        event.to = mirror_image(event.to);
      }
      kept.push_back(std::move(event));
    }
    other_.events = std::move(kept);
    for (double& t : other_.instants) t = time(t);
    other_.t = time(other_.t);
    other_.until = time(other_.until);
  }

  /// Columns in the first one's order.
  void rows() {
    std::map<std::string, std::size_t> places;
    for (std::size_t j = 0; j < other_.columns.size(); ++j) places[other_.columns[j].name] = j;
    std::vector<std::size_t> own, twin;
    std::vector<double> factors;
    for (const SeenColumn& column : first_.columns) {
      own.push_back(places.at(column.name));
      twin.push_back(none);
      factors.push_back(factor(column));
      const auto it = related_.twins.find(column.contact);
      if (it != related_.twins.end() && column.of == SeenColumn::Of::force)
        twin.back() = places.at(it->second + column.name.substr(column.name.rfind('.')));
    }
    for (SeenRun::Row& row : other_.rows) {
      row.t = time(row.t);
      std::vector<double> values;
      for (std::size_t j = 0; j < own.size(); ++j)
        values.push_back((row.values[own[j]] + (twin[j] == none ? 0.0 : row.values[twin[j]])) / factors[j]);
      row.values = std::move(values);
    }
    other_.columns = first_.columns;
  }

  void figures() {
    std::vector<OutputExtremes> extremes;
    for (std::size_t i = 0; i < first_.outputs.size(); ++i) {
      const auto place = std::find(other_.outputs.begin(), other_.outputs.end(), first_.outputs[i]);
      OutputExtremes e = other_.extremes[static_cast<std::size_t>(place - other_.outputs.begin())];
      const auto sign = related_.extreme_signs.find(first_.outputs[i]);
      const double f = (sign == related_.extreme_signs.end() ? 1.0 : sign->second) *
                       factor(*std::find_if(first_.columns.begin(), first_.columns.end(), [&](const auto& c) {
                         return c.of == SeenColumn::Of::output && c.name == first_.outputs[i];
                       }));
      const double a = e.maximum / f, b = e.minimum / f;
      e.maximum = std::max(a, b);
      e.minimum = std::min(a, b);
      if (i < related_.extremes_before.size()) {
        e.maximum = std::max(e.maximum, related_.extremes_before[i].maximum);
        e.minimum = std::min(e.minimum, related_.extremes_before[i].minimum);
      }
      extremes.push_back(e);
    }
    other_.extremes = std::move(extremes);
    other_.outputs = first_.outputs;
    std::vector<Peak> peaks;
    for (const std::string& name : first_.contacts) {
      Peak peak = other_.peaks[place_of(name)];
      const auto it = related_.twins.find(name);
      const double shares = it == related_.twins.end() ? 1.0 : 2.0;
      peak.N *= shares / related_.factors.force;
      peak.T *= shares / related_.factors.force;
      peaks.push_back(peak);
    }
    other_.peaks = std::move(peaks);
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  [[nodiscard]] double time(double t) const { return t / related_.factors.time - related_.later; }
  [[nodiscard]] std::size_t place_of(const std::string& contact) const {
    return static_cast<std::size_t>(std::find(other_.contacts.begin(), other_.contacts.end(), contact) -
                                    other_.contacts.begin());
  }
  /// Of the first one's value, the other's.
  [[nodiscard]] double factor(const SeenColumn& column) const {
    double f = scene::factor_of(column.unit, related_.factors);
    const bool turns =
        column.of == SeenColumn::Of::slip ||
        (column.of == SeenColumn::Of::force && column.name.substr(column.name.rfind('.')) == ".T");
    if (related_.mirrored && turns) f = -f;
    if (column.of == SeenColumn::Of::output)
      if (const auto it = related_.output_factors.find(column.name); it != related_.output_factors.end())
        f *= it->second;
    return f;
  }

  const SeenRun& first_;
  const Related& related_;
  SeenRun& other_;
};

/// Greatest |x - x_n| so far, row by row of the run; columns as the run's.
struct Spread {
  std::vector<std::vector<double>> rows;
  std::vector<double> extremes;  ///< of outputs
  std::vector<double> peaks;     ///< of contacts

  void include(const SeenRun& run, const SeenRun& neighbour, double factor) {
    rows.resize(run.rows.size(), std::vector<double>(run.columns.size(), 0.0));
    extremes.resize(run.extremes.size(), 0.0);
    peaks.resize(run.peaks.size(), 0.0);
    std::vector<double> most(run.columns.size(), 0.0);
    for (std::size_t i = 0; i < std::min(run.rows.size(), neighbour.rows.size()); ++i)
      for (std::size_t j = 0; j < most.size(); ++j) {
        const double off = std::abs(run.rows[i].values[j] - neighbour.rows[i].values[j]);
        if (off > most[j] && !at_event(run, neighbour, run.rows[i].t, run.columns[j])) most[j] = off;
        rows[i][j] = std::max(rows[i][j], factor * most[j]);
      }
    for (std::size_t i = 0; i < extremes.size() && i < neighbour.extremes.size(); ++i)
      extremes[i] =
          std::max({extremes[i], factor * std::abs(run.extremes[i].maximum - neighbour.extremes[i].maximum),
                    factor * std::abs(run.extremes[i].minimum - neighbour.extremes[i].minimum)});
    for (std::size_t k = 0; k < peaks.size() && k < neighbour.peaks.size(); ++k)
      peaks[k] = std::max({peaks[k], factor * std::abs(run.peaks[k].N - neighbour.peaks[k].N),
                           factor * std::abs(run.peaks[k].T - neighbour.peaks[k].T)});
  }

  /// Of a copy that ended before: what it had come to.
  [[nodiscard]] const std::vector<double>& motion_up_to_instant(std::size_t row) const {
    return rows[std::min(row, rows.size() - 1)];
  }

  /// One run has jumped, the other not yet.
  static bool at_event(const SeenRun& run, const SeenRun& neighbour, double t, const SeenColumn& column) {
    if (!column.jumps) return false;
    const std::size_t count = std::min(run.events.size(), neighbour.events.size());
    const double instant = 8.0 * eps * run.t;
    for (const SeenRun* of : {&run, &neighbour})
      for (const double at : of->instants)
        if (std::abs(t - at) <= instant) return true;
    for (std::size_t i = 0; i < count; ++i) {
      const double a = run.events[i].t, b = neighbour.events[i].t;
      if (std::min(a, b) - instant <= t && t <= std::max(a, b) + instant) return true;
    }
    return false;
  }
};

/// What a quantity of this unit is about, by the scene's scales.
double scale_of(const Unit& of, const Scales& s) {
  if (of.force > 0) return s.force * (of.length > 0 ? s.displacement : 1.0);
  double scale = of.length > 0 ? s.displacement : s.rotation;
  const double rate = of.length > 0 ? s.velocity / s.displacement : s.angular_velocity / s.rotation;
  for (int order = of.time; order < 0; ++order) scale *= rate;
  return scale;
}

/// Of the greatest of all columns of one kind and of the scene's scale: a sum's rounding is that of its terms.
std::vector<double> floors(const SeenRun& run, const Scales& scales, double relative) {
  std::map<std::array<int, 4>, double> most;
  const auto kind = [&](const SeenColumn& c) {
    const bool of_output = c.of == SeenColumn::Of::output;
    return std::array<int, 4>{c.unit.force, c.unit.length, c.unit.time, of_output ? 1 : 0};
  };
  for (const SeenColumn& column : run.columns) most[kind(column)] = scale_of(column.unit, scales);
  for (const SeenRun::Row& row : run.rows)
    for (std::size_t j = 0; j < run.columns.size(); ++j)
      if (std::isfinite(row.values[j])) {
        double& m = most[kind(run.columns[j])];
        m = std::max(m, std::abs(row.values[j]));
      }
  std::vector<double> result;
  // What is spent up to a row is what a step spends less what comes after the row: two sums.
  for (const SeenColumn& column : run.columns)
    result.push_back((column.of == SeenColumn::Of::spent ? 2.0 : 1.0) * relative * most[kind(column)]);
  return result;
}

/// Greatest displacement of the rows: gaps, slips, outputs.
double greatest_displacement(const SeenRun& run) {
  double greatest = 0.0;
  for (std::size_t j = 0; j < run.columns.size(); ++j) {
    const SeenColumn& c = run.columns[j];
    if (c.unit.force != 0 || c.unit.length != 1 || c.unit.time != 0) continue;
    for (const SeenRun::Row& row : run.rows)
      if (std::isfinite(row.values[j])) greatest = std::max(greatest, std::abs(row.values[j]));
  }
  return greatest;
}

/// What a displacement is rounded by, relative to the greatest: engines with a step add so many increments, each rounded.
double rounding_of_steps(const RunSpec& run) {
  return run.dt && engine_info(run.engine).accuracy == Accuracy::step ? run.t_end / *run.dt * eps : 0.0;
}

/// Forces of elements are k times a difference of displacements, which are known to some eps of the greatest.
double rounding_of_element(const Model& model, const SeenColumn& column, double reached, double in_steps) {
  if (column.of != SeenColumn::Of::force) return 0.0;
  double greatest = std::max(model.scales.displacement, reached);
  for (Eigen::Index i = 0; i < model.u0.size(); ++i)
    if (!model.dofs[static_cast<std::size_t>(i)].rotation)
      greatest = std::max(greatest, std::abs(model.u0[i]));
  for (const Contact& c : model.contacts)
    if (c.name == column.contact)
      return std::max(rounding_of_terms, in_steps) * greatest *
             std::max(c.normal_stiffness, c.tangential_stiffness.value_or(0.0));
  return 0.0;
}

/// A contact sticks rigidly along what other rigid contacts hold already, were they closed: its friction is not unique
/// (docs/theory.md), and which of them slips first is nobody's datum.
bool shares_motion(const Model& model) {
  std::vector<Vector> rows;
  std::vector<std::size_t> tangents;
  for (const Contact& c : model.contacts) {
    if (c.takes_impulses()) rows.push_back(assembly::dense_vector(c.normal, model.size()));
    if (!c.sticks_rigidly()) continue;
    tangents.push_back(rows.size());
    rows.push_back(assembly::dense_vector(c.tangent, model.size()));
  }
  Eigen::MatrixXd all(model.size(), static_cast<Eigen::Index>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) all.col(static_cast<Eigen::Index>(i)) = rows[i].normalized();
  for (const std::size_t t : tangents) {
    Eigen::MatrixXd others = all;
    others.col(static_cast<Eigen::Index>(t)).setZero();
    if (base::rank(others) == base::rank(all)) return true;
  }
  return false;
}

/// Where a row may be on an event's other side.
bool near_event(const SeenRun& run, double t, double t_end, double from) {
  // What a disturbance moves an event by is in its error; a restart's and the clock's rounding are not.
  const double instant = 64.0 * eps * (t_end + from);
  return std::any_of(run.events.begin(), run.events.end(),
                     [&](const compare::LoggedEvent& event) {
                       return !(std::abs(event.t - t) > 2.0 * event.uncertainty + instant);
                     }) ||
         std::any_of(run.instants.begin(), run.instants.end(),
                     [&](double at) { return std::abs(at - t) <= instant; });
}

}  // namespace

const char* to_string(Class verdict) {
  constexpr const char* names[] = {"same",
                                   "certain part ended before",
                                   "other order of one instant",
                                   "stopped alike",
                                   "too long",
                                   "not determined by the data",
                                   "stopped on one side",
                                   "refused on one side",
                                   "STATED ERROR TOO SMALL",
                                   "UNEXPLAINED"};
  return names[static_cast<std::size_t>(verdict)];
}

bool is_explained(Class verdict) {
  return verdict != Class::stopped_one_side && verdict != Class::refused_one_side &&
         verdict != Class::understated && verdict != Class::unexplained;
}

namespace {

/// All that `ida` is asked for: where absolute tolerances decide its steps, another rtol alone takes the same ones.
Scene tightened(Scene scene, double part) {
  scene.run.rtol *= part;
  for (std::optional<double>* atol :
       {&scene.run.atol.displacement, &scene.run.atol.velocity, &scene.run.atol.force})
    if (*atol) **atol *= part;
  return scene;
}

/// By an engine without steps, where it takes the scene; else with a hundredth of the tolerance.
Scene better(Scene scene) {
  const bool linear = std::none_of(scene.contacts.begin(), scene.contacts.end(), [](const ContactSpec& c) {
    return c.friction.is_rate_dependent() || c.pendulum_surface;
  });
  if (linear)
    scene.run.engine = Engine::exact;
  else
    scene = tightened(std::move(scene), std::max(0.01, 1e-14 / scene.run.rtol));
  return scene;
}

/// So many runs beside a scene that tell how far it may be off: every datum off by one rounding; of ida a better one first,
/// then other steps.
std::vector<Scene> copies_of(const Scene& scene, std::size_t count) {
  std::vector<Scene> copies;
  if (scene.run.engine != Engine::ida) {
    for (std::uint64_t seed = 3; copies.size() < count; ++seed) copies.push_back(disturbed(scene, seed));
    return copies;
  }
  copies.push_back(better(scene));
  for (const double part : {0.7, 0.5, 0.85, 0.6, 0.95, 0.4, 0.75, 0.3})
    if (copies.size() < count) copies.push_back(tightened(scene, part));
  return copies;
}

}  // namespace

struct RelationJudge::Members {
  Scene scene;
  Bounds bounds;
  bool with_peaks = true;
  SeenRun run;
  std::vector<double> floor;
  bool open_start = false;     ///< by the start's own words
  bool shared_motion = false;  ///< rigid contacts may hold one motion, one of them by friction
  mutable std::optional<Spread> spread, spread_of_steps;

  [[nodiscard]] Spread spread_by(const std::vector<Scene>& neighbours, double factor) const {
    Spread result;
    result.include(run, run, 0.0);  // where all neighbours are refused nothing but rounding is allowed
    for (const Scene& neighbour : neighbours) {
      const SeenRun other = see_plainly(neighbour, bounds);
      if (other.end != Track::End::refused) result.include(run, other, factor);
    }
    return result;
  }

  [[nodiscard]] Spread spread_of(const Related& related, std::size_t count) const;
  [[nodiscard]] const Spread& of(const Related& related) const {
    const bool other_steps = related.from > 0.0 || !related.same_steps;
    if (scene.run.engine == Engine::newmark && other_steps) {
      if (!spread_of_steps) {
        // Where in a step a peak lies is chance, too: three lengths are three places.
        std::vector<Scene> others;
        for (const double part : {0.5, 0.7, 0.9}) *others.emplace_back(scene).run.dt *= part;
        spread_of_steps = spread_by(others, of_steps);
      }
      return *spread_of_steps;
    }
    if (spread) return *spread;
    if (scene.run.engine != Engine::ida) {
      spread = spread_by({disturbed(scene, 1), disturbed(scene, 2)}, of_roundings);
      return *spread;
    }
    // One distance to a better run may be small by chance: other steps are another sample of the error.
    spread = spread_by({better(scene), tightened(scene, 0.7)}, of_steps);
    return *spread;
  }

  [[nodiscard]] bool ends_differ(const SeenRun& other, Likeness& result) const;
  void events(const Related& related, const SeenRun& other, Likeness& result) const;
  /// `as_written`: of the other run and its own disturbed copies; nullptr: none.
  void rows(const Related& related, const SeenRun& other, const Spread* as_written, Likeness& result) const;
  void figures(const Related& related, const SeenRun& other, const Spread* as_written,
               Likeness& result) const;
  void all(const Related& related, const SeenRun& other, const Spread* as_written, Likeness& result) const;
  [[nodiscard]] bool copies_part(const Likeness::Parting& at) const;
  static void exceeds(Likeness& result, const char* of, std::string what, Likeness::Parting at = {}) {
    if (result.verdict == Class::unexplained) return;
    result.verdict = Class::unexplained;
    result.at = at;
    result.of = of;
    result.what = std::move(what);
  }
};

/// True: nothing is left to compare.
bool RelationJudge::Members::ends_differ(const SeenRun& other, Likeness& result) const {
  using End = Track::End;
  if (run.end == End::refused || other.end == End::refused) {
    const bool both = run.end == other.end;
    result.verdict = both ? Class::stopped_alike : Class::refused_one_side;
    result.what = both ? run.said : (run.end == End::refused ? "first: " + run.said : "other: " + other.said);
    return true;
  }
  if (run.end != End::too_long && other.end != End::too_long) return false;
  result.verdict = Class::too_long;
  return true;
}

void RelationJudge::Members::events(const Related& related, const SeenRun& other, Likeness& result) const {
  const auto certain = [&](const std::vector<compare::LoggedEvent>& events) {
    std::vector<compare::LoggedEvent> list;
    for (const compare::LoggedEvent& event : events)
      if (event.t > related.from) list.push_back(event);
    return list;
  };
  std::vector<compare::LoggedEvent> a = certain(run.events), b = certain(other.events);
  double slack = rounding_of_sums * (run.t + std::abs(related.later));
  for (std::vector<compare::LoggedEvent>* events : {&a, &b})
    for (compare::LoggedEvent& event : *events) {
      if (std::isnan(event.uncertainty)) event.uncertainty = 0.0;
      if (event.t < result.until) slack = std::max(slack, event.uncertainty);
    }
  const compare::Alignment aligned = compare::align(a, b, {result.until, rounding_of_sums * run.t});
  for (const compare::AlignedPair& pair : aligned.pairs) {
    const compare::LoggedEvent &x = a[pair.reference], &y = b[pair.other];
    if (std::max(x.t, y.t) >= result.until) continue;
    ++result.events;
    // A going on begins from what a run of the first part left, which states nothing: its error there is another of the
    // whole's.
    const double before = related.from > 0.0 ? x.uncertainty : 0.0;
    const double allowed =
        x.uncertainty + y.uncertainty + before + rounding_of_sums * (run.t + std::abs(related.later));
    const double off = std::abs(x.t - y.t);
    result.worst = std::max(result.worst, off / allowed);
    if (off > allowed)
      exceeds(result, "time of an event",
              fmt::format("{} at {:.12g}, other at {:.12g}, {:.2g} allowed", x.name(), x.t, y.t, allowed),
              {x.t, off});
  }
  if (aligned.swapped > 0 && result.verdict == Class::same) result.verdict = Class::other_order;
  if (!aligned.split) return;
  const auto& split = *aligned.split;
  // What lies within its error of the end, or of where the second run begins, may lie on the other side of it.
  const bool at_edge = split.t + 2.0 * slack >= result.until || split.t - 2.0 * slack <= related.from;
  if (at_edge) return;
  const auto side = [](const std::vector<compare::LoggedEvent>& events, const std::optional<std::size_t>& i) {
    return i ? fmt::format("{:.12g} {}", events[*i].t, events[*i].name()) : std::string("none");
  };
  exceeds(result, "sequence", side(a, split.reference) + " | " + side(b, split.other), {split.t, never});
}

/// Do copies of the scene, every datum off by one rounding, part from each other as far by then?
bool RelationJudge::Members::copies_part(const Likeness::Parting& at) const {
  std::vector<SeenRun> copies;
  for (const std::uint64_t seed : {3U, 4U, 5U}) {
    SeenRun copy = see_plainly(disturbed(scene, seed), bounds);
    if (copy.end != Track::End::refused) copies.push_back(std::move(copy));
  }
  double most = 0.0;
  for (std::size_t i = 1; i < copies.size(); ++i) {
    const auto &a = copies[0].events, &b = copies[i].events;
    const compare::Alignment aligned = compare::align(a, b, {run.t, rounding_of_sums * run.t});
    if (aligned.split && aligned.split->t <= at.t * (1.0 + rounding_of_sums)) return true;
    for (const compare::AlignedPair& pair : aligned.pairs)
      if (a[pair.reference].t <= at.t * (1.0 + rounding_of_sums))
        most = std::max(most, std::abs(a[pair.reference].t - b[pair.other].t));
  }
  return of_roundings * most >= at.off;
}

void RelationJudge::Members::rows(const Related& related, const SeenRun& other, const Spread* as_written,
                                  Likeness& result) const {
  const Spread& allowances = of(related);
  const double same_time = 1e-9 * run.t;  // of rows; they are 200 apart
  std::size_t next = 0;
  std::vector<double> begun;  // what the first row has more than the other's
  for (std::size_t i = 0; i < run.rows.size(); ++i) {
    const double t = run.rows[i].t;
    if (t <= related.from + same_time || t >= result.until) continue;
    while (next < other.rows.size() && other.rows[next].t < t - same_time) ++next;
    if (next >= other.rows.size()) return;
    if (other.rows[next].t > t + same_time) continue;
    const bool at_event = near_event(run, t, run.t, std::abs(related.later)) ||
                          near_event(other, t, run.t, std::abs(related.later));
    for (std::size_t j = 0; j < run.columns.size(); ++j) {
      const SeenColumn& column = run.columns[j];
      if (at_event && column.jumps) continue;
      const bool energy = column.of == SeenColumn::Of::stored || column.of == SeenColumn::Of::spent;
      if (energy && !related.same_energy) continue;
      if (column.sums && related.from > 0.0) continue;
      double x = run.rows[i].values[j], y = other.rows[next].values[j];
      if (std::isnan(x) && std::isnan(y)) continue;
      const bool jumped_before = related.jumps_at_start && column.name == "works";
      if ((column.of == SeenColumn::Of::slip && related.from > 0.0) || jumped_before) {
        // It is counted from the beginning of each run.
        if (begun.size() <= j) begun.resize(run.columns.size(), std::nan(""));
        if (std::isnan(begun[j])) begun[j] = x - y;
        y += begun[j];
      }
      const double written = as_written != nullptr ? as_written->motion_up_to_instant(next)[j] : 0.0;
      const double allowed = allowances.rows[i][j] + written + floor[j], off = std::abs(x - y);
      if (off > 0.0) result.worst = std::max(result.worst, off / allowed);
      if (!(off <= allowed))
        exceeds(result, "row",
                fmt::format("{} at {:.9g}: {:.12g}, other {:.12g}, {:.2g} allowed", column.name, t, x, y,
                            allowed));
    }
  }
}

void RelationJudge::Members::figures(const Related& related, const SeenRun& other, const Spread* as_written,
                                     Likeness& result) const {
  const Spread& allowances = of(related);
  std::map<std::string, std::size_t> places;
  for (std::size_t j = 0; j < run.columns.size(); ++j) places[run.columns[j].name] = j;
  const auto look = [&](const char* of, const std::string& name, double x, double y, double allowed) {
    if (std::abs(x - y) > 0.0) result.worst = std::max(result.worst, std::abs(x - y) / allowed);
    if (!(std::abs(x - y) <= allowed))
      exceeds(result, of, fmt::format("{}: {:.12g}, other {:.12g}, {:.2g} allowed", name, x, y, allowed));
  };
  for (std::size_t i = 0; i < run.outputs.size(); ++i) {
    const std::size_t j = places.at(run.outputs[i]);
    if (run.columns[j].sums && related.from > 0.0) continue;
    const double written = as_written != nullptr ? as_written->extremes[i] + as_written->rows.back()[j] : 0.0;
    const double allowed = allowances.extremes[i] + allowances.rows.back()[j] + written + 10.0 * floor[j];
    double maximum = run.extremes[i].maximum, minimum = run.extremes[i].minimum;
    if (related.from == 0.0 && i < related.extremes_before.size()) {
      maximum = std::max(maximum, related.extremes_before[i].maximum);
      minimum = std::min(minimum, related.extremes_before[i].minimum);
    }
    look("extreme", run.outputs[i] + " maximum", maximum, other.extremes[i].maximum, allowed);
    look("extreme", run.outputs[i] + " minimum", minimum, other.extremes[i].minimum, allowed);
  }
  // At t = 0 a load that jumps has taken away what stood there; later its instant has both sides.
  if (related.from > 0.0 || related.jumps_at_start || !with_peaks) return;
  for (std::size_t k = 0; k < run.contacts.size(); ++k) {
    const std::size_t j = places.at(run.contacts[k] + ".N");
    const double allowed = allowances.peaks[k] +
                           std::max(allowances.rows.back()[j], allowances.rows.back()[j + 1]) +
                           10.0 * floor[j];
    look("peak", run.contacts[k] + " N", run.peaks[k].N, other.peaks[k].N, allowed);
    look("peak", run.contacts[k] + " T", run.peaks[k].T, other.peaks[k].T, allowed);
  }
}

RelationJudge::RelationJudge(Scene scene, const Bounds& bounds, bool with_peaks)
    : m_(std::make_unique<Members>()) {
  m_->with_peaks = with_peaks;
  m_->scene = std::move(scene);
  m_->bounds = bounds;
  m_->run = see(m_->scene, bounds);
  if (m_->run.end == Track::End::refused) return;
  // Two runs of ida err by so much a step even where the exact flow is near one of them.
  const double relative = m_->scene.run.engine == Engine::ida ? of_steps * m_->scene.run.rtol : 0.0;
  const Model model = build_model(m_->scene);
  m_->open_start = !model.statics.undetermined.empty();
  m_->shared_motion = shares_motion(model);
  const double in_steps = rounding_of_steps(m_->scene.run);
  m_->floor = floors(m_->run, model.scales, std::max(rounding_of_sums, in_steps) + relative);
  const double reached = greatest_displacement(m_->run);
  for (std::size_t j = 0; j < m_->floor.size(); ++j)
    m_->floor[j] += rounding_of_element(model, m_->run.columns[j], reached, in_steps);
}

RelationJudge::~RelationJudge() = default;
const Scene& RelationJudge::scene() const { return m_->scene; }
const SeenRun& RelationJudge::run() const { return m_->run; }

void RelationJudge::Members::all(const Related& related, const SeenRun& other, const Spread* as_written,
                                 Likeness& result) const {
  result.until = std::min(run.until, other.until);
  events(related, other, result);
  rows(related, other, as_written, result);
  const double roundoff = rounding_of_sums * (run.t + std::abs(related.later));
  const bool to_end = result.until >= scene.run.t_end - roundoff;
  if (to_end) figures(related, other, as_written, result);
  if (result.verdict == Class::unexplained) return;
  if (run.end == Track::End::stopped || other.end == Track::End::stopped) {
    const bool alike = run.end == other.end && run.reason == other.reason;
    const double first_stop = std::min(run.end == Track::End::stopped ? run.t : never,
                                       other.end == Track::End::stopped ? other.t : never);
    if (alike)
      result.verdict = Class::stopped_alike;
    else
      result.verdict = result.until < first_stop - roundoff ? Class::ended_before : Class::stopped_one_side;
    result.what = "first: " + run.said + " | other: " + other.said;
  } else if (!to_end && result.verdict == Class::same) {
    result.verdict = Class::ended_before;
  }
}

namespace {

void write_back(const SeenRun& first, const Related& related, SeenRun& other) {
  WrittenBack back(first, related, other);
  back.events();
  back.rows();
  back.figures();
}

/// With rows at the times of the first one's.
Scene with_rows_of(const SeenRun& run, const Related& related) {
  Scene other = related.scene;
  std::vector<double> times;
  for (const SeenRun::Row& row : run.rows)
    if (const double t = (row.t + related.later) * related.factors.time; t >= 0.0 && t < other.run.t_end)
      times.push_back(t);
  if (times.empty()) return other;
  other.run.output_dt.reset();
  other.run.output_times = std::move(times);
  return other;
}

}  // namespace

/// In its own numbers the other scene may be worse conditioned: along the axes a beam's bending has the rounding of EI, turned
/// it has that of EA, too; and `ida` takes other steps there. Copies are held against each other: beside the run that is
/// judged, what is wrong in it would be in the spread, and allow itself.
Spread RelationJudge::Members::spread_of(const Related& related, std::size_t count) const {
  std::vector<SeenRun> copies;
  for (const Scene& copy : copies_of(with_rows_of(run, related), count)) {
    SeenRun near = see_plainly(copy, bounds);
    if (near.end == Track::End::refused) continue;
    write_back(run, related, near);
    copies.push_back(std::move(near));
  }
  Spread result;
  const double factor = scene.run.engine == Engine::ida ? of_steps : of_roundings;
  for (std::size_t i = 1; i < copies.size(); ++i) result.include(copies[0], copies[i], factor);
  return result;
}

Likeness RelationJudge::compare(const Related& related) const {
  return compare(related, see(with_rows_of(m_->run, related), m_->bounds));
}

Likeness RelationJudge::compare(const Related& related, SeenRun other) const {
  const bool told = m_->run.shared || other.shared, open_there = other.open_start;
  Likeness result = compared(related, std::move(other));
  const bool one_side =
      result.verdict == Class::refused_one_side || result.verdict == Class::stopped_one_side;
  const bool by_start = m_->shared_motion && (one_side || m_->scene.initial.is_frictional);
  const bool by_run = m_->shared_motion && told && result.of == "sequence";
  if (!is_explained(result.verdict) && (m_->open_start || (one_side && open_there) || by_start || by_run))
    result.verdict = Class::undetermined;
  return result;
}

Likeness RelationJudge::compared(const Related& related, SeenRun other) const {
  Likeness result;
  if (m_->ends_differ(other, result)) return result;
  write_back(m_->run, related, other);
  m_->all(related, other, nullptr, result);
  const bool by_rows = result.of == "row" || result.of == "extreme" || result.of == "peak";
  if (result.of == "sequence" || result.of == "time of an event") {
    if (m_->copies_part(result.at)) result.verdict = Class::understated;
    return result;
  }
  if (!by_rows) return result;
  // Few copies may lie close together by chance.
  for (const std::size_t count : {few_copies, many_copies}) {
    const Spread as_written = m_->spread_of(related, count);
    if (as_written.rows.empty()) return result;
    Likeness again;
    m_->all(related, other, &as_written, again);
    if (is_explained(again.verdict) || count == many_copies) return again;
  }
  return result;
}

}  // namespace signorini::differential
