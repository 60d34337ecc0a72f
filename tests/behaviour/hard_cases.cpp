#include "behaviour/hard_cases.hpp"
#include "base/eigen_dense.hpp"

#include <fmt/core.h>

#include <Eigen/LU>  // inverses of small matrices
#include <cmath>
#include <limits>
#include <numbers>

#include "behaviour/one_mass.hpp"

namespace signorini::tests {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double wrong = std::numeric_limits<double>::infinity();  // another sequence, or a run that stopped

const std::string one_mass = "mass = [[1.0]]\nstiffness = [[0.0]]";
const std::string two_masses = "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[0.0, 0.0], [0.0, 0.0]]";

std::string constant_load(const char* dof, double value) {
  return fmt::format("[[loads]]\ndirection = {{ {} = 1.0 }}\namplitude = {}\n", dof, value);
}

std::string floor(const char* name, const char* dof, const std::string& more) {
  return fmt::format("[[contacts]]\nname = \"{}\"\nlaw = \"rigid\"\nnormal = {{ {} = 1.0 }}\n{}\n", name, dof,
                     more);
}

bool ended(const Result& r) { return r.report.outcome.kind == Outcome::Kind::done; }

/// e = 0.8, dropped from 1 m: rests at sqrt(2 h/g) (1 + e)/(1 - e), but for the 2 v/(g (1 - e)) = 1.02e-9 s
/// that bounces slower than v = 1e-9 m/s would still take.
double bouncing_ball(const std::string& engine, double) {
  const Result r = run_text(matrix_scene("t_end = 5.0\ninitial = { u = [1.0], v = [0.0] }", one_mass,
                                         "law = \"rigid\"\nnormal = { d0 = 1.0 }\nrestitution = 0.8\n"
                                         "capture_velocity = 1e-9",
                                         constant_load("d0", -9.81)),
                            engine);
  if (!ended(r) || r.events.empty() || r.events.back().to != State::closed || r.rows.back().u[0] != 0.0)
    return wrong;
  return std::abs(r.events.back().t - std::sqrt(2.0 / 9.81) * 9.0);
}

/// cos t against a stop that it passes by 1e-8: time times rate.
double graze(const std::string& engine, double) {
  const double d = 1e-8;
  const Result r = run_text(
      matrix_scene(
          "t_end = 6.0\noutput_times = [6.0]\ninitial = { u = [1.0], v = [0.0] }",
          "mass = [[1.0]]\nstiffness = [[1.0]]",
          fmt::format("law = \"rigid\"\nnormal = {{ d0 = 1.0 }}\ngap = {}\nrestitution = 1.0", 1.0 - d)),
      engine);
  if (!ended(r) || r.events.size() != 1) return wrong;
  return std::abs(r.events[0].t - std::acos(-(1.0 - d))) * std::sqrt(2.0 * d - d * d);
}

/// Two balls that land at times `apart` from each other.
double two_balls(const std::string& engine, double apart) {
  const double first = std::sqrt(0.2), second = first + apart;
  const Result r =
      run_text(matrix_scene(fmt::format("t_end = 1.0\ninitial = {{ u = [1.0, {:.17g}], v = [0.0, 0.0] }}",
                                        5.0 * second * second),
                            two_masses, "law = \"rigid\"\nnormal = { d0 = 1.0 }",
                            floor("d", "d1", "") + constant_load("d0", -10.0) + constant_load("d1", -10.0)),
               engine);
  if (!ended(r) || r.events.size() != 2 || r.events[0].to != State::closed || r.events[1].to != State::closed)
    return wrong;
  return std::abs(r.events[1].t - r.events[0].t - apart);
}

/// A rigid bar that falls flat on two feet, e = 0.5, to rest: the angle that it has turned by.
double flat_bar(const std::string& engine, double) {
  std::string text = matrix_scene(
      "t_end = 3.0\ninitial = { u = [1.0, 0.0], v = [0.0, 0.0] }",
      "mass = [[2.0, 0.0], [0.0, 2.0]]\nstiffness = [[0.0, 0.0], [0.0, 0.0]]",
      "law = \"rigid\"\nnormal = { d0 = 1.0, d1 = 1.0 }\nrestitution = 0.5",
      "[[contacts]]\nname = \"d\"\nlaw = \"rigid\"\nnormal = { d0 = 1.0, d1 = -1.0 }\nrestitution = 0.5\n" +
          constant_load("d0", -20.0));
  const Result r = run_text(text, engine);
  if (!ended(r) || r.rows.back().contacts[0].state != State::closed || r.events.size() % 2 != 0) return wrong;
  for (std::size_t i = 0; i + 1 < r.events.size(); i += 2)
    if (r.events[i].t != r.events[i + 1].t) return wrong;
  return std::abs(r.rows.back().u[1]);
}

/// A hit at t = 1, which is an output time and the peak of a triangular load; one 1e-9 s after the start.
double awkward_times(const std::string& engine, double) {
  const Result peak = run_text(
      matrix_scene(
          "t_end = 2.0\noutput_dt = 0.5\ninitial = { u = [1.0], v = [0.0] }", one_mass,
          "law = \"rigid\"\nnormal = { d0 = 1.0 }\nrestitution = 1.0",
          // u'' = -6 t up to t = 1
          "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = -6.0\nhistory = { type = \"triangle\", end = "
          "2.0 }\n"),
      engine);
  const Result first = run_text(matrix_scene("t_end = 1.0\ninitial = { u = [1e-9], v = [-1.0] }", one_mass,
                                             "law = \"rigid\"\nnormal = { d0 = 1.0 }"),
                                engine);
  if (!ended(peak) || !ended(first) || peak.events.size() != 1 || first.events.size() != 1) return wrong;
  return std::max(std::abs(peak.events[0].t - 1.0), std::abs(first.events[0].t - 1e-9));
}

/// v = ((t - 1)^2 - e^2)/2 dips below zero for 2 e; the block sticks for e = 1e-4.
double short_stick(const std::string& engine, double) {
  const double e = 1e-4;
  const Result r = run_text(
      matrix_scene(
          fmt::format("t_end = 2.0\noutput_times = [2.0]\ninitial = {{ u = [0.0, 0.0], v = [{}, 0.0] }}",
                      0.5 * (1.0 - e * e)),
          two_masses, "law = \"rigid\"\nnormal = { d1 = 1.0 }\ntangent = { d0 = 1.0 }\nfriction = 1.0",
          constant_load("d1", -1.0) + "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 1.0\nhistory = { "
                                      "type = \"polynomial\", coefficients = [0.0, 1.0] }\n"),
      engine);
  if (!ended(r) || r.events.size() != 2) return wrong;
  return std::max(std::abs(r.events[0].t - (1.0 - e)) * e, std::abs(r.events[1].t - 1.0));
}

/// A push whose amplitude is exactly the friction limit never moves the block.
double at_the_limit(const std::string& engine, double) {
  const Result r =
      run_text(matrix_scene("t_end = 50.0", two_masses,
                            "law = \"rigid\"\nnormal = { d1 = 1.0 }\ntangent = { d0 = 1.0 }\nfriction = 0.5",
                            constant_load("d1", -1.0) +
                                "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 0.5\nhistory = { "
                                "type = \"harmonic\", omega = 3.0 }\n"),
               engine);
  if (!ended(r)) return wrong;
  return std::abs(r.rows.back().u[0]);
}

/// A contact 1e12 times as stiff as the spring that throws the mass on it: it comes back as fast.
double stiff_contact(const std::string& engine, double) {
  const Result r =
      run_text(matrix_scene("t_end = 3.0\noutput_times = [3.0]\ninitial = { u = [1.0], v = [0.0] }",
                            "mass = [[1.0]]\nstiffness = [[1.0]]",
                            "law = \"compliant\"\nnormal = { d0 = 1.0 }\nnormal_stiffness = 1e12"),
               engine);
  if (!ended(r) || r.events.size() != 2) return wrong;
  return std::abs(r.events[1].vn + r.events[0].vn);
}

/// Friction 10 stops a point mass at once, friction 0 does not touch its velocity.
double extreme_friction(const std::string& engine, double) {
  double error = 0.0;
  for (const double f : {0.0, 10.0}) {
    const Result r = run_text(
        matrix_scene(
            "t_end = 1.0\ninitial = { u = [0.0, 0.5], v = [3.0, 0.0] }", two_masses,
            fmt::format("law = \"rigid\"\nnormal = {{ d1 = 1.0 }}\ntangent = {{ d0 = 1.0 }}\nfriction = {}",
                        f),
            constant_load("d1", -10.0)),
        engine);
    if (!ended(r) || r.events.size() != 1) return wrong;
    error = std::max(error, std::abs(r.rows.back().v[0] - (f > 0.0 ? 0.0 : 3.0)));
  }
  return error;
}

/// A mass that is pressed on a fast belt by an oblique spring: sliding couples its two modes, which flutter.
/// Compared with the unstable complex eigenvector of the sliding mode after a growth by e^4.
double flutter(const std::string& engine, double) {
  const double f = 0.8, kn = 1.5, pre = 1e3;
  Eigen::Matrix2d k;  // x along the belt, y across, without the contact
  k << 2.0, -1.0, -1.0, 0.6;
  Eigen::Matrix2d sliding = k;  // the belt runs along +x faster than the mass: slip-, T = f N
  sliding(1, 1) += kn;
  sliding(0, 1) += f * kn;
  const double half = 0.5 * sliding.trace(),
               det = sliding(0, 0) * sliding(1, 1) - sliding(0, 1) * sliding(1, 0);
  const std::complex<double> mu = half + std::sqrt(std::complex<double>(half * half - det));
  std::complex<double> lambda = std::sqrt(-mu);
  if (lambda.real() < 0.0) lambda = -lambda;
  if (!(lambda.real() > 1e-3)) return wrong;
  const Eigen::Vector2cd shape = Eigen::Vector2cd(sliding(0, 1), mu - sliding(0, 0)).normalized();
  // Equilibrium under a load that presses: sliding u = p
  const Eigen::Vector2d p(0.0, -pre), rest = sliding.inverse() * p;
  const double t = 4.0 / lambda.real();
  const Eigen::Vector2d u0 = rest + shape.real(), v0 = (lambda * shape).real();
  const Result r = run_text(
      matrix_scene(
          fmt::format("t_end = {0:.17g}\noutput_times = [{0:.17g}]\ninitial = {{ u = [{1:.17g}, {2:.17g}], "
                      "v = [{3:.17g}, {4:.17g}] }}",
                      t, u0[0], u0[1], v0[0], v0[1]),
          "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[2.0, -1.0], [-1.0, 0.6]]",
          "law = \"compliant\"\nnormal = { d1 = 1.0 }\ntangent = { d0 = 1.0 }\nnormal_stiffness = 1.5\n"
          "tangential_stiffness = 100.0\nfriction = 0.8\nsurface_velocity = 1e4\ninitial_shear = -1e9",
          constant_load("d1", -pre)),
      engine);
  if (!ended(r) || r.rows.back().contacts[0].state != State::slip_minus) return wrong;
  const Eigen::Vector2d expected = rest + (std::exp(lambda * t) * shape).real();
  return (r.rows.back().u - expected).norm() / rest.norm();  // errors grow by e^4, too
}

/// Undamped oscillator, 1000 cycles and more: relative change of its energy.
double many_cycles(const std::string& engine, double cycles) {
  const Result r = run_text(
      matrix_scene(fmt::format("t_end = {0}\noutput_times = [{0}]\ninitial = {{ u = [1.0], v = [0.0] }}",
                               1e3 * cycles),
                   fmt::format("mass = [[1.0]]\nstiffness = [[{:.17g}]]", 4.0 * pi * pi),
                   "law = \"rigid\"\nnormal = { d0 = 1.0 }\ngap = 1.5"),
      engine);
  if (!ended(r) || !r.events.empty()) return wrong;
  return r.report.audit.energy.value / (2.0 * pi * pi);
}

/// Stick and slip on a belt: the mean period of the limit cycle,
///   2 (pi - atan(d/v)) + 2 d/v,  d = (fs - fk) N/k,  m = k = N = 1
double stick_slip_cycles(const std::string& engine, double cycles) {
  const double v = 0.2, d = 0.5, period = 2.0 * (pi - std::atan(d / v)) + 2.0 * d / v;
  const double n = 100.0 * cycles;
  const Result r = run_text(
      matrix_scene(
          fmt::format("t_end = {0}\noutput_times = [{0}]\ninitial = {{ u = [0.0, 0.0], v = [0.2, 0.0] }}",
                      (n + 3.0) * period),
          "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[1.0, 0.0], [0.0, 0.0]]",
          "law = \"rigid\"\nnormal = { d1 = 1.0 }\ntangent = { d0 = 1.0 }\nfriction = { static = 1.5, "
          "kinetic "
          "= 1.0 }\nsurface_velocity = 0.2",
          constant_load("d1", -1.0)),
      engine);
  if (!ended(r)) return wrong;
  std::vector<double> slips;
  for (const Event& e : r.events)
    if (e.type == EventType::slip) slips.push_back(e.t);
  if (slips.size() < static_cast<std::size_t>(n)) return wrong;
  const auto last = static_cast<std::size_t>(n) - 1;
  return std::abs((slips[last] - slips[1]) / static_cast<double>(last - 1) - period);
}

/// Fifty blocks in a chain, pulled at one end: the other engine's event times, both complete.
double chain(const std::string& engine, double) {
  constexpr int n = 50;
  std::string text =
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n[run]\nt_end = "
      "12.0\noutput_times = [12.0]\n[nodes]\n";
  for (int i = 0; i < n; ++i) text += fmt::format("b{} = [{}.0, 0.0]\n", i, i);
  for (int i = 0; i < n; ++i)
    text += fmt::format(
        "[[masses]]\nnode = \"b{0}\"\nmass = 1.0\n[[contacts]]\nname = \"b{0}\"\nnode = \"b{0}\"\nlaw = "
        "\"rigid\"\nnormal = [0.0, 1.0]\nfriction = {{ static = 0.4, kinetic = 0.3 }}\n",
        i);
  for (int i = 0; i + 1 < n; ++i)
    text += fmt::format(
        "[[springs]]\nnode = \"b{}\"\nagainst = \"b{}\"\ndirection = [1.0, 0.0]\nstiffness = 400.0\n", i,
        i + 1);
  text +=
      "[[springs]]\nnode = \"b49\"\ndirection = [1.0, 0.0]\nstiffness = 400.0\n"
      "[[loads]]\nnode = \"b49\"\ndirection = [1.0, 0.0]\namplitude = 1.0\nhistory = { type = "
      "\"polynomial\", "
      "coefficients = [0.0, 8.0] }\n";
  text = "schema = 1\ngravity = [0.0, -10.0]\n" + text.substr(text.find("units"));
  const Result a = run_text(text, engine), b = run_text(text, engine == "exact" ? "ida" : "exact");
  if (!ended(a) || !ended(b) || a.events.size() != b.events.size() || a.events.size() < 100) return wrong;
  double error = 0.0;
  for (std::size_t i = 0; i < a.events.size(); ++i) {
    if (a.events[i].contact != b.events[i].contact || a.events[i].to != b.events[i].to) return wrong;
    error = std::max(error, std::abs(a.events[i].t - b.events[i].t));
  }
  return error;
}

}  // namespace

