// certificate_files.hpp: additional files of a certified run (docs/output.md).
//
//   events.csv   two additional columns, t_error and certain
//   errors.csv   the columns of history.csv, with error bounds as values
//
// events.csv is a complete table at any time: without the additional columns until the certificate is known, then with
// them.
#pragma once

#include <array>
#include <filesystem>

#include "base/json.hpp"
#include "signorini/certify.hpp"

namespace signorini::result {

struct CertificateColumn {
  const char* name;
  const char* unit;
  const char* meaning;  ///< for the documentation
};

inline constexpr std::array certificate_columns = {
    CertificateColumn{"t_error", "time",
                      "bound of the error of `t`, which includes errors of earlier events; empty: unknown"},
    CertificateColumn{"certain", "",
                      "1: this event and all earlier events are those of the exact motion; 0: not certified"},
};

/// Adds the columns t_error and certain to events.csv, and writes errors.csv. Errors: FileError.
void write_certificate(const std::filesystem::path& directory, const Model& model,
                       const Certificate& certificate);

// The certificate in summary.json (docs/output.md).

/// Value of the key `certified` in summary.json; null if the run has no certificate.
[[nodiscard]] base::Json certificate_json(const CertifiedReport& run);

/// Error bounds of the peaks of contact k; null if unknown.
[[nodiscard]] base::Json peak_errors_json(const CertifiedReport& run, std::size_t k);
/// Error bounds of one landing of contact k; null if unknown.
[[nodiscard]] base::Json landing_errors_json(const CertifiedReport& run, std::size_t k, std::size_t landing);

}  // namespace signorini::result
