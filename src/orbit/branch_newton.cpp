#include "orbit/branch_newton.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/eigen_dense.hpp"
#include "orbit/orbit_engine.hpp"
#include "orbit/shooting.hpp"

namespace signorini::orbit {
namespace {

constexpr int max_corrections = 10;
// Limit for the length of a correction in the norm. Steps along the branch are shorter. Chosen value.
constexpr double longest_correction = 0.1;
constexpr double slow = 0.02;  // ratio of successive residuals above which dG/ds is recomputed
// Residual / amplitude up to which a stagnating correction is accepted, as in shooting.cpp.
constexpr double stagnated_correction = 1e-9;
// Residual / noise of the map at which a correction ends: the noise prevents smaller residuals. Chosen value.
constexpr double residual_per_noise = 4.0;
// Residual / amplitude up to which damped steps are tried. Chosen value.
constexpr double worth_damping = 1e-3;
// A direction is split only if its part outside all families is longer than this. Chosen value.
constexpr double least_left = 1e-6;
constexpr double fix_parameter_from = 0.7;  // |t_s| from which corrections fix the parameter. Chosen value.
constexpr double least_size = 1e-3;         // lower limit for a coordinate in the norm; chosen value
// Relative limits below which singular values are zero, as in shooting.cpp. The finer limit applies after a
// correction that reduced the residual by less than half.
constexpr double singular = 1e-9, finer_singular = 1e-12;
// Number of amplitudes: a change of the state by so many amplitudes has the same length as the range of the parameter.
constexpr double amplitudes_per_range = 5.0;
// Fraction of the largest amplitude along the branch. For smaller amplitudes the norm no longer depends on the
// amplitude, so that the branch can reach an amplitude of zero. Chosen value.
constexpr double vanishing = 0.05;
// Relative limit for the part of dz/ds that is not along the motion; above the noise of dG/ds. Chosen value;
// the caller verifies the shifted orbit.
constexpr double shift_tolerance = 1e-3;

/// Weights sqrt(m_i/m) of the coordinates at a section, m: largest mass, in scales; 1 for a coordinate without mass.
Vector mass_weights(const Model& model, const OrbitSection& section) {
  const auto n = model.size();
  Vector root(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Scales& s = model.scales;
    const bool turns = model.dofs[static_cast<std::size_t>(i)].rotation;
    root[i] = std::sqrt(std::max(0.0, model.mass.coeff(i, i))) * (turns ? s.rotation : s.displacement);
  }
  const double greatest = root.size() > 0 ? root.maxCoeff() : 0.0;
  for (Eigen::Index i = 0; i < n; ++i)
    root[i] = greatest > 0.0 && root[i] > 0.0 ? std::max(least_size, root[i] / greatest) : 1.0;
  return section.spread(root);
}

}  // namespace

BranchState BranchNewton::moved(const BranchState& from, const OrbitPass& pass, const Vector& dy) const {
  const OrbitSection section(map_.model(), pass.begin);
  BranchState to = from;
  to.state = section.moved(orbit_state(pass.begin), sizes_.cwiseProduct(dy.head(section.size())));
  to.s = std::clamp(from.s + dy[dy.size() - 1], 0.0, 1.0);  // the key may be invalid outside
  to.state = map_.projected(std::move(to.state), pass.begin.states, to.s);
  to.duration = map_.autonomous() ? from.duration * (1.0 + dy[section.size()]) : map_.period(to.s);
  return to;
}

/// dG/dy with rows and columns in the norm: x relative to sizes_, dT relative to T. If T is unknown, one row
/// is the phase condition.
Eigen::MatrixXd BranchNewton::jacobian(const BranchState& state, const OrbitPass& pass,
                                       const Vector& by_s) const {
  const OrbitSection section(map_.model(), pass.begin);
  const Eigen::MatrixXd& B = section.basis();
  const Eigen::Index n = section.size(), extra = map_.autonomous() ? 1 : 0;
  const Eigen::Index of_energy = map_.keeps_energy() ? 1 : 0, rows = n + extra + of_energy;
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(rows, n + extra + 1);
  const Vector over = sizes_.cwiseInverse();
  J.topLeftCorner(n, n) = over.asDiagonal() * (B.transpose() * pass.end_derivatives) * sizes_.asDiagonal();
  J.topLeftCorner(n, n) -= Eigen::MatrixXd::Identity(n, n);
  if (by_s.size() == n + of_energy) {
    J.block(0, n + extra, n, 1) = over.cwiseProduct(by_s.head(n));
    J.block(n + extra, n + extra, of_energy, 1) = by_s.tail(of_energy);
  }
  if (extra == 1) {
    J.block(0, n, n, 1) = over.cwiseProduct(B.transpose() * section.rates(pass.end)) * state.duration;
    Vector along = sizes_.cwiseProduct(B.transpose() * section.rates(pass.begin));
    J.block(n, 0, 1, n) = (along / along.norm()).transpose();
  }
  if (of_energy == 1)
    J.row(rows - 1).head(n) =
        sizes_.cwiseProduct(energy_slope(map_.model(), pass, section)).transpose() / map_.energy_unit();
  return J;
}

Vector BranchNewton::parameter_derivative(const BranchState& state, const OrbitPass& pass) const {
  const OrbitSection section(map_.model(), pass.begin);
  const Eigen::MatrixXd& B = section.basis();
  const Vector rates = map_.parameter_derivative(state, pass);
  const Eigen::Index of_energy = rates.size() - B.rows();
  Vector by_s(section.size() + of_energy);
  by_s << B.transpose() * rates.head(B.rows()), rates.tail(of_energy);
  return by_s;
}

/// Reason why a pass cannot be used for a correction; empty if the pass can be used.
std::string BranchNewton::refusal(const OrbitPass& pass, Eigen::Index unknowns) const {
  if (!pass.done()) return "the run over one period stopped: " + pass.outcome.reason;
  if (pass.end_derivatives.size() == 0) return "the state after one period has no derivative: " + pass.reason;
  return size(pass) != unknowns ? "the contact state at the section changes" : "";
}

double BranchNewton::accepted_residual() const {
  return std::max(stagnated_correction, accepted_noise_factor * noise_);
}

/// E*(s) - E(x, s), in the scene's units; 0 if no energy is prescribed.
double BranchNewton::energy_residual(const CorrectedPoint& c) const {
  const std::optional<double> kept = map_.energy(c.state.s);
  return kept ? *kept - c.pass.energy : 0.0;
}

CorrectedPoint BranchNewton::correct(BranchState guess, const Vector& direction, const Vector& by_s) const {
  CorrectedPoint c;
  c.state = std::move(guess);
  const bool held = fixes_parameter(direction);
  Vector t = direction, slope = by_s;
  if (held) t = Vector::Unit(t.size(), t.size() - 1);
  const double enough = std::max(correction_tolerance, residual_per_noise * noise_);
  double before = 0.0;
  for (c.iterations = 0; c.iterations <= max_corrections; ++c.iterations) {
    c.pass = map_.pass(c.state);
    c.reason = refusal(c.pass, t.size());
    if (!c.reason.empty()) return c;
    c.residual = orbit_residual(map_.model(), c.pass);
    if (map_.keeps_energy()) c.residual = std::max(c.residual, std::abs(energy_residual(c)) / c.pass.energy);
    const bool stands = c.iterations > 0 && c.residual > 0.5 * before && c.residual <= accepted_residual();
    if (c.residual <= enough || stands) {
      c.done = true;
      return c;
    }
    const bool stale = c.iterations > 0 && c.residual > slow * before;
    const double least = c.iterations > 0 && c.residual > 0.5 * before ? finer_singular : singular;
    before = c.residual;
    const OrbitSection section(map_.model(), c.pass.begin);
    const Eigen::Index of_energy = map_.keeps_energy() ? 1 : 0;
    if (!held && (slope.size() != section.size() + of_energy || stale))
      slope = parameter_derivative(c.state, c.pass);
    const Eigen::MatrixXd J = jacobian(c.state, c.pass, slope);
    Eigen::MatrixXd A(J.rows() + 1, t.size());
    A << J, t.transpose();
    Vector b = Vector::Zero(A.rows());
    if (of_energy == 1) b[J.rows() - 1] = energy_residual(c) / map_.energy_unit();
    b.head(section.size()) = -sizes_.cwiseInverse().cwiseProduct(
        section.basis().transpose() * (section.coordinates(c.pass.end) - section.coordinates(c.pass.begin)));
    Vector dy = base::min_norm_solution(A, b, least);
    if (held) dy[dy.size() - 1] = 0.0;  // the parameter's step is zero up to rounding
    if (!(dy.norm() < longest_correction)) {
      c.reason = "Newton's method leaves the branch: its correction is too long";
      return c;
    }
    c.state = moved(c.state, c.pass, dy);
  }
  c.reason =
      fmt::format("Newton's method does not converge: the residual is {:.2g} of the amplitude", c.residual);
  if (held && !map_.autonomous() && c.residual <= worth_damping) close_damped(c, t.size());
  return c;
}

/// Corrects by damped steps of Newton's method. Near a graze events appear and vanish between steps, so Phi
/// jumps, and undamped steps oscillate.
void BranchNewton::close_damped(CorrectedPoint& c, Eigen::Index unknowns) const {
  const ShootingStart start{c.state.state, c.state.duration, false, accepted_residual(), {}};
  ShootingResult shot = shoot(*map_.at(c.state.s), start, correction_tolerance);
  if (!shot.closed || !refusal(shot.pass, unknowns).empty()) return;
  c.state.state = std::move(shot.state);
  c.pass = std::move(shot.pass);
  c.residual = shot.residual;
  c.done = true;
}

bool BranchNewton::fixes_parameter(const Vector& t) {
  return std::abs(t[t.size() - 1]) >= fix_parameter_from;
}

Vector BranchNewton::tangent(CorrectedPoint& at, const Vector& before) const {
  if (at.derivative_by_s.size() == 0) at.derivative_by_s = parameter_derivative(at.state, at.pass);
  const Eigen::MatrixXd J = jacobian(at.state, at.pass, at.derivative_by_s);
  Eigen::MatrixXd A(J.rows() + 1, before.size());
  A << J, before.transpose();
  const Vector t = base::min_norm_solution(A, Vector::Unit(A.rows(), A.rows() - 1), singular);
  return t.norm() > 0.0 ? Vector(t / t.norm()) : before;
}

const Eigen::MatrixXd& BranchNewton::families(CorrectedPoint& at) const {
  const Eigen::Index n = at.monodromy.rows(), all = size(at.pass);
  const Eigen::Index count = map_.autonomous() ? 0 : std::min(n, static_cast<Eigen::Index>(at.ones));
  if (at.family.rows() == all && at.family.cols() == count) return at.family;
  at.family = Eigen::MatrixXd::Zero(all, count);
  if (count == 0) return at.family;
  const Eigen::MatrixXd A = sizes_.cwiseInverse().asDiagonal() *
                            (at.monodromy - Eigen::MatrixXd::Identity(n, n)) * sizes_.asDiagonal();
  at.family.topRows(n) = base::smallest_singular_vectors(A, count);
  return at.family;
}

BranchNewton::StepDirection BranchNewton::split(CorrectedPoint& at, const Vector& way) const {
  const Eigen::MatrixXd& directions = families(at);
  const Vector part = directions * (directions.transpose() * way), rest = way - part;
  if (!(rest.norm() > least_left)) return {way, Vector::Zero(way.size())};
  return {rest / rest.norm(), part / std::max(rest.norm(), part.norm())};
}

/// Removes from t its part along families. The equations do not determine this part, and the branch must not drift.
Vector BranchNewton::without_families(CorrectedPoint& at, const Vector& t) const {
  return families(at).cols() == 0 ? t : split(at, t).across;
}

Vector BranchNewton::examine(CorrectedPoint& at, const Vector& before, std::optional<std::size_t> ones,
                             bool known) const {
  if (at.multipliers.empty()) {
    at.monodromy = monodromy(map_.model(), at.pass);
    at.multipliers = multipliers_of(at.monodromy);
    at.error =
        error_of(at.monodromy, at.pass.derivatives_error, orbit_state_error(map_.at(at.state.s)->run()));
    at.family = {};
  }
  const std::size_t of_time = map_.keeps_energy() ? 2 : map_.autonomous() ? 1 : 0;
  at.ones = ones.value_or(std::max(count_ones(at.multipliers), of_time));
  const Vector t = known ? before : without_families(at, tangent(at, without_families(at, before)));
  at.tests =
      test_values(at.multipliers, at.ones, t[t.size() - 1], error_at_circle(at.error, map_.keeps_energy()));
  return t;
}

void BranchNewton::measure(const OrbitPass& pass, Vector* t) {
  const OrbitSection section(map_.model(), pass.begin);
  const Vector weights = mass_weights(map_.model(), section);
  double square = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(weights.size()); ++i) {
    const std::size_t u = section.displacements(), v = section.velocities();
    const double amplitude = i < u ? pass.u_amplitude : i < u + v ? pass.v_amplitude : pass.T_amplitude;
    const double part = weights[static_cast<Eigen::Index>(i)] * amplitude;
    square += part * part;
  }
  greatest_ = std::max(greatest_, std::sqrt(square));
  const double counted = std::max(std::sqrt(square), vanishing * greatest_);
  const double amplitude = amplitudes_per_range * (counted > 0.0 ? counted : 1.0);
  const Vector by = (section.basis().cwiseAbs2().transpose() * weights.cwiseAbs2()).cwiseSqrt();
  const Vector before = std::exchange(sizes_, amplitude * by.cwiseInverse());
  if (t != nullptr && before.size() == sizes_.size())
    t->head(sizes_.size()) = t->head(sizes_.size()).cwiseProduct(before).cwiseQuotient(sizes_).eval();
}

