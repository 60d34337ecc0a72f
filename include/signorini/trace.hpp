// trace.hpp: how a decision came about, round by round, and why one could not be made.
//
//   a round: a mode is tried at an instant; it holds if none of its guards fails just after
//
// A guard fails where its first derivative that is not zero to working precision is negative.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "signorini/contact.hpp"

namespace signorini {

struct Model;
struct RunSpec;
struct Report;
class Recorder;

/// A guard by its contact; name as in messages: "gap", "compression", "slip rate".
struct NamedGuard {
  std::size_t contact = 0;
  std::string guard;
  int order = 0;        ///< of the derivative that is negative; 0: the value itself
  double excess = 1.0;  ///< that derivative over what counts as zero
};

/// One mode tried at one instant.
struct Round {
  double t = 0.0;
  int number = 0;                     ///< from 0: the states just before, in the forcing just after
  std::vector<NamedGuard> fired;      ///< what the engine found at zero
  std::vector<std::size_t> touching;  ///< rigid contacts with g = 0 that were decided together
  bool impact = false;                ///< velocities jumped before the mode was tried
  std::vector<ContactState> tried;    ///< one a contact
  std::vector<NamedGuard> failed;     ///< none: the mode holds
};

using RoundListener = std::function<void(const Round&)>;

/// signorini/simulate.hpp, and the listener hears of every mode that is tried.
[[nodiscard]] Report simulate(const Model& model, const RunSpec& settings, Recorder& recorder,
                              const RoundListener& listener);

/// Why no mode was found, or none that is the only one; or why finding them does not get on.
struct Refusal {
  enum class Kind : unsigned char {
    none,       ///< there is no refusal
    dependent,  ///< rows of contacts that stick are linearly dependent: forces are not unique
    singular,   ///< the equations of motion without rigid contacts are
    paradox,    ///< Painleve: no motion continues this one
    ambiguous,  ///< Painleve: several motions that differ do
    impact,     ///< an impact has no solution
    endless,    ///< rounds do not end, or no combination of states is consistent
    standstill  ///< every instant has its states, but instant follows instant in no time
  } kind = Kind::none;
  std::string reason;                 ///< one sentence
  std::vector<std::size_t> contacts;  ///< concerned
  /// Of W in units that make its diagonal one. NaN: unknown.
  double condition = std::numeric_limits<double>::quiet_NaN();
  /// By how many of its roundings the best combination of states fails. NaN: unknown.
  double residual = std::numeric_limits<double>::quiet_NaN();

  explicit operator bool() const { return kind != Kind::none; }
};

/// "dependent", "paradox", ...
[[nodiscard]] const char* to_string(Refusal::Kind kind);

}  // namespace signorini
