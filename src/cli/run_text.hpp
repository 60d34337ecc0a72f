// run_text.hpp: output of `run`: the table of events, results of the contacts, the audit, the counters.
#pragma once

#include <string>

#include "cli/progress_display.hpp"
#include "cli/terminal.hpp"
#include "signorini/certify.hpp"
#include "signorini/result.hpp"

namespace signorini::cli {

/// Changes of state in a frictional start; empty for other starts.
[[nodiscard]] std::string start_table(const Model& model, TableStyle style = TableStyle::plain);

/// One row per event; if there are many, the first and the last ones. N and T are values just before the
/// event. certificate: null, or adds the error of each time and the end of the certain sequence.
[[nodiscard]] std::string event_table(const ProgressDisplay& display, const Model& model,
                                      const Certificate* certificate, TableStyle style = TableStyle::plain);

/// One row per contact: N at rest, extremes of N and T with their times, residual slip, friction loss. Styles for
/// papers list all contacts, events and outputs.
[[nodiscard]] std::string support_table(const Model& model, const Report& report,
                                        TableStyle style = TableStyle::plain);

/// One row per contact: largest displacements from the start.
[[nodiscard]] std::string contact_table(const Model& model, const Report& report,
                                        TableStyle style = TableStyle::plain);

/// One row per output: extremes with their times, and its last value; empty without outputs.
[[nodiscard]] std::string response_table(const Model& model, const Report& report,
                                         TableStyle style = TableStyle::plain);

/// Largest violation of each condition: relative, in its unit, and its place.
[[nodiscard]] std::string audit_table(const Model& model, const Audit& audit,
                                      TableStyle style = TableStyle::plain);

/// Outcome, events by type, audit, energy balance, effort.
[[nodiscard]] std::string run_summary(const RunSpec& run, const Model& model, const Report& report);

/// Time up to which the sequence is certain, or the reason why it is unknown.
[[nodiscard]] std::string certification_text(const Model& model, const CertifiedReport& run);

}  // namespace signorini::cli
