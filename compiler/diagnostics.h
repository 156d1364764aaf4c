// SPDX-License-Identifier: GPL-3.0-or-later
/// The numbers of all errors and diagnostics. A number never changes its meaning; README.md lists them for users.
/// 1xxx input/front end errors, 2xxx front end warnings, 3xxx scene, 4xxx geometry and planar map, 5xxx
/// representations, 6xxx container and validation, 7xxx runtime (GL), 8xxx command line and I/O.
#pragma once

namespace fetexc::diag {

// One line each: tests/tools/diagnostics_table.py reads them.
// clang-format off

// SVG front end (owner: compiler/svg): errors
inline constexpr int kSvgMalformed = 1001;       ///< not XML, or not an SVG
inline constexpr int kSvgNotUtf8 = 1002;         ///< only UTF-8 is read
inline constexpr int kSvgBadGzip = 1003;         ///< damaged .svgz
inline constexpr int kSvgNoSize = 1004;          ///< width or height is zero, negative or not finite
inline constexpr int kSvgTooManyBytes = 1005;    ///< the file, unpacked, is longer than the limit
inline constexpr int kSvgTooManyElements = 1006; ///< elements, after expanding use, patterns, masks and markers
inline constexpr int kSvgTooDeep = 1007;         ///< nesting beyond the limit, or references in a circle
inline constexpr int kSvgTooManySegments = 1008; ///< path segments, after stroking and expansion
inline constexpr int kSvgTimeout = 1009;         ///< reading took longer than the limit
inline constexpr int kSvgInternal = 1010;        ///< a library failed
inline constexpr int kSvgFontFile = 1011;        ///< a font file can't be read or holds no font
inline constexpr int kSvgTooManyPixels = 1012;   ///< raster layers or bitmaps beyond the limit

// Images and their features (owner: compiler/raster, cli): errors
inline constexpr int kImageUnreadable = 1101;  ///< an image that is damaged, or of a kind that OpenImageIO doesn't read
inline constexpr int kImageTooLarge = 1102;    ///< an image of more than 16384 pixels on a side, or more than 2^26
inline constexpr int kImageUnsupported = 1103; ///< an image with depth (deep data, a volume), or of whose channels none are R, G and B, or Y, or the only one
inline constexpr int kTraceFailed = 1104;      ///< features couldn't be traced
inline constexpr int kImageMemory = 1105;      ///< an image's texture would take more than 20 GiB of memory on the way: too many pixels and texels

// Bezier networks (owner: compiler/network): errors
inline constexpr int kNetworkMalformed = 1501;  ///< a network that isn't JSON in UTF-8, or of another schema
inline constexpr int kNetworkMember = 1502;     ///< a network's member is missing, unknown, or of the wrong type
inline constexpr int kNetworkNumber = 1503;     ///< a number of a network is outside its range
inline constexpr int kNetworkTooLarge = 1504;   ///< a network of more than 256 MiB, or more than 2^24 segments
inline constexpr int kNetworkSegment = 1505;    ///< a network's segment hasn't 2, 4 or 6 numbers
inline constexpr int kNetworkProfile = 1506;    ///< a profile that isn't there, has no or two shapes, or a table out of order

// SVG front end: warnings, something of the drawing is missing or changed
inline constexpr int kSvgTextWithoutFonts = 2001;  ///< text is not drawn, no fonts were given
inline constexpr int kSvgFontNotFound = 2002;      ///< a font or glyph is missing
inline constexpr int kSvgAnimation = 2003;         ///< animation ignored
inline constexpr int kSvgScript = 2004;            ///< scripts are not run
inline constexpr int kSvgSvgFont = 2005;           ///< SVG fonts and @font-face are not supported
inline constexpr int kSvgVectorEffect = 2006;      ///< a vector-effect other than non-scaling-stroke
inline constexpr int kSvgMediaQuery = 2007;        ///< rules inside @media ignored
inline constexpr int kSvgMeshOrHatch = 2008;       ///< mesh gradients and hatches are not supported
inline constexpr int kSvgExternalReference = 2009; ///< reference to another document
inline constexpr int kSvgForeignObject = 2010;     ///< foreignObject is not drawn
inline constexpr int kSvgParserMessage = 2011;     ///< another complaint of the SVG parser
inline constexpr int kSvgBadGeometry = 2012;       ///< coordinates overflow, the shape is not drawn
inline constexpr int kSvgPlusLighter = 2013;       ///< mix-blend-mode plus-lighter drawn as normal
inline constexpr int kSvgGradientBands = 2014;     ///< hard edges of a gradient stay inside its paint, they are not features
inline constexpr int kSvgDashTooFine = 2015;       ///< too many dashes, drawn solid
inline constexpr int kSvgImageDropped = 2016;      ///< a bitmap is too large or damaged
inline constexpr int kSvgRasterReduced = 2017;     ///< a bitmap has far more pixels than the texture can show

// Images and their features: warnings
inline constexpr int kFeaturesAspect = 2051;     ///< the features' drawing has another aspect than the image, and is stretched over it
inline constexpr int kNoFeatures = 2052;         ///< no feature lies on the image: its texture is an ordinary bilinear one
inline constexpr int kFeaturesUnclipped = 2053;  ///< clips and masks in the features' drawing don't cut its features
inline constexpr int kImageClipped = 2054;       ///< pixels beyond 0…1 (`--samples float`: 0…65504), or not finite, were clipped
inline constexpr int kRegionsUnsampled = 2055;   ///< parts without a valid pixel to reach took prefiltered ones
inline constexpr int kTexelsTooSmall = 2056;     ///< more than four texels a pixel along a side: gradients may stop before they reach a feature
inline constexpr int kMoreImages = 2057;         ///< the file holds more images (pages, parts, layers, frames): the first was taken

// Bezier networks: warnings
inline constexpr int kNetworkPointSegments = 2061; ///< segments of a network that are a single point were left out (count)
inline constexpr int kNetworkEmpty = 2062;         ///< a network, or a drawing taken as one, without a curve

// SVG front end: notes, how something is represented
inline constexpr int kSvgFilterRasterised = 2101;  ///< filtered content became a raster layer
inline constexpr int kSvgPatternRasterised = 2102; ///< a pattern of very many tiles became a raster layer
inline constexpr int kSvgBitmapImage = 2103;       ///< an embedded bitmap became a raster layer

// Images and their features: notes
inline constexpr int kFeaturesFloating = 2151; ///< parts of features that end inside a texel split nothing there, and were ignored

// Scene (owner: compiler/scene)
inline constexpr int kSceneExtentInvalid = 3001;     ///< canvas size not finite, not positive, or beyond double precision
inline constexpr int kSceneCoordinateInvalid = 3002; ///< a coordinate of a path is NaN or infinite, or a degree is not 1…3
inline constexpr int kSceneReferenceInvalid = 3003;  ///< the compositing tree is inconsistent: index out of range, cycle, bad nesting
inline constexpr int kSceneTooLarge = 3004;          ///< beyond a limit of the scene: segments, nesting depth, nested masks
inline constexpr int kScenePaintInvalid = 3005;      ///< a paint holds a non-finite number or a bitmap of the wrong length

// Geometry and planar map (owner: compiler/geometry, compiler/planar)
inline constexpr int kPlanarInconsistent = 4001;   ///< an internal invariant of the planar map failed; nothing is written
inline constexpr int kTooManyIntersections = 4002; ///< limit on arrangement size exceeded
inline constexpr int kSliversCollapsed = 4101;     ///< parts of the picture, everywhere thinner than the output grid, were left out (count)

// Representations (owner: compiler/fbt, compiler/bilevel, compiler/silmap, compiler/pinchmap)
inline constexpr int kSizeOutOfRange = 5001; ///< --size outside 1 … 16384 texels
inline constexpr int kFbtTooLarge = 5002;    ///< more records than the format can address
inline constexpr int kFbtBudget = 5003;      ///< no size fits in --max-bytes
inline constexpr int kNotTwoColors = 5011;   ///< a bi-level texture of a drawing that hasn't two colours needs --silhouette
inline constexpr int kNoSuchElement = 5012;  ///< --silhouette names an element that isn't drawn
inline constexpr int kSilmapBudget = 5021;   ///< no size of a silhouette-map texture fits in --max-bytes
inline constexpr int kSilmapErrorUnmet = 5022; ///< no size of a silhouette-map texture has as little wrong area as asked for
inline constexpr int kPinchmapBudget = 5031;     ///< no size of a pinchmap fits in --max-bytes
inline constexpr int kPinchmapErrorUnmet = 5032; ///< no size of a pinchmap has as little wrong area as asked for
inline constexpr int kFeatureBudget = 5041;      ///< no size of a texture with feature curves fits in --max-bytes
inline constexpr int kFeatureErrorUnmet = 5042;  ///< no size of a texture with feature curves has them as near to where they belong as asked for
inline constexpr int kBilevelPartsLost = 5101;  ///< parts of a silhouette that its texture doesn't show: thinner than its texels (count)
inline constexpr int kBilevelPartsFalse = 5102; ///< parts that a bi-level texture shows and the silhouette hasn't (count)
inline constexpr int kBilevelColorsVary = 5103; ///< edges of a silhouette whose colours vary: what they bound is above or below as a whole, by the mean along its edges (count)
inline constexpr int kSilmapCellsCrowded = 5121; ///< cells of a silhouette map that hold more than a point and its four links can show (count)
inline constexpr int kSilmapPartsLost = 5122;    ///< parts of the picture that no texel of a silhouette-map texture has: thinner than its texels (count)
inline constexpr int kPinchmapPartsLost = 5131;    ///< parts of the drawing that a pinchmap can't hold: too thin or too crowded for its clusters, they are blurred (area)
inline constexpr int kPinchmapCrosses = 5132;      ///< crossings of edges that a pinchmap blurs (count)
inline constexpr int kPinchmapEdgesBlurred = 5133; ///< visible edges that a pinchmap blurs: between colours of one zone, or soft in the image (count)

// Feature curves (owner: compiler/feature_curves)
inline constexpr int kFeatureMoved = 5141;   ///< texels in which feature curves were moved by more than half a texel, to have one point an edge and two segments a texel (count, farthest)
inline constexpr int kFeatureEndsCut = 5142; ///< ends of feature curves inside a texel that end on its boundary instead (count)
inline constexpr int kFeatureLost = 5143;    ///< feature curves that lie inside one texel, or fold back in it, and don't show (count)
inline constexpr int kFeatureStraightened = 5144; ///< segments of feature curves that are straight, and bend where they end, as no valid quadratic was found or rounding broke it (count)
inline constexpr int kFeatureSides = 5145; ///< curves whose sides have colours of their own (`left`, `right`), which no texture with feature curves shows (count)
inline constexpr int kFeatureProfiles = 5148; ///< curves that have another profile than they ask for: where they cross an edge of a texel with others, or beyond the 16 of a texture (count)
inline constexpr int kFeatureOtherTruth = 5149; ///< `compare`: a texture with feature curves was made with another base map or profile than its truth has

// Command line and files (owner: cli)
inline constexpr int kCannotOpen = 8001;          ///< an input can't be opened
inline constexpr int kCannotRead = 8002;          ///< an input can't be read
inline constexpr int kInputTooLong = 8003;        ///< an input is longer than the limit of bytes
inline constexpr int kCannotCreate = 8011;        ///< an output can't be created
inline constexpr int kCannotWrite = 8012;         ///< an output can't be written; what was there before is untouched
inline constexpr int kCannotMakeFolder = 8013;    ///< the output folder can't be made
inline constexpr int kWouldOverwriteInput = 8014; ///< the output is one of the inputs
inline constexpr int kSameOutputTwice = 8015;     ///< two inputs would be written to one file
inline constexpr int kDepfileName = 8021;         ///< a file name that a dependency file can't hold
inline constexpr int kCannotEncodePicture = 8031; ///< the picture can't be encoded
inline constexpr int kBadPicture = 8032;          ///< a PNG that can't be decoded, or has more than 16384 pixels on a side
inline constexpr int kBadUsage = 8041;            ///< unknown option, bad value or combination
inline constexpr int kBeyondThreshold = 8045;     ///< `compare`: the difference is beyond a threshold (exit code 7)
inline constexpr int kOutOfMemory = 8051;         ///< the machine has no more memory
inline constexpr int kInternal = 8052;            ///< an error of the program itself
inline constexpr int kNoModule = 8053;            ///< a library of the program's own isn't where it belongs, or can't be loaded

// Container, seen from the command line; the findings themselves are F numbers (formats/findings.h)
inline constexpr int kInvalidFetex = 6001;          ///< the .fetex file breaks a rule of SPEC.md
inline constexpr int kNoSuchRepresentation = 6002;  ///< the file is fine but doesn't hold the representation asked for, or none

// clang-format on

} // namespace fetexc::diag
