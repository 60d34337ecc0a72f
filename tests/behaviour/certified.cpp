// Certified runs on cases with exact answers: what is called certain is right, and within its bound.
#include <doctest/doctest.h>
#include <fmt/core.h>
#include <sched.h>

#include <cmath>
#include <map>

#include "behaviour/reference.hpp"
#include "behaviour/scene_parts.hpp"
#include "differential/generator.hpp"
#include "signorini/certify.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

struct CertifiedCase {
  Scene scene;
  Model model;
  Result rows;
  Certificate certificate;
};

CertifiedCase certified(const std::string& name, std::vector<Override> overrides) {
  overrides.push_back({"run.certify", "true"});
  CertifiedCase c;
  c.scene = read_scene(std::string(SIGNORINI_TEST_DATA) + "/cases/" + name + ".toml", overrides);
  c.model = build_model(c.scene);
  CertifiedReport run = simulate_certified(c.model, c.scene.run, c.rows);
  REQUIRE(run.certificate);
  c.certificate = std::move(*run.certificate);
  return c;
}

/// This process has one processor as long as it lives.
class OneProcessor {
 public:
  OneProcessor() {
    REQUIRE(sched_getaffinity(0, sizeof all_, &all_) == 0);
    int first = 0;
    while (!CPU_ISSET(first, &all_)) ++first;
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(first, &one);
    REQUIRE(sched_setaffinity(0, sizeof one, &one) == 0);
  }
  ~OneProcessor() { sched_setaffinity(0, sizeof all_, &all_); }
  OneProcessor(const OneProcessor&) = delete;
  OneProcessor& operator=(const OneProcessor&) = delete;

 private:
  cpu_set_t all_;
};

struct Judged {
  std::size_t certain = 0, expected = 0, wrong = 0, outside = 0;
};

/// Certain events against the answer: each contact's events in their order.
Judged judged(const CertifiedCase& c, const std::string& name) {
  const Table answer = read_csv(std::string(SIGNORINI_TEST_DATA) + "/cases/" + name + ".events.csv");
  std::map<std::string, std::vector<std::size_t>> rows;
  for (std::size_t i = 0; i < answer.rows; ++i) rows[answer.text("contact", i)].push_back(i);
  std::map<std::string, std::size_t> next;
  Judged result;
  result.expected = answer.rows;
  for (std::size_t i = 0; i < c.rows.events.size(); ++i) {
    const Event& event = c.rows.events[i];
    if (event.type == EventType::time || !c.certificate.certain(i)) continue;
    ++result.certain;
    const std::string& contact = c.model.contacts[static_cast<std::size_t>(event.contact)].name;
    const std::size_t number = next[contact]++;
    const auto& list = rows[contact];
    if (number >= list.size() || answer.text("from", list[number]) != to_string(event.from) ||
        answer.text("to", list[number]) != to_string(event.to)) {
      ++result.wrong;
      continue;
    }
    // the answers have 11 to 14 digits
    const double off = std::abs(event.t - answer.number("t", list[number]));
    if (off > c.certificate.t_errors[i] + 1e-10) ++result.outside;
  }
  return result;
}

/// All events are certain, right, and within their bounds.
void check_all_right(const CertifiedCase& c, const std::string& name) {
  const Judged j = judged(c, name);
  INFO(c.certificate.reason);
  CHECK(c.certificate.complete);
  CHECK(j.certain == j.expected);
  CHECK(j.wrong == 0);
  CHECK(j.outside == 0);
}

