// sensitivity_files.hpp: what `sensitivity` writes (docs/command-line.md).
//
//   events.csv          those of the run
//   sensitivities.csv   event_index,t,contact,event,parameter,dt_dp,...,elasticity
//                       one row an event and parameter
//   figures.csv         figure,contact,value,t,parameter,dvalue_dp,dt_dp,elasticity
//                       peaks, what is left; losses of contacts and of the run
//   landings.csv        contact,landing,start,...,parameter,dstart_dp,...      with losses
//   columns-1.csv, ...  the header of history.csv and columns of contacts, with losses those of energy.csv;
//                       derivatives by the first parameter, ...
//   sensitivity.json    parameters, where the sequence would change, spreads
//
// elasticity = (p/x) dx/dp, what one per cent of p makes of x in per cent; x: the time, the figure.
#pragma once

#include <filesystem>

#include "study/sensitivity/spread.hpp"

namespace signorini {

/// sigmas: empty, or one a parameter.
[[nodiscard]] std::string sensitivity_json(const Sensitivities& s, const Sigmas& sigmas);

/// All but events.csv and sensitivity.json. Errors: FileError.
void write_sensitivities(const std::filesystem::path& directory, const Sensitivities& s,
                         const Sigmas& sigmas);

/// Back from its files, as far as pictures need it: parameters, figures, and times of events with their derivatives; sigmas
/// are empty where there were none. Errors: FileError.
[[nodiscard]] Sensitivities read_sensitivities(const std::filesystem::path& directory, Sigmas& sigmas);

/// The unit of a figure, in the scene's words.
[[nodiscard]] std::string unit_of(const Response& figure, const Units& units);

/// (p/x) dx/dp; NaN where x or p is zero.
[[nodiscard]] double elasticity(double p, double x, double rate);
/// The name of an event's contact; "" for a jump of a load.
[[nodiscard]] std::string contact_of(const Sensitivities& s, const Event& event);
/// That of a figure; "" for one of the whole run.
[[nodiscard]] std::string contact_of(const Sensitivities& s, const Response& figure);

}  // namespace signorini
