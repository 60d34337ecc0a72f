// trace.hpp: the rounds of a decision of contact states, and the reason why a decision fails.
//
//   a round: a contact state is tried at an instant; it is consistent if no guard becomes negative just after the instant
//
// A guard fails if its first derivative that is nonzero within rounding is negative.
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

/// A guard of a contact that failed or was triggered, with its name in messages: "gap", "compression", "slip rate".
struct NamedGuard {
  std::size_t contact = 0;
  std::string guard;
  int order = 0;        ///< order of the negative derivative; 0: the value itself
  double excess = 1.0;  ///< ratio of that derivative to the limit below which it is treated as zero
};

/// One contact state (of all contacts) that is tried at one instant.
struct DecisionRound {
  double t = 0.0;
  int number = 0;                     ///< number of the round; 0: states before, forcing after the instant
  std::vector<NamedGuard> triggered;  ///< guards that the engine found at zero
  std::vector<std::size_t> touching;  ///< rigid contacts with g = 0 that were decided together
  bool impact = false;                ///< velocities jumped before the contact state was tried
  std::vector<ContactState> states;   ///< one per contact
  std::vector<NamedGuard> failed;     ///< guards that fail; empty: the contact state is consistent
};

using RoundListener = std::function<void(const DecisionRound&)>;

/// Same as simulate() of signorini/simulate.hpp; `listener` is called for every tried contact state.
[[nodiscard]] Report simulate(const Model& model, const RunSpec& settings, Recorder& recorder,
                              const RoundListener& listener);

/// Reason why no contact state, or no unique one, was found, or why the run makes no progress in time.
struct Refusal {
  enum class Kind : unsigned char {
    none,       ///< there is no refusal
    dependent,  ///< rows of sticking contacts are linearly dependent: forces are not unique
    singular,   ///< the equations of motion without rigid contacts are singular
    paradox,    ///< Painleve paradox: the motion has no continuation
    ambiguous,  ///< Painleve paradox: the motion has several different continuations
    impact,     ///< an impact has no solution
    endless,    ///< the rounds of state changes do not end, or no combination of states is consistent
    standstill  ///< events repeat without progress in time, although each instant has consistent states
  } kind = Kind::none;
  std::string reason;                 ///< one sentence
  std::vector<std::size_t> contacts;  ///< contacts named in the refusal
  /// Condition number of the Delassus matrix W (decide/delassus.hpp), scaled to a unit diagonal. NaN: unknown.
  double condition = std::numeric_limits<double>::quiet_NaN();
  /// Violation of the guards by the best combination of states, in units of its rounding error. NaN: unknown.
  double residual = std::numeric_limits<double>::quiet_NaN();

  explicit operator bool() const { return kind != Kind::none; }
};

/// Name of the kind: "dependent", "paradox", ...
[[nodiscard]] const char* to_string(Refusal::Kind kind);

}  // namespace signorini
