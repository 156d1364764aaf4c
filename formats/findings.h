// SPDX-License-Identifier: Apache-2.0 OR MIT
/// What the reader and the validator can find wrong. A number never changes its meaning; SPEC.md lists them.
#pragma once

#include <cstdint>
#include <string>

namespace fetex {

/// 01xx container, 02xx chunk contents, 1xxx meaning of an FBT.
enum class FindingCode : std::uint16_t {
    Truncated = 101,          ///< the file ends before its stated length
    BadMagic = 102,           ///< not a .fetex file, or mangled by a text transfer
    UnsupportedVersion = 103, ///< major version unknown
    BadHeaderChecksum = 104,
    ExtraBytes = 105,       ///< bytes after the stated length
    TooManyChunks = 106,    ///< chunk table beyond kMaxChunks or the file
    BadTableChecksum = 107, ///< chunk table
    BadChunkType = 108,     ///< fourcc not of A–Z, 0–9
    ReservedNotZero = 109,  ///< reserved bits of the chunk table
    BadChunkOffset = 110,   ///< chunk overlaps, leaves a gap, or isn't aligned
    BadChunkSize = 111,     ///< chunk beyond the end of the file
    DuplicateChunk = 112,   ///< two chunks with the same fourcc, representation and level
    PaddingNotZero = 113,   ///< padding between chunks
    BadChunkChecksum = 114,
    BadLength = 115, ///< stated length isn't the end of the last chunk

    UnknownCriticalChunk = 201,
    BadMetadata = 202,     ///< META: counts, lengths, UTF-8, order of keys
    MissingChunk = 203,    ///< FBTH without FBTT or FBTR, or the other way round
    BadFbtHeader = 204,    ///< FBTH: length, reserved words, flags
    FbtSizeMismatch = 205, ///< FBTT or FBTR has not the length that FBTH asks for

    FbtDimensions = 1001,        ///< width, height 1 … 16384; apron 0 or 1; lengths of the arrays
    FbtTexelKind = 1002,         ///< kind 3
    FbtReservedBits = 1003,      ///< reserved bits of a texel, directory or entry
    FbtAddress = 1004,           ///< address beyond the records
    FbtBandCount = 1005,         ///< directory without bands or beyond the records
    FbtBandOrder = 1006,         ///< y_end not increasing within (0,1], or the last isn't 1
    FbtNoTerminator = 1007,      ///< entry list runs off the records
    FbtTooManyEntries = 1008,    ///< entry list longer than kFbtMaxEntries
    FbtEmptyRun = 1009,          ///< run without pieces
    FbtDegree = 1010,            ///< degree 0
    FbtPieceAddress = 1011,      ///< pieces beyond the records
    FbtUnfinishedFeature = 1012, ///< terminator follows a run that isn't the last of its feature
    FbtTerminator = 1013,        ///< terminator with pieces or other bits
    FbtStraySample = 1014,       ///< sample or mask on a run that isn't the last of its feature
    FbtMask = 1015,              ///< mask asks for a texel that isn't there: the apron is missing
    FbtPadding = 1016,           ///< padding of pieces or directory isn't 0
    FbtNotMonotone = 1017,       ///< piece turns back in x or y by more than kFbtMonotoneSlack steps
    FbtNotPremultiplied = 1018,  ///< a colour channel exceeds alpha
    FbtTraitsMismatch = 1019,    ///< traits don't describe the texture
};

/// One finding. offset: bytes from the start of the file, or, from validate_fbt, of the part the message names.
struct Finding {
    FindingCode code{};
    std::uint64_t offset = 0;
    std::string message;
};

/// "F0101".
std::string finding_id(FindingCode code);

} // namespace fetex
