// certificate_json.hpp: what summary.json says of a certificate (docs/output.md).
#pragma once

#include "base/json.hpp"
#include "signorini/certify.hpp"

namespace signorini {

/// `certified`; null where there is no certificate.
[[nodiscard]] Json certificate_json(const CertifiedReport& run);

/// Bounds of the peaks of contact k; null where nobody knows.
[[nodiscard]] Json peak_errors_json(const CertifiedReport& run, std::size_t k);
/// The same of one of its landings.
[[nodiscard]] Json landing_errors_json(const CertifiedReport& run, std::size_t k, std::size_t landing);

}  // namespace signorini