/// Changes of state of the contacts.
std::vector<Event> changes_of(const Result& rows) {
  std::vector<Event> list;
  for (const Event& event : rows.events)
    if (event.type != EventType::time) list.push_back(event);
  return list;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/certified");

TEST_CASE("a run that takes few steps does not wait for a companion that takes many") {
  // A machine on mounts of 1e12 N/m: ida passes over the vibration at 22.5 kHz, the series of exact follow it.
  const std::string text =
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\ngravity = [0.0, "
      "-9.81]\n"
      "run = { t_end = 60.0, initial = \"static\", engine = \"ida\" }\nnodes = { plate = [0.0, 0.0], head = "
      "[0.0, 1.0] }\n"
      "masses = [{ node = \"plate\", mass = 50.0 }, { node = \"head\", mass = 500.0 }]\n"
      "supports = [{ nodes = [\"plate\", \"head\"], fix = [\"ux\"] }]\n"
      "springs = [{ node = \"head\", against = \"plate\", direction = [0.0, 1.0], stiffness = 2e4, damping = "
      "2e3 }]\n"
      "loads = [{ node = \"head\", direction = [0.0, 1.0], amplitude = 1e3, history = { type = \"harmonic\", "
      "frequency = 0.2 } }]\n[[contacts]]\nname = \"mount\"\nnode = \"plate\"\nlaw = \"compliant\"\n"
      "normal = [0.0, 1.0]\nnormal_stiffness = 1e12\n";
  const auto run = [&](const std::string& t_end) {
    const Scene scene = parse_scene(text, "test.toml", {{"run.t_end", t_end}});
    Result rows;
    return simulate_certified(build_model(scene), scene.run, rows);
  };
  const CertifiedReport longer = run("60");
  CHECK_FALSE(longer.certificate);
  CHECK(longer.reason.find("a companion run (exact) would take") != std::string::npos);
  CHECK(longer.report.counters.steps < 10000);
  CHECK(run("1").certificate);  // its companion takes less than half a second
}

TEST_CASE("certified: all events of quiet cases, each within its bound, with either companion") {
  for (const char* name :
       {"01a_coulomb_decay_rigid", "01b_coulomb_decay_compliant", "02b_belt_fs_gt_fk", "03b_den_hartog_2stop",
        "04c_impact_oscillator_e0", "05b_two_mass_symmetric", "06_point_compliant_kn1e+06"})
    for (const char* companion : {"exact", "finer"}) {
      CAPTURE(name);
      CAPTURE(companion);
      const CertifiedCase c =
          certified(name, {{"run.engine", "ida"}, {"run.rtol", "1e-6"}, {"run.companion", companion}});
      check_all_right(c, name);
    }
}

TEST_CASE("certified: a chain that amplifies errors is certain up to where it goes wrong") {
  const std::string name = "10a_bk_chain_20";
  const CertifiedCase c = certified(name, {{"run.engine", "ida"}, {"run.rtol", "1e-6"}});
  const Judged j = judged(c, name);
  CHECK_FALSE(c.certificate.complete);
  CHECK(c.certificate.until > 5.0);
  CHECK(c.certificate.until < 100.0);
  CHECK_FALSE(c.certificate.reason.empty());
  CHECK(j.certain > 20);
  CHECK(j.wrong == 0);
  CHECK(j.outside == 0);
  REQUIRE(c.certificate.first_uncertain);
  CHECK(c.rows.events[*c.certificate.first_uncertain].t >= c.certificate.until - 1e-3);
}

TEST_CASE("certified: rebounds that come ever faster, until they rest") {
  for (const std::string name : {"04a_bouncing_ball", "06_point_rigid_e0.5"}) {
    CAPTURE(name);
    const CertifiedCase c = certified(name, {{"run.engine", "ida"}, {"run.rtol", "1e-8"}});
    check_all_right(c, name);
  }
}

TEST_CASE("certified: displacements and velocities at output times lie within errors.csv") {
  const std::string name = "07_frame_4el_kn1e6_f0.3";
  const CertifiedCase c = certified(name, {{"run.engine", "ida"}, {"run.rtol", "1e-6"}});
  const Table answer = read_csv(std::string(SIGNORINI_TEST_DATA) + "/cases/" + name + ".samples.csv");
  REQUIRE(c.certificate.history.t.size() == c.rows.rows.size());
  const Vector moved = moved_start(c.model, answer, c.rows);
  std::size_t compared = 0, outside = 0;
  for (std::size_t row = 0; row < std::min(answer.rows, c.rows.rows.size()); ++row) {
    if (!(c.rows.rows[row].t < std::min(c.certificate.until, 0.45))) break;
    for (std::size_t j = 0; j < c.model.columns.size(); ++j) {
      const Column& column = c.model.columns[j];
      const Result::Row& r = c.rows.rows[row];
      const double value = column.velocity ? r.v[column.dof] : r.u[column.dof] - moved[column.dof];
      const double off = std::abs(value - answer.number(column.name, row));
      const double bound = c.certificate.history.at(row, j);
      REQUIRE(std::isfinite(bound));
      ++compared;
      outside += off > bound + 1e-10 ? 1 : 0;
    }
  }
  CHECK(compared > 100);
  CHECK(static_cast<double>(outside) <= 0.001 * static_cast<double>(compared));
}

TEST_CASE("certified: exact beside itself, every datum off by one rounding") {
  const std::string name = "05g_two_mass_compliant";
  const CertifiedCase c = certified(name, {{"run.engine", "exact"}});
  CHECK(c.certificate.factor == 5.0);
  check_all_right(c, name);
}

// On one, both companions follow the run; on two, the first is beside it, and the second begins when the run has ended.
TEST_CASE("certified: the same on one processor as on all") {
  const std::vector<Override> engine = {{"run.engine", "exact"}};
  const auto alone = [&] {
    const OneProcessor one;
    return certified("10a_bk_chain_20", engine);
  }();
  const CertifiedCase c = certified("10a_bk_chain_20", engine);
  const Certificate &a = alone.certificate, &b = c.certificate;
  CHECK(b.complete);
  CHECK(b.certain_events() > 20);
  CHECK(a.certain_events() == b.certain_events());
  CHECK(a.until == b.until);
  CHECK(a.reason == b.reason);
  CHECK(a.unordered == b.unordered);
  CHECK(a.history.bounds == b.history.bounds);
  REQUIRE(a.t_errors.size() == b.t_errors.size());
  for (std::size_t i = 0; i < b.certain_events(); ++i) CHECK(a.t_errors[i] == b.t_errors[i]);
}

TEST_CASE("certified: newmark beside half its step") {
  const std::string name = "01b_coulomb_decay_compliant";
  const CertifiedCase c =
      certified(name, {{"run.engine", "newmark"}, {"run.dt", "1e-3"}, {"run.companion", "finer"}});
  check_all_right(c, name);
}

// dt times the fastest decay is 3 to 67 there: steps and half steps ring alike, and make the same events that are none.
TEST_CASE("certified: what steps do not resolve is not certain, whoever judges it") {
  struct Ringing {
    const char *file, *dt;
  };
  for (const Ringing& ringing :
       {Ringing{"ringing_node", "1.6666e-4"}, Ringing{"ringing_shear", "3.3333e-4"}}) {
    const std::string path = SIGNORINI_TEST_DATA "/scenes/certified/" + std::string(ringing.file) + ".toml";
    const Scene exact = read_scene(path, {{"run.engine", "exact"}, {"run.certify", "false"}});
    const std::vector<Event> truth = changes_of(simulate(build_model(exact), exact.run));
    REQUIRE(truth.size() > 3);
    for (const char* companion : {"auto", "finer"}) {
      CAPTURE(ringing.file);
      CAPTURE(companion);
      const Scene scene = read_scene(path, {{"run.engine", "newmark"},
                                            {"run.dt", ringing.dt},
                                            {"run.certify", "true"},
                                            {"run.companion", companion}});
      Result rows;
      const CertifiedReport run = simulate_certified(build_model(scene), scene.run, rows);
      REQUIRE(run.certificate);
      const Certificate& certificate = *run.certificate;
      CHECK_FALSE(certificate.complete);
      if (std::string(companion) == "finer") {
        CHECK(certificate.until == 0.0);
        CHECK(certificate.reason.find("does not resolve the fastest decay") != std::string::npos);
      }
      for (std::size_t i = 0; i < rows.events.size(); ++i) {
        const Event& event = rows.events[i];
        if (!certificate.certain(i) || event.type == EventType::time) continue;
        CHECK(std::any_of(truth.begin(), truth.end(), [&](const Event& right) {
          return right.contact == event.contact && right.type == event.type &&
                 std::abs(right.t - event.t) <= certificate.t_errors[i];
        }));
      }
    }
  }
}

// Two oscillators that nothing couples, and a stop for their sum: u = a sin(7 t) + b sin(7.35 t), a = b = 1 reaches 2 at t = 0.2187,
// and touches the stop by 1e-7 and by 1e-10 of that. Run and companion pass by, each by its own error.
TEST_CASE("certified: a hit that just grazes is not missed by a companion that errs as much") {
  for (const char* gap : {"1.9985331349765365", "1.9985332348765366"})
    for (const char* rtol : {"1e-6", "1e-8"}) {
      CAPTURE(std::string(gap));
      CAPTURE(std::string(rtol));
      const Scene scene = parse_scene(
          parts::head +
              "[run]\nt_end = 40.0\noutput_dt = 1.0\ninitial = { u = [0.0, 0.0], v = [7.0, 7.35] "
              "}\n[matrices]\n"
              "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[49.0, 0.0], [0.0, "
              "54.0225]]\n[[contacts]]\nname = \"c\"\n"
              "law = \"rigid\"\nrestitution = 0.5\nnormal = { d0 = -1.0, d1 = -1.0 }\ngap = " +
              gap + "\n",
          "test.toml",
          {{"run.engine", "ida"}, {"run.rtol", rtol}, {"run.certify", "true"}, {"run.companion", "finer"}});
      const Scene exact = [&] {
        Scene other = scene;
        other.run.engine = Engine::exact;
        other.run.certify = Certify::no;
        return other;
      }();
      const std::vector<Event> truth = changes_of(simulate(build_model(exact), exact.run));
      REQUIRE_FALSE(truth.empty());
      Result rows;
      const CertifiedReport run = simulate_certified(build_model(scene), scene.run, rows);
      REQUIRE(run.certificate);
      // Every hit before the end of the certain part is there.
      const std::vector<Event> found = changes_of(rows);
      for (std::size_t i = 0; i < truth.size() && truth[i].t < run.certificate->until; ++i) {
        REQUIRE(i < found.size());
        CHECK(found[i].t == doctest::Approx(truth[i].t).epsilon(1e-3));
      }
    }
}

// Rough runs: steps of 1 ms whatever the frequencies, or a tolerance of 1e-4 for thousands of hits.
TEST_CASE("certified: no event before the end of the certain part is uncertain") {
  struct Rough {
    std::uint64_t seed;
    const char *engine, *path, *value;
  };
  for (const Rough& rough : {Rough{14, "newmark", "run.dt", "1e-3"}, Rough{19, "newmark", "run.dt", "1e-3"},
                             Rough{23, "newmark", "run.dt", "1e-3"}, Rough{23, "ida", "run.rtol", "1e-4"}}) {
    CAPTURE(rough.seed);
    const Scene scene =
        parse_scene(differential::draw_scene(rough.seed), "rough.toml",
                    {{"run.engine", rough.engine}, {rough.path, rough.value}, {"run.certify", "true"}});
    const Model model = build_model(scene);
    Result rows;
    const CertifiedReport run = simulate_certified(model, scene.run, rows);
    REQUIRE(run.certificate);
    const Certificate& certificate = *run.certificate;
    CHECK_FALSE(certificate.complete);
    for (std::size_t i = 0; i < rows.events.size() && rows.events[i].t < certificate.until; ++i)
      CHECK(certificate.certain(i));
    const HistoryErrors& errors = certificate.history;
    for (std::size_t row = 0; row < errors.t.size() && errors.t[row] < certificate.until; ++row)
      for (std::size_t j = 0; j < errors.width; ++j) CHECK(std::isfinite(errors.at(row, j)));
  }
}

// Random scene 23: a block that throws itself up 3000 times without losing energy. Its run leaves flights to
// the series that a companion at rtol / 100 would integrate, and so be the worse of the two: 12 events at
// 1e-6 and 1090 at 1e-10 lay outside of their bounds.
TEST_CASE("certified: a finer companion of thousands of low flights is the finer") {
  const std::string path = SIGNORINI_TEST_DATA "/scenes/certified/low_flights.toml";
  const Scene exact = read_scene(path, {{"run.engine", "exact"}});
  const std::vector<Event> truth = changes_of(simulate(build_model(exact), exact.run));
  REQUIRE(truth.size() > 3000);
  for (const char* rtol : {"1e-6", "1e-10"}) {
    CAPTURE(rtol);
    const Scene scene = read_scene(
        path,
        {{"run.engine", "ida"}, {"run.rtol", rtol}, {"run.certify", "true"}, {"run.companion", "finer"}});
    Result rows;
    const CertifiedReport run = simulate_certified(build_model(scene), scene.run, rows);
    REQUIRE(run.certificate);
    std::size_t next = 0, certain = 0, outside = 0;
    for (std::size_t i = 0; i < rows.events.size(); ++i) {
      if (rows.events[i].type == EventType::time || !run.certificate->certain(i)) continue;
      REQUIRE(next < truth.size());
      const Event& right = truth[next++];
      REQUIRE(rows.events[i].to == right.to);
      ++certain;
      outside += std::abs(rows.events[i].t - right.t) > run.certificate->t_errors[i] ? 1 : 0;
    }
    CHECK(certain > 3000);
    CHECK(outside == 0);
  }
}

// Random scene 165: forces of rigid contacts are known to m v eps / h. Below that no step passed the error
// test, and smaller steps made it worse: after 1.1 million steps the run stood at 1.6 s.
TEST_CASE("certified: a companion at rtol 1e-12 comes to its end where a rigid contact holds what moves") {
  class Bounded : public Recorder {
   public:
    void event(const Event& /*event*/) override {}
    void sample(const Sample& /*sample*/) override {}
    bool progress(double /*t*/) override { return ++steps < 100000; }
    long steps = 0;
  };
  const Scene scene = read_scene(SIGNORINI_TEST_DATA "/scenes/certified/held_and_moving.toml",
                                 {{"run.engine", "ida"}, {"run.rtol", "1e-12"}});
  Bounded recorder;
  const Report report = simulate(build_model(scene), scene.run, recorder);
  CHECK(report.outcome.kind == Outcome::Kind::done);
  CHECK(report.counters.steps < 100000);
}

// Against the full model by the exact flow, up to where the two sequences part.
TEST_CASE("certified: what a reduced model leaves out moves contacts and forces by less than it says") {
  const auto computed = [](const char* cutoff) {
    std::vector<Override> changes = {
        {"run.engine", "exact"}, {"run.t_end", "0.15"}, {"run.output_dt", "2e-4"}, {"run.certify", "true"}};
    if (cutoff != nullptr) changes.push_back({"reduction.cutoff_omega", cutoff});
    CertifiedCase c;
    c.scene = read_scene(SIGNORINI_MODELS "/pipeline.toml", changes);
    c.model = build_model(c.scene);
    CertifiedReport run = simulate_certified(c.model, c.scene.run, c.rows);
    REQUIRE(run.certificate);
    c.certificate = std::move(*run.certificate);
    return c;
  };
  const CertifiedCase full = computed(nullptr);
  CHECK_FALSE(full.certificate.reduction);
  const std::vector<Event> right = changes_of(full.rows);
  for (const char* cutoff : {"2000", "8000", "22000"}) {
    CAPTURE(cutoff);
    const CertifiedCase part = computed(cutoff);
    REQUIRE(part.certificate.reduction);
    const std::vector<Event> found = changes_of(part.rows);
    std::size_t n = 0;
    while (n < std::min(right.size(), found.size()) && right[n].contact == found[n].contact &&
           right[n].from == found[n].from && right[n].to == found[n].to)
      ++n;
    const double until = n < std::min(right.size(), found.size()) ? std::min(right[n].t, found[n].t) : 0.15;
    CHECK(until > 0.05);
    double moved = 0.0, pushed = 0.0;
    for (std::size_t row = 0; row < full.rows.rows.size() && full.rows.rows[row].t < until; ++row) {
      const Result::Row &a = full.rows.rows[row], &b = part.rows.rows[row];
      for (const Column& column : full.model.columns)
        if (!column.velocity && !full.model.is_rotation(column))
          moved = std::max(moved, std::abs(a.u[column.dof] - b.u[column.dof]));
      for (std::size_t k = 0; k < a.contacts.size(); ++k)
        pushed = std::max({pushed, std::abs(a.contacts[k].N - b.contacts[k].N),
                           std::abs(a.contacts[k].T - b.contacts[k].T)});
    }
    const Truncation& said = *part.certificate.reduction;
    CHECK(moved <= said.displacement);
    CHECK(said.displacement < 50.0 * moved);  // an estimate that says something
    CHECK(pushed <= said.force);
    CHECK(said.force < 50.0 * pushed);
  }
}

TEST_CASE("certified: the run itself is the same to the last digit, and auto leaves dear companions out") {
  const std::string path = std::string(SIGNORINI_TEST_DATA) + "/cases/02b_belt_fs_gt_fk.toml";
  const Scene scene = read_scene(path, {{"run.engine", "ida"}});
  const Model model = build_model(scene);
  const Result plain = simulate(model, scene.run);
  Result beside;
  const CertifiedReport run = simulate_certified(model, scene.run, beside);
  REQUIRE(run.certificate);  // auto: exact is cheap
  REQUIRE(plain.events.size() == beside.events.size());
  for (std::size_t i = 0; i < plain.events.size(); ++i) CHECK(plain.events[i].t == beside.events[i].t);
  const Scene exact = read_scene(path, {{"run.engine", "exact"}});
  const CertifiedReport alone = simulate_certified(model, exact.run, beside);
  CHECK_FALSE(alone.certificate);
  CHECK(alone.reason.find("2 times as long as the run") != std::string::npos);
}

// A foot that rests on its ground without force at the start and opens for 3e-5 s, 5e-11 m high (random scene 411).
// At 1e-6 its force is below the run's tolerance all the while, and at 1e-8 below that of the companion: both miss
// it, and call its second opening the first.
TEST_CASE("certified: what neither the run nor its companion can see is not certain") {
  const char* text = R"(
    schema = 1
    units = { force = "N", mass = "kg", length = "m", time = "s" }
    gravity = [0.0, -9.81]
    run = { t_end = 0.01, engine = "ida", certify = true, initial = { B = { vx = -0.2, vy = -0.22 } } }
    sections.beam = { EA = 10000, EI = 500, mass_per_length = 4 }
    damping = { alpha = 10, beta = 0.0001 }
    nodes = { A = [0, 0], B = [0.775, 0], D = [1.55, 0] }
    members = [ { nodes = ["A", "B", "D"], section = "beam", elements = 2 } ]
    supports = [ { node = "A", fix = ["ux", "uy", "rz"] } ]
    [base_motion]
    direction = [1.0, 0.2]
    acceleration = { type = "harmonic", amplitude = 11.2265, omega = 202.64 }
    [[loads]]
    node = "B"
    direction = [-0.5, -1]
    amplitude = 198.12
    history = { type = "harmonic", omega = 88.03, phase = 0 }
    [[contacts]]
    name = "footD"
    node = "D"
    law = "compliant"
    normal = [0.0, 1.0]
    gap = 0
    normal_stiffness = 10000
    tangential_stiffness = 10000
    normal_damping = 10
    friction = 0
  )";
  const auto run = [&](const char* rtol, const char* companion) {
    const Scene scene = parse_scene(text, "foot.toml", {{"run.rtol", rtol}, {"run.companion", companion}});
    CertifiedCase c{scene, build_model(scene), {}, {}};
    c.certificate = std::move(*simulate_certified(c.model, scene.run, c.rows).certificate);
    return c;
  };
  const CertifiedCase blind = run("1e-4", "finer"), sharp = run("1e-10", "finer"),
                      exact = run("1e-6", "exact");
  REQUIRE(sharp.rows.events.size() == 3);
  CHECK(sharp.certificate.certain(2));
  CHECK(sharp.rows.events[0].t == doctest::Approx(1.4233069086e-4).epsilon(1e-8));
  REQUIRE(blind.rows.events.size() == 1);
  CHECK_FALSE(blind.certificate.certain(0));
  CHECK(blind.certificate.until == doctest::Approx(sharp.rows.events[1].t).epsilon(0.5));
  CHECK(blind.certificate.reason.find(
            "the compression of 'footD' is zero within the companion's tolerance") == 0);
  CHECK_FALSE(exact.certificate.certain(0));
}

TEST_CASE("certified: a run that is interrupted ends its companion") {
  class Impatient : public Recorder {
   public:
    void event(const Event& /*event*/) override { ++events; }
    void sample(const Sample& /*sample*/) override {}
    bool progress(double t) override { return t < 3.0; }
    int events = 0;
  };
  const Scene scene = read_scene(std::string(SIGNORINI_TEST_DATA) + "/cases/02b_belt_fs_gt_fk.toml",
                                 {{"run.engine", "ida"},
                                  {"run.t_end", "1e7"},

                                  {"run.certify", "true"},
                                  {"run.companion", "finer"}});
  Impatient recorder;
  const CertifiedReport run = simulate_certified(build_model(scene), scene.run, recorder);
  CHECK(run.report.outcome.kind == Outcome::Kind::interrupted);
  REQUIRE(run.certificate);
  CHECK(run.certificate->until <= run.report.outcome.t);
}
