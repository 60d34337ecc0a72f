// taylor.hpp: the motion in one mode as a Taylor series, exact for its linear system.
//
//   x(t + s z) = sum_k x_k z^k,   x_k = s^k/k! x^(k)(t)
//   M a_k + C v_k + K u_k + sum ( n N_k + t T_k ) = P_k,   rows of the mode
//   v_k = (k+1)/s u_(k+1),   a_k = (k+1)(k+2)/s^2 u_(k+2)
//
// Level k is one solve with the system matrix: its unknowns are a_k where there is mass, v_k of massless
// degrees of freedom with damping, u_k of those without, N_k and T_k. So u, v at an instant give consistent
// forces and accelerations (level 0), and then the whole series, whatever the mode: nonsymmetric by
// friction, singular by free motions, with massless parts or rigid sticking.
#pragma once

#include <map>

#include "linear/system_matrix.hpp"
#include "motion/point.hpp"

namespace signorini {

/// Coefficients about t, column k: order k. v is that of u; levels 0 .. `levels`.
struct Series {
  double t = 0.0, scale = 1.0;
  int levels = 0;
  Eigen::MatrixXd u;       ///< n x (levels + 3); complete to order `levels`, beyond only where there is mass
  Eigen::MatrixXd forces;  ///< 2 contacts x (levels + 1): N_1, T_1, N_2, ...
  ForcingSeries forcing;   ///< levels + 3 coefficients
};

/// One rounding of all data, with signs that repeat from run to run.
struct Disturbance {
  static double sign(std::size_t i);
};

class Taylor {
 public:
  enum class Kind : unsigned char { massive, damped, algebraic };

  Taylor(const Model& model, const Structure& structure);

  /// Puts a mode in force. False: its rows are linearly dependent, forces would not be unique.
  bool set(const Mode& mode);
  /// The series about t from u and v (v of massless degrees of freedom is not read).
  void expand(const Forcing& forcing, double t, const Vector& u, const Vector& v, int levels, double scale,
              Series& out, const Disturbance* disturbance = nullptr);
  /// The same in two parts: room for `levels`, then the levels up to the given one.
  void begin(const Forcing& forcing, double t, const Vector& u, const Vector& v, int levels, double scale,
             Series& out, const Disturbance* disturbance = nullptr);
  void extend(const Forcing& forcing, int levels, Series& out);
  /// x := A^-1 x with the mode's system matrix; length n + 2 contacts.
  void solve(double* x);

  [[nodiscard]] const std::vector<Rows>& rows() const { return rows_; }
  [[nodiscard]] const std::vector<Kind>& kinds() const { return kinds_; }
  [[nodiscard]] bool massless() const { return massless_; }

 private:
  /// A degree of freedom whose acceleration a contact alone prescribes: exact, not to an elimination's
  /// roundoff.
  struct Pinned {
    std::size_t dof, contact;
    double factor;
    bool tangent;
  };
  void pin(const Mode& mode);
  /// Stribeck's friction: T_k + s sum_j f_j N_(k-j) = 0, f_j from the series of the slip rate.
  struct Stribeck {
    std::size_t contact;
    int s;
    std::vector<double> exponent, f;  // of the exponential; coefficients of the coefficient of friction
  };
  void start_friction(const Series& series);
  double known_friction(Stribeck& friction, int k, const Series& series) const;
  [[nodiscard]] double pinned_value(const Pinned& pinned, int k, const Series& series) const;
  void known_of_rows(std::size_t contact, int k, const Series& series, double& normal, double& tangent) const;
  void level(const Forcing& forcing, int k, Series& series, const Disturbance* disturbance);

  const Model& model_;
  const Structure& structure_;
  SystemMatrix matrix_;
  std::vector<Kind> own_kinds_, kinds_;  // by the structure alone; in the mode
  bool massless_ = false;
  std::vector<Weights> weights_;
  std::vector<Rows> rows_;
  /// A small system in a mode, dense and column by column: x = from_u u_k + from_v v_k + inverse forcing_k.
  struct Small {
    std::vector<double> inverse, from_u, from_v;
  };
  template <std::size_t fixed_n, std::size_t fixed_size>
  void level_small(const Forcing& forcing, int k, Series& series);

  std::map<std::vector<State>, Small> smalls_;  // by states; anchors are constants of rows
  const Small* small_ = nullptr;
  std::vector<Pinned> pinned_;
  std::vector<Stribeck> stribeck_;
  std::vector<double> x_, y_, known_u_, known_v_, magnitude_;
};

}  // namespace signorini
