// SPDX-License-Identifier: Apache-2.0 OR MIT
#pragma once

#include "formats/bytes.h"

namespace fetex {

/// CRC-32C (Castagnoli, reflected polynomial 0x82f63b78, initial and final complement). "123456789" gives 0xe3069283.
std::uint32_t crc32c(ByteSpan bytes);

/// The same on any machine; crc32c() itself uses the processor's instruction where there is one (x86-64).
std::uint32_t crc32c_by_tables(ByteSpan bytes);

} // namespace fetex
