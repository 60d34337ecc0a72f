// run_text.hpp: text output of `run`: events, results of the contacts, outputs, audit, counters.
#pragma once

#include <string>

#include "cli/progress_display.hpp"
#include "cli/terminal.hpp"
#include "signorini/certify.hpp"
#include "signorini/result.hpp"

namespace signorini::cli {

/// Table of the changes of contact states in a frictional start; empty for other starts.
[[nodiscard]] std::string start_table(const Model& model, TableStyle style = TableStyle::plain);

/// One row per event; of many events only the first and the last. N and T are values just before the event. certificate:
/// adds the error bound of each time, and a line after the last certified event; may be null.
[[nodiscard]] std::string event_table(const ProgressDisplay& display, const Model& model,
                                      const Certificate* certificate, TableStyle style = TableStyle::plain);

/// One row per contact: N at rest, extremes of N and T with their times, residual slip, friction loss. In this and the
/// other tables, styles for papers list all contacts, events and outputs.
[[nodiscard]] std::string support_table(const Model& model, const Report& report,
                                        TableStyle style = TableStyle::plain);

/// One row per contact: largest displacements along t and n, relative to the start.
[[nodiscard]] std::string contact_table(const Model& model, const Report& report,
                                        TableStyle style = TableStyle::plain);

/// One row per output: extremes with their times, and the last value; empty if the model has no outputs.
[[nodiscard]] std::string response_table(const Model& model, const Report& report,
                                         TableStyle style = TableStyle::plain);

/// One row per audited condition: its largest violation, relative and with unit, and the time and contact.
[[nodiscard]] std::string audit_table(const Model& model, const Audit& audit,
                                      TableStyle style = TableStyle::plain);

/// Outcome, events by type, audit, energy balance, effort.
[[nodiscard]] std::string run_summary(const RunSpec& run, const Model& model, const Report& report);

/// Text about the modes that a reduced model leaves out, and their estimated effect at contacts; "" without a reduction.
[[nodiscard]] std::string reduction_text(const Model& model, const CertifiedReport& run);

/// Text about the time up to which the sequence of events is certified, or the reason why it is not certified.
[[nodiscard]] std::string certification_text(const Model& model, const CertifiedReport& run);

}  // namespace signorini::cli