Vector BranchNewton::flip_direction(const CorrectedPoint& at) const {
  const Eigen::Index n = at.monodromy.rows();
  const Eigen::MatrixXd A = sizes_.cwiseInverse().asDiagonal() *
                            (at.monodromy + Eigen::MatrixXd::Identity(n, n)) * sizes_.asDiagonal();
  Vector away = Vector::Zero(size(at.pass));
  away.head(n) = sizes_.cwiseProduct(base::smallest_singular_vectors(A, 1).col(0));
  return away;
}

Vector BranchNewton::other_direction(CorrectedPoint at, const Vector& t) const {
  if (at.derivative_by_s.size() == 0) at.derivative_by_s = parameter_derivative(at.state, at.pass);
  const Eigen::MatrixXd J = jacobian(at.state, at.pass, at.derivative_by_s);
  // t is one of the two null vectors of J. With t as an additional row, only the other null vector remains.
  Eigen::MatrixXd A(J.rows() + 1, J.cols());
  A << J, t.transpose();
  Vector away = base::symmetric_eigen(A.transpose() * A).vectors.col(0);
  away.head(sizes_.size()) = away.head(sizes_.size()).cwiseProduct(sizes_).eval();
  return away;
}

Vector BranchNewton::in_norm(const Vector& raw) const {
  Vector t = raw;
  t.head(sizes_.size()) = raw.head(sizes_.size()).cwiseQuotient(sizes_);
  return t / t.norm();
}

