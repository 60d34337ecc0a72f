// sensitivity_files.hpp: files of `sensitivity` and of `fit` (docs/command-line.md).
//
//   events.csv          events of the run
//   sensitivities.csv   event_index,t,contact,event,parameter,dt_dp,...,elasticity
//                       one row per event and parameter
//   figures.csv         figure,contact,value,t,parameter,dvalue_dp,dt_dp,elasticity
//                       peaks, residual values; losses of contacts and of the run
//   landings.csv        contact,landing,start,...,parameter,dstart_dp,...      with losses
//   columns-1.csv, ...  derivatives of the columns of history.csv and of contacts, with losses also of energy.csv,
//                       with respect to the first parameter, ...
//   sensitivity.json    parameters, changes at which the sequence would differ, spreads
//
// elasticity = (p/x) dx/dp: the change of x in per cent if p changes by one per cent; x: a time or a figure.
#pragma once

#include <filesystem>

#include "signorini/fit.hpp"
#include "signorini/sensitivity.hpp"

namespace signorini::sensitivity_study {

// Standard deviations of event times and figures, to first order, from the standard deviations of keys.
//
//   sigma_x = sqrt( sum_p (dx/dp sigma_p)^2 )       for independent keys
//
// The result is valid while the sequence of events does not change. `reach` is the smallest change of a key
// at which two neighbouring events meet, divided by the key's sigma. If `reach` is below 2, more than one run in
// twenty has another sequence, and the result is only indicative.

/// Standard deviations, one per parameter; 0: the parameter is known exactly.
using Sigmas = std::vector<double>;

struct Spread {
  std::vector<double> events, responses;  ///< sigma of each time and of each figure; NaN: unknown
  std::vector<double> reach;              ///< one per parameter; infinity: no events meet, or sigma is 0
};
/// Standard deviations of results, and the reach of each parameter.
[[nodiscard]] Spread spread(const Sensitivities& s, const Sigmas& sigmas);

/// Text of sensitivity.json. sigmas: empty, or one per parameter.
[[nodiscard]] std::string sensitivity_json(const Sensitivities& s, const Sigmas& sigmas);

/// Writes all files except events.csv and sensitivity.json. Errors: FileError.
void write_sensitivities(const std::filesystem::path& directory, const Sensitivities& s,
                         const Sigmas& sigmas);

/// Reads the data needed by pictures: parameters, figures, and times of events with their derivatives.
/// sigmas: set to the stored standard deviations; empty if there are none. Errors: FileError.
[[nodiscard]] Sensitivities read_sensitivities(const std::filesystem::path& directory, Sigmas& sigmas);

/// The unit of a figure, with the scene's unit names.
[[nodiscard]] std::string unit_of(const Response& figure, const Units& units);

/// (p/x) dx/dp; NaN if x or p is zero.
[[nodiscard]] double elasticity(double p, double x, double rate);
/// The name of an event's contact; "" for a jump of a load.
[[nodiscard]] std::string contact_of(const Sensitivities& s, const Event& event);
/// The name of a figure's contact; "" for a figure of the whole run.
[[nodiscard]] std::string contact_of(const Sensitivities& s, const Response& figure);

// Files of `fit` (docs/command-line.md).
//
//   fit.json        keys with their sigmas, covariance, chi_squared, reason for the end
//   residuals.csv   row,event_index,column,t,measured,residual,sigma

/// Text of fit.json.
[[nodiscard]] std::string fit_json(const Fit& fit, const Measurements& measured);
/// Writes both files. Errors: FileError.
void write_fit(const std::filesystem::path& directory, const Fit& fit, const Measurements& measured);

}  // namespace signorini::sensitivity_study
