#include "engine/newmark/short_pulse.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/rounding.hpp"
#include "engine/newmark/newmark_step.hpp"

namespace signorini {
namespace {

constexpr std::size_t finest = 1024;  // parts: relative error of T for a half wave is pi^2 / 12 / 1024^2
// Error limit relative to int |f|: four steps of a half sine stay below it, three do not.
constexpr double lost = 1.0 / 16.0;
constexpr double passed = 1e-4;  // relative to int |f|

using Values = std::array<double, finest + 1>;

/// True for a polynomial of degree 2 or higher.
bool curves(const std::vector<double>& c) {
  return std::any_of(c.begin() + std::min<std::ptrdiff_t>(2, std::ssize(c)), c.end(),
                     [](double x) { return x != 0.0; });
}

/// True if the piece is not a straight line.
bool bends(const Piece& piece) {
  return piece.function || piece.amplitude != 0.0 || curves(piece.coefficients);
}

/// T of every stride-th value, divided by the length of the segment.
double trapezoid(const Values& f, std::size_t stride) {
  double sum = 0.5 * (f.front() + f.back());
  for (std::size_t i = stride; i < finest; i += stride) sum += f[i];
  return sum * static_cast<double>(stride) / static_cast<double>(finest);
}

/// T of the steps of length dt and the remainder, divided by the length.
double of_own_steps(const Piece& piece, double begin, double end, double dt) {
  double sum = 0.0, from = begin, before = piece.value(begin);
  for (int i = 1; from < end; ++i) {
    const double next = begin + i * dt, to = end - next <= same_length * dt ? end : next;
    const double after = piece.value(to);
    sum += 0.5 * (to - from) * (before + after);
    from = to;
    before = after;
  }
  return sum / (end - begin);
}

/// True for a cubic that stays between its values at both ends, as those between the rows of a table do.
bool between_rows(const Piece& piece, double begin, double end) {
  constexpr int looks = 16;  // a cubic that turns inside exceeds its ends at several of these samples
  if (piece.function || piece.amplitude != 0.0 || piece.coefficients.size() != 4) return false;
  const auto [least, greatest] = std::minmax({piece.value(begin), piece.value(end)});
  for (int i = 1; i < looks; ++i)
    if (const double f = piece.value(begin + (end - begin) * i / looks); f < least || f > greatest)
      return false;
  return true;
}

/// True if dt is short enough, decided without an integral: for a wave plus a straight line the error of steps of h is
/// at most h^2/12 |f''|, and int |f| is at least |J|.
bool clearly_passed(const Piece& piece, double begin, double end, double dt) {
  if (piece.function || curves(piece.coefficients)) return false;
  const double turn = piece.omega * std::min(dt, end - begin);
  const double error = turn * turn / 12.0 * std::abs(piece.amplitude);
  return error <= lost * (std::abs(of_own_steps(piece, begin, end, dt)) - error);
}

/// Number of parts that this piece needs, 1 if dt suffices.
std::size_t parts_for(const Piece& piece, double begin, double end, double dt) {
  if (between_rows(piece, begin, end) || clearly_passed(piece, begin, end, dt)) return 1;
  Values f, size;
  for (std::size_t i = 0; i <= finest; ++i) {
    f[i] = piece.value(
        i == finest ? end : begin + (end - begin) * static_cast<double>(i) / static_cast<double>(finest));
    size[i] = std::abs(f[i]);
  }
  const double impulse = trapezoid(f, 1), whole = trapezoid(size, 1);
  if (std::abs(of_own_steps(piece, begin, end, dt) - impulse) <= lost * whole) return 1;
  std::size_t parts = 2;
  const auto too_few = [&] {
    return end - begin > dt * static_cast<double>(parts) ||
           std::abs(trapezoid(f, finest / parts) - impulse) > passed * whole;
  };
  while (parts < finest && too_few()) parts *= 2;
  return parts;
}

}  // namespace

double step_within(const Model& model, double begin, double end, double dt) {
  if (!(end - begin < short_of_steps * dt)) return dt;
  const double middle = 0.5 * (begin + end);
  std::size_t parts = 1;
  const auto consider = [&](const History& history) {
    if (const Piece& piece = history.piece(middle); bends(piece))
      parts = std::max(parts, parts_for(piece, begin, end, dt));
  };
  for (const Load& load : model.loads) consider(load.history);
  for (const Contact& contact : model.contacts) consider(contact.normal_force);
  while (parts > 1 && (end - begin) / static_cast<double>(parts) < rounding::of_few * std::abs(end))
    parts /= 2;
  return parts > 1 ? std::min(dt, (end - begin) / static_cast<double>(parts)) : dt;
}

}  // namespace signorini