std::optional<Vector> BranchNewton::difference(const SecantPoint& from, const CorrectedPoint& to) const {
  const OrbitSection section(map_.model(), to.pass.begin), before(map_.model(), from.begin);
  if (before.size() != section.size() || before.basis().rows() != section.basis().rows()) return std::nullopt;
  Vector t(size(to.pass));
  t.head(section.size()) =
      (section.basis().transpose() * (section.coordinates(to.pass.begin) - section.coordinates(from.begin)))
          .cwiseQuotient(sizes_);
  if (map_.autonomous()) t[section.size()] = (to.state.duration - from.duration) / to.state.duration;
  t[t.size() - 1] = to.state.s - from.s;
  return t;
}

std::optional<Vector> BranchNewton::secant(const SecantPoint& from, const CorrectedPoint& to) const {
  const std::optional<Vector> t = difference(from, to);
  const double length = t ? t->norm() : 0.0;
  if (!(length > 0.0)) return std::nullopt;
  return Vector(*t / length);
}

void BranchNewton::update_noise(const OrbitPass& first, const OrbitPass& second) {
  if (const auto noise = map_noise(map_.model(), first, second)) noise_ = std::min(max_noise, *noise);
}

std::optional<double> BranchNewton::shift(const CorrectedPoint& at, const Vector& t) const {
  if (map_.autonomous()) return std::nullopt;
  const OrbitSection section(map_.model(), at.pass.begin);
  const Vector x = sizes_.cwiseProduct(t.head(section.size()));
  const Vector along = section.basis().transpose() * section.rates(at.pass.begin);
  if (!(along.norm() > 0.0) || !(t.head(section.size()).norm() > shift_tolerance)) return std::nullopt;
  const double time = along.dot(x) / along.squaredNorm();
  if ((x - time * along).norm() > shift_tolerance * x.norm()) return std::nullopt;
  return time / t[t.size() - 1];
}

