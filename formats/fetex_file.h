// SPDX-License-Identifier: Apache-2.0 OR MIT
/// A whole .fetex file in memory: metadata and representations (SPEC.md §2). Everything read is checked: what read_file
/// returns can be sampled.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "formats/bilevel.h"
#include "formats/container.h"
#include "formats/fbt.h"
#include "formats/feature_curves.h"
#include "formats/pinchmap.h"
#include "formats/silmap.h"

namespace fetex {

/// UTF-8 keys and values, sorted by key bytes. Keys in use: SPEC.md §2.1.
using Metadata = std::map<std::string, std::string>;

struct FetexFile {
    Metadata metadata;
    std::optional<FbtTexture> fbt;
    std::optional<BilevelTexture> bilevel = {};
    std::optional<SilmapTexture> silmap = {};
    std::optional<PinchmapTexture> pinchmap = {};
    std::optional<FeatureCurvesTexture> feature_curves = {};
};

/// The file's bytes, the same for the same content. Bytes that aren't UTF-8 in metadata become U+FFFD; empty keys are
/// left out. Preconditions: fbt passes validate_fbt, bilevel validate_bilevel, silmap
/// validate_silmap, pinchmap validate_pinchmap, feature_curves validate_feature_curves.
std::vector<std::uint8_t> write_file(const FetexFile& file);

/// Reads and validates everything; the first finding, or nullopt and a complete `out`. Unknown ancillary chunks are
/// skipped, unknown critical ones refused. Safe on untrusted bytes; allocates in proportion to bytes.size().
std::optional<Finding> read_file(FetexFile& out, ByteSpan bytes);

/// All findings (at most `limit`), with offsets from the start of the file. Empty: read_file succeeds.
std::vector<Finding> validate_file(ByteSpan bytes, std::size_t limit = 64);

/// Bytes of UTF-8 text without those that aren't; each bad byte becomes U+FFFD.
std::string to_valid_utf8(const std::string& text);

} // namespace fetex
