// SPDX-License-Identifier: Apache-2.0 OR MIT
/// What the reader and the validator can find wrong. A number never changes its meaning; SPEC.md lists them.
#pragma once

#include <cstdint>
#include <string>

namespace fetex {

/// 01xx container, 02xx chunk contents, 1xxx meaning of an FBT, 2xxx of a bi-level texture, 3xxx of a
/// silhouette-map texture, 4xxx of a pinchmap, 5xxx of a texture with feature curves.
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
    BadMetadata = 202,  ///< META: counts, lengths, UTF-8, order of keys
    MissingChunk = 203, ///< FBTH without FBTT or FBTR, or the other way round; some levels of FBTM, or ones beyond;
                        ///< likewise BLVH, BLVT, BLVM; BLVI that BLVH doesn't ask for, or the other way round;
                        ///< likewise SLMH, SLMC, SLMS, SLMM; likewise PNCH, PNCD, PNCS, PNCM; likewise FCVH, FCVC,
                        ///< FCVS, FCVD, FCVB, FCVP, FCVM; FCVG or FCVI that FCVH doesn't ask for, or the other
                        ///< way round
    BadFbtHeader = 204,         ///< FBTH: length, reserved words, flags
    FbtSizeMismatch = 205,      ///< FBTT, FBTC, FBTR or a level of FBTM has not the length that FBTH asks for
    BadBilevelHeader = 206,     ///< BLVH: length, dimensions, rule, reserved words
    BilevelSizeMismatch = 207,  ///< BLVT, BLVI or a level of BLVM has not the length that BLVH asks for
    RepresentationKinds = 208,  ///< one number has chunks of two representations
    BadSilmapHeader = 209,      ///< SLMH: length, dimensions, formats, reserved words
    SilmapSizeMismatch = 210,   ///< SLMC, SLMS or a level of SLMM has not the length that SLMH asks for
    BadPinchmapHeader = 211,    ///< PNCH: length, dimensions, formats, flags, line, reserved words
    PinchmapSizeMismatch = 212, ///< PNCD, PNCS or a level of PNCM has not the length that PNCH asks for
    BadFeatureHeader = 213,     ///< FCVH: length, dimensions, formats, flags, numbers, reserved words
    FeatureSizeMismatch = 214,  ///< another chunk FCV… has not the length that FCVH asks for

    FbtDimensions = 1001,        ///< width, height 1 … 16384; lengths of the arrays
    FbtReservedBits = 1003,      ///< reserved bits of a texel or entry; a solid texel's colour that isn't opaque
    FbtAddress = 1004,           ///< address of a list, a directory or a patch beyond the records
    FbtBandCount = 1005,         ///< directory without bands or beyond the records
    FbtBandOrder = 1006,         ///< y_end not increasing within (0,1], or the last isn't 1
    FbtNoLastEntry = 1007,       ///< entry list runs off the records
    FbtTooManyEntries = 1008,    ///< entry list longer than kFbtMaxEntries
    FbtEmptyRun = 1009,          ///< an entry without pieces that is more than a lone rest
    FbtDegree = 1010,            ///< pieces without a degree, or a degree without pieces
    FbtPieceAddress = 1011,      ///< points beyond the records
    FbtUnfinishedFeature = 1012, ///< the last entry isn't the last run of its feature
    FbtStraySample = 1014, ///< a sample on a run that isn't the last of its feature, or a rest before the last entry
    FbtCorners = 1015,     ///< the model corners in a texture that has none
    FbtPadding = 1016,     ///< padding of an entry or directory isn't 0
    FbtNotMonotone = 1017, ///< piece turns back in x or y by more than kFbtMonotoneSlack steps
    FbtNotPremultiplied = 1018, ///< a colour channel exceeds alpha
    FbtTraitsMismatch = 1019,   ///< traits don't describe the texture
    FbtModel = 1020,            ///< unknown model, or a shaded texel that is solid
    FbtSampleValue = 1022,      ///< a half that is negative, infinite or no number, or an alpha above 1
    FbtNesting = 1021,          ///< depths that aren't those of features right after what lies inside them

    BilevelDimensions = 2001,       ///< width, height, sides of the image 1 … 16384; lengths of the arrays
    BilevelRuleChannels = 2002,     ///< unknown rule, or not as many channels as it combines
    BilevelNotPremultiplied = 2003, ///< a colour channel of below, above or the image exceeds alpha

    SilmapDimensions = 3001,       ///< width, height 1 … 16384; lengths of the arrays
    SilmapFormat = 3002,           ///< unknown cell or sample format; a cell of 8 bits with more
    SilmapNotPremultiplied = 3003, ///< a colour channel exceeds alpha
    SilmapSampleValue = 3004,      ///< as FbtSampleValue; or alpha that isn't 1 in RGB8

    PinchmapDimensions = 4001,       ///< sides of the signal 1 … 16384; lengths of the arrays
    PinchmapFormat = 4002,           ///< unknown map or sample format; a line wider than a texel
    PinchmapNotPremultiplied = 4003, ///< a colour channel exceeds alpha
    PinchmapSampleValue = 4004,      ///< as SilmapSampleValue
    PinchmapValue = 4005,     ///< a value beyond ±1; gamma of ±1; k none of -1, 0, 1; a direction where k isn't 0
    PinchmapCluster = 4006,   ///< a cluster with four active texels, with two across, or on both sides
    PinchmapDirection = 4007, ///< active where no line is, or beside another without one between; a direction that
                              ///< isn't from the side -1 to the side +1

    FeatureDimensions = 5001, ///< width, height 1 … 16384; lengths of the arrays
    FeatureFormat = 5002,     ///< unknown number format, sample format or kind; limit of distances, scale of heights
    FeatureBadTexel = 5003,   ///< not a valid configuration; a straight bit in a linear texture
    FeatureNumber = 5004, ///< position outside 0 … 1, angle outside 0 … π, distance outside 0 … limit, gradient
                          ///< outside −1 … 1
    FeatureUnusedEdge = 5005,       ///< an edge that no segment ends on hasn't the default position, angle and profile
    FeatureNoCurve = 5006,          ///< a segment that isn't straight, and whose tangents don't meet in the texel
    FeatureNotPremultiplied = 5007, ///< a colour channel exceeds alpha
    FeatureSampleValue = 5008,      ///< as SilmapSampleValue
    FeatureProfileValue = 5009,     ///< a height or slope beyond ±65504, a blend outside 0 … 1
    FeatureProfileNumber = 5010,    ///< a corner or an edge has a profile that isn't there
};

/// One finding. offset: bytes from the start of the file, or, from validate_fbt and the like, of the part that the
/// message names.
struct Finding {
    FindingCode code{};
    std::uint64_t offset = 0;
    std::string message;
};

/// "F0101".
std::string finding_id(FindingCode code);

} // namespace fetex