namespace {

// Two margins are regarded as equal if they differ by at most `balanced` times the smallest margin. This
// limit is at least `finest` and at most `coarsest` times the amplitude of T. Chosen values.
constexpr double balanced = 1e-3, finest = 1e-8, coarsest = 1e-5;
constexpr double along_family = 1e-5;  // step of finite differences, in the norm; chosen value
// A direction of a family changes no margin if d(margin)/da, in amplitudes of T, is below this limit. Chosen value.
constexpr double singular_family = 1e-6;
constexpr int max_centrings = 3;

std::vector<std::size_t> never_slip(const Model& model, const OrbitPass& pass) {
  std::vector<std::size_t> list;
  for (std::size_t c = 0; c < pass.never_slips.size(); ++c)
    if (pass.never_slips[c] && model.contacts[c].has_friction() && pass.begin.states[c].state == State::stick)
      list.push_back(c);
  return list;
}

/// Differences (m+ - m-)/2 of the margins of `contacts`.
Vector imbalances(const std::vector<std::size_t>& contacts, const OrbitPass& pass) {
  Vector d(static_cast<Eigen::Index>(contacts.size()));
  for (std::size_t i = 0; i < contacts.size(); ++i)
    d[static_cast<Eigen::Index>(i)] = 0.5 * (pass.margins[contacts[i]][0] - pass.margins[contacts[i]][1]);
  return d;
}

/// True if the margins of each contact are equal within the limits above. d: imbalances().
bool is_balanced(const std::vector<std::size_t>& contacts, const OrbitPass& pass, const Vector& d) {
  double least = pass.T_amplitude;
  for (const std::size_t c : contacts) least = std::min({least, pass.margins[c][0], pass.margins[c][1]});
  const double T = pass.T_amplitude;
  return d.cwiseAbs().maxCoeff() <= std::clamp(balanced * least, finest * T, coarsest * T);
}

/// Derivatives of imbalances() along the directions of the family; empty if a run fails. here: imbalances() at `at`.
Eigen::MatrixXd slopes(const BranchMap& map, const BranchNewton& newton, const CorrectedPoint& at,
                       const std::vector<std::size_t>& contacts, const Eigen::MatrixXd& directions,
                       const Vector& here) {
  Eigen::MatrixXd D(here.size(), directions.cols());
  for (Eigen::Index k = 0; k < directions.cols(); ++k) {
    const OrbitPass beside = map.margins(newton.moved(at.state, at.pass, along_family * directions.col(k)));
    if (!beside.done()) return {};
    D.col(k) = (imbalances(contacts, beside) - here) / along_family;
  }
  return D;
}

}  // namespace

