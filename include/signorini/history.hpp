// history.hpp: functions of time in closed form, piece by piece.
//
//   f(t) = sum_j c_j (t - t0)^j + a sin(w (t - t0) + phi)      on [start_i, start_{i+1})
//        + sum_r b_r F^(r)(s (t - t0))                          F: a user-defined function
//
// Every load history, compression and surface velocity is such a function. It is right-continuous, and smooth between its
// breakpoints. A Piece continues smoothly beyond both of its ends, so that an integrator may evaluate a piece at the
// breakpoint where the piece ends. A user-defined F must also be smooth beyond both ends of its piece.
//
//   History({1.0}, {Piece::of(smooth([](auto t) { return 3.0 * sin(t * t); })), Piece{}})     smooth.hpp
//
// `ida` and `newmark` accept user-defined functions; code that needs a closed form refuses them with a message.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace signorini {

/// Derivative of the given order, at time t, of a user-defined function; order 0: its value. Decisions of contact states use
/// orders up to 8, motions of supports up to 10. Return 0 for orders that are unknown; a decision that depends on such an
/// order is then decided by rounding. The function must be pure: the same t always gives the same result.
using Function = std::function<double(double t, int order)>;

/// One smooth piece of a history. Values have the unit of f; times are in the scene's unit of time.
struct Piece {
  double origin = 0.0;               ///< t0
  std::vector<double> coefficients;  ///< c_j, ascending powers of (t - t0)
  double amplitude = 0.0;            ///< amplitude a of the sine
  double omega = 0.0;                ///< circular frequency w of the sine, rad per time
  double phase = 0.0;                ///< phase phi of the sine, rad
  Function function = {};            ///< user-defined function F; empty: none
  double time_scale = 1.0;           ///< s, ratio of the function's time to the history's time
  std::vector<double> rates = {};    ///< factors b_r of the derivatives F^(r)

  /// The piece f(t) = F(t).
  [[nodiscard]] static Piece of(Function function) {
    Piece piece;
    piece.function = std::move(function);
    piece.rates = {1.0};
    return piece;
  }
  /// The derivative of the given order at t (order 0: the value).
  [[nodiscard]] double value(double t, int order = 0) const;
  /// out[k] = scale^k / k! times the derivative of order k at t, for 0 <= k < count.
  void taylor(double t, double scale, std::size_t count, double* out) const;
};

/// A time at which f is not smooth. jump: the value changes by more than the rounding error of its evaluation.
struct Breakpoint {
  double time = 0.0;
  bool jump = false;
};

/// A function of time in closed form, piece by piece, defined for all times.
class History {
 public:
  /// The zero function.
  History() : History(Piece{}) {}
  /// A history with the same piece for all times.
  explicit History(Piece piece) : pieces_{std::move(piece)} {}
  /// pieces[0] is valid before starts[0], pieces[i] from starts[i-1] on. Errors: std::invalid_argument unless starts ascend
  /// strictly and pieces.size() == starts.size() + 1.
  History(std::vector<double> starts, std::vector<Piece> pieces);
  [[nodiscard]] static History constant(double value);

  /// The piece that is valid just after t (right-continuous).
  [[nodiscard]] const Piece& piece(double t) const;
  /// The piece that is valid just before t.
  [[nodiscard]] const Piece& piece_before(double t) const;
  [[nodiscard]] double value(double t) const { return piece(t).value(t); }
  /// All breakpoints, in ascending order.
  [[nodiscard]] std::vector<Breakpoint> breakpoints() const;
  /// The history t -> offset + factor * f(t).
  [[nodiscard]] History scaled(double factor, double offset = 0.0) const;
  /// F(t) = integral of f from 0 to t, continuous. Errors: std::invalid_argument if there are user-defined functions.
  [[nodiscard]] History integrated() const;
  /// The history c0 f + c1 f' + c2 f'', piece by piece; jumps of f do not contribute to f' and f''.
  [[nodiscard]] History with_rates(double c0, double c1, double c2) const;
  /// The history t -> f(t - dt). Errors: std::invalid_argument if rounding merges starts; the same error in repeated().
  [[nodiscard]] History shifted(double dt) const;
  /// The history that is equal to f before t and to `next` from t on.
  [[nodiscard]] History then(double t, const History& next) const;
  /// The history in which f on [from, from + period) occurs `rounds` times in succession; f is unchanged before `from` and from
  /// from + rounds * period on.
  [[nodiscard]] History repeated(double from, double period, int rounds) const;
  /// True if the history has the same constant value in all pieces.
  [[nodiscard]] bool is_constant() const;
  /// True if no piece contains a user-defined function.
  [[nodiscard]] bool has_closed_form() const;
  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
  [[nodiscard]] const std::vector<double>& starts() const { return starts_; }

 private:
  std::vector<double> starts_;
  std::vector<Piece> pieces_;
};

}  // namespace signorini