const std::vector<HardCase>& hard_cases() {
  static const std::vector<HardCase> all{
      {"Zeno: a ball bounces 100 times in a finite time", "time of rest, s", 1e-8, 1.1e-9, bouncing_ball},
      {"grazing: a stop passed by 1e-8 of the amplitude", "time times g', m", 4e-9, 4e-15, graze},
      {"two balls land at one instant", "difference of the times, s", 0.0, 0.0,
       [](const std::string& e, double) { return two_balls(e, 0.0); }},
      {"two balls land 1e-9 s apart", "error of the difference, s", 1e-11, 1e-14,
       [](const std::string& e, double) { return two_balls(e, 1e-9); }},
      {"a rigid bar falls flat on two feet", "angle at rest, rad", 1e-13, 1e-13, flat_bar},
      {"hits on an output time at a kink, and in the first step", "time, s", 1e-9, 1e-14, awkward_times},
      {"a stick phase of 1e-4 s", "time times rate, and time, s", 4e-9, 1e-12, short_stick},
      {"a push that just reaches the friction limit", "displacement, m", 1e-8, 1e-8, at_the_limit},
      {"stiffness ratio 1e12", "speed lost in a bounce, m/s", 1e-7, 1e-9, stiff_contact},
      {"friction 0 and 10", "velocity, m/s", 1e-12, 1e-14, extreme_friction},
      {"flutter: two modes coupled by sliding", "state, relative", 1e-7, 1e-11, flutter},
      {"undamped oscillator, 1000 cycles", "energy, relative", 1e-5, 1e-12, many_cycles},
      {"stick-slip limit cycle, 100 cycles", "mean period, s", 1e-8, 1e-13, stick_slip_cycles},
      {"chain of fifty blocks on a rigid floor", "event times against the other engine, s", 1e-6, 1e-6,
       chain},
  };
  return all;
}

}  // namespace signorini::tests