std::optional<CorrectedPoint> representative_member(const BranchMap& map, const BranchNewton& newton,
                                                    const CorrectedPoint& here, const Vector& t) {
  const std::vector<std::size_t> contacts = never_slip(map.model(), here.pass);
  CorrectedPoint at = here;
  const Eigen::MatrixXd directions = newton.families(at);
  if (contacts.empty() || directions.cols() == 0) return std::nullopt;
  bool moved = false;
  OrbitPass fine = map.margins(at.state);
  for (int i = 0; i < max_centrings && fine.done(); ++i) {
    const Vector d = imbalances(contacts, fine);
    if (is_balanced(contacts, fine, d)) break;
    const Eigen::MatrixXd D = slopes(map, newton, at, contacts, directions, d);
    if (D.size() == 0) break;
    // If all other contacts slip, the structure moves together with the contact that never slips, and no
    // force changes: D is zero along this direction.
    const Vector part = base::min_norm_solution(D, -d, singular_family, at.pass.T_amplitude);
    if (!(part.norm() > 0.0)) break;
    CorrectedPoint next = newton.correct(newton.moved(at.state, at.pass, directions * part),
                                         newton.parameter_direction(at.pass, 1.0), at.derivative_by_s);
    if (!next.done) break;
    fine = map.margins(next.state);
    if (!fine.done() || !(imbalances(contacts, fine).norm() < 0.5 * d.norm())) break;
    newton.examine(next, t, here.ones, true);
    at = std::move(next);
    moved = true;
  }
  return moved ? std::optional(std::move(at)) : std::nullopt;
}

}  // namespace signorini::orbit
