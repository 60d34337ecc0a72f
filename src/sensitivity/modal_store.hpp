// modal_store.hpp: data that modal_tangents.hpp keeps for recurring contact states.
//
//   per state: B and G of every parameter (state_rates.hpp), displayed rows of its modes, data of the usual step
#pragma once

#include <map>

#include "sensitivity/oscillator_pairs.hpp"
#include "sensitivity/state_rates.hpp"

namespace signorini {

/// Limit of the storage; when it is exceeded, all states are dropped. Chosen value.
inline constexpr std::size_t most_bytes_of_states = std::size_t{1} << 28;

template <class S>
struct StateStore {
  std::vector<ParameterModes<S>> parameters;
  RowMatrix shown;           // displayed degrees of freedom by flat amplitudes
  OscillatorPairs<S> usual;  // for the usual step; empty: not computed yet
};

/// Work arrays of one step.
template <class S>
struct Workshop {
  OscillatorPairs<S> pairs;
  Square<S> driven, driven_rate, dragging, dragging_rate;
};

struct ModalStore {
  std::vector<OpenRates> open;
  std::map<std::vector<State>, StateStore<double>> real;
  std::map<std::vector<State>, StateStore<Complex>> pairs;
  std::size_t bytes = 0;
  Workshop<double> real_work;
  Workshop<Complex> pair_work;
  Workshop<double>& work(double) { return real_work; }
  Workshop<Complex>& work(Complex) { return pair_work; }

  StateStore<double>* find(const std::vector<State>& states, double) {
    const auto at = real.find(states);
    return at == real.end() ? nullptr : &at->second;
  }
  StateStore<Complex>* find(const std::vector<State>& states, Complex) {
    const auto at = pairs.find(states);
    return at == pairs.end() ? nullptr : &at->second;
  }
  StateStore<double>& keep(const std::vector<State>& states, StateStore<double> made) {
    return real.insert_or_assign(states, std::move(made)).first->second;
  }
  StateStore<Complex>& keep(const std::vector<State>& states, StateStore<Complex> made) {
    return pairs.insert_or_assign(states, std::move(made)).first->second;
  }
};

}  // namespace signorini
