// certificate_json.hpp: the certificate in summary.json (docs/output.md).
#pragma once

#include "base/json.hpp"
#include "signorini/certify.hpp"

namespace signorini {

/// `certified`; null if there is no certificate.
[[nodiscard]] Json certificate_json(const CertifiedReport& run);

/// Error bounds of the peaks of contact k; null if unknown.
[[nodiscard]] Json peak_errors_json(const CertifiedReport& run, std::size_t k);
/// Error bounds of one of its landings; null if unknown.
[[nodiscard]] Json landing_errors_json(const CertifiedReport& run, std::size_t k, std::size_t landing);

}  // namespace signorini
