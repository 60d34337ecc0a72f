#include "engine/newmark/short_pulse.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/rounding.hpp"
#include "engine/newmark/newmark_step.hpp"

namespace signorini {
namespace {

constexpr std::size_t finest = 1024;  // parts: of a half wave T is off by pi^2 / 12 / 1024^2
// Of int |f|. Four steps of a half sine err by less, as steps of a method of second order may; three do not.
constexpr double lost = 1.0 / 16.0;
constexpr double passed = 1e-4;  // of int |f|

using Values = std::array<double, finest + 1>;

/// A polynomial that is no straight line.
bool curves(const std::vector<double>& c) {
  return std::any_of(c.begin() + std::min<std::ptrdiff_t>(2, std::ssize(c)), c.end(),
                     [](double x) { return x != 0.0; });
}

/// No straight line.
bool bends(const Piece& piece) {
  return piece.function || piece.amplitude != 0.0 || curves(piece.coefficients);
}

/// T of the values, every stride-th of them, over the length of the stretch.
double trapezoid(const Values& f, std::size_t stride) {
  double sum = 0.5 * (f.front() + f.back());
  for (std::size_t i = stride; i < finest; i += stride) sum += f[i];
  return sum * static_cast<double>(stride) / static_cast<double>(finest);
}

/// T of the steps of length dt and the rest, over the length.
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

/// A cubic that stays within its values at both ends, as those between the rows of a table do.
bool between_rows(const Piece& piece, double begin, double end) {
  constexpr int looks = 16;  // a cubic that turns inside goes beyond its ends at several of them
  if (piece.function || piece.amplitude != 0.0 || piece.coefficients.size() != 4) return false;
  const auto [least, greatest] = std::minmax({piece.value(begin), piece.value(end)});
  for (int i = 1; i < looks; ++i)
    if (const double f = piece.value(begin + (end - begin) * i / looks); f < least || f > greatest)
      return false;
  return true;
}

/// dt is told to do without an integral: of a wave on a straight line steps of h err by h^2/12 |f''| at most, and int |f| is
/// no less than |J|.
bool clearly_passed(const Piece& piece, double begin, double end, double dt) {
  if (piece.function || curves(piece.coefficients)) return false;
  const double turn = piece.omega * std::min(dt, end - begin);
  const double error = turn * turn / 12.0 * std::abs(piece.amplitude);
  return error <= lost * (std::abs(of_own_steps(piece, begin, end, dt)) - error);
}

/// As many parts as this piece needs, 1 where dt does.
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
