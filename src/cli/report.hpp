// report.hpp: what `run` prints: the table of events, how the contacts fared, the audit, the counters.
#pragma once

#include <string>

#include "cli/live.hpp"
#include "cli/table.hpp"
#include "signorini/certify.hpp"
#include "signorini/result.hpp"

namespace signorini::cli {

/// The changes of state in a frictional start; empty without.
[[nodiscard]] std::string start_table(const Model& model, TableStyle style = TableStyle::plain);

/// One row an event; of many, the first and the last ones. N and T as they are just before the event. A
/// certificate, or null, says how far off each time may be, and where the sequence ends to be certain.
[[nodiscard]] std::string event_table(const Live& live, const Model& model, const Certificate* certificate,
                                      TableStyle style = TableStyle::plain);

/// One row a contact: N at rest, extremes of N and T with their times, residual slip, friction loss. In a style for
/// papers all of them, as of events and outputs.
[[nodiscard]] std::string support_table(const Model& model, const Report& report,
                                        TableStyle style = TableStyle::plain);

/// One row a contact: greatest motions from the start.
[[nodiscard]] std::string contact_table(const Model& model, const Report& report,
                                        TableStyle style = TableStyle::plain);

/// One row an output: extremes with their times, and its last value; empty without outputs.
[[nodiscard]] std::string response_table(const Model& model, const Report& report,
                                         TableStyle style = TableStyle::plain);

/// Greatest violation of each condition: relative, in its unit, where.
[[nodiscard]] std::string audit_table(const Model& model, const Audit& audit,
                                      TableStyle style = TableStyle::plain);

/// Outcome, events by type, audit, energy balance, effort.
[[nodiscard]] std::string closing(const RunSpec& run, const Model& model, const Report& report);

/// Until when the sequence is certain, or why nobody knows.
[[nodiscard]] std::string certification(const Model& model, const CertifiedReport& run);

}  // namespace signorini::cli
