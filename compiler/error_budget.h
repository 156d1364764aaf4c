// SPDX-License-Identifier: GPL-3.0-or-later
/// Every tolerance of the compiler, named, with its unit and where it comes from. Nothing else decides "close enough".
#pragma once

namespace fetexc::budget {

/// Unit roundoff of double: |fl(a∘b) − a∘b| ≤ kUnitRoundoff·|a∘b|.
inline constexpr double kUnitRoundoff = 0x1p-53;

/// Added to every widening so that results near 0 stay enclosed; far below any quantity of the compiler (smallest:
/// 2^-60 steps).
inline constexpr double kUnderflowGuard = 0x1p-1000;

/// de Casteljau in double, degree ≤ 3, |t| ≤ 2, control values at most M from their origin: three levels of a + t(b −
/// a), each with three roundings of values ≤ 4·M, doubled twice more by |t| ≤ 2: less than 64 roundings of M. For t in
/// [0,1] a quarter of that.
inline constexpr double kEvaluationError = 64 * kUnitRoundoff;

/// One de Casteljau split of control values at most M: three levels of a + u·(b − a), each with roundings of 2M, 2M and
/// M, convexly averaged afterwards: less than 16 roundings of M per split.
inline constexpr double kSplitError = 16 * kUnitRoundoff;

/// Splits after which the intersection filter hands a pair to exact arithmetic: the enclosures of a double root can't
/// be told apart below the square root of the evaluation error (2^-24). Of 330,000 certified pairs of the corpus and
/// the pair oracle none needs more than 24.
inline constexpr int kFilterMaxDepth = 28;

/// Part of a bracket: the step after a Newton step this short is about its square, below a rounding. Decides nothing:
/// the enclosure around the root is found by certified signs.
inline constexpr double kNewtonStop = 0x1p-28;

/// Part of a box: after eight Newton steps a step this small is worth a certificate. Decides nothing: the Krawczyk test
/// does.
inline constexpr double kNewtonSettled = 1e-3;

/// Box pairs the filter looks at before it hands the pair to exact arithmetic; generic pairs need 1…60, outlines that
/// run side by side up to about 1550 (exact arithmetic takes as long as 400).
inline constexpr int kFilterMaxBoxes = 2000;

/// Part of a parameter range: the first guess for the half width of a root's enclosure is never larger (the square root
/// of a double's resolution, with some room: what a double root needs); the enclosure is widened from there until it is
/// certified.
inline constexpr double kFirstWidening = 0x1p-30;

/// Bits of a certified refinement in exact arithmetic: first try, and the limit at which two curves that never separate
/// are reported as an inconsistency instead of looping (2^-4096 of a parameter is beyond any root separation seen).
inline constexpr int kRefineBits = 96;
inline constexpr int kRefineBitsLimit = 4096;

/// Halvings of a range after which roots that are still together are looked into for being multiple ones. Decides
/// nothing.
inline constexpr int kDescartesHalvings = 16;

/// Bits of the roots from which crossings are certified, first and second try; with some bits of a double left around
/// them. Decides nothing.
inline constexpr int kNearRootBits[] = {12, 46};

/// Curve parameter: where roots near a stretch are looked for, its range is rounded outwards to so many bits. Decides
/// nothing: what is beyond the stretch itself is left out.
inline constexpr int kOuterRangeBits = 16;

/// Relative to the size of the curves: a point enclosed no tighter by plain evaluation is narrowed by exact residuals
/// (geometry/precise). Well-conditioned crossings are at about 2^-44.
inline constexpr double kPointWidth = 0x1p-40;

/// Part of a coordinate: what the roundings of plain evaluation to the absolute position add up to (three, widened to
/// both sides), doubled.
inline constexpr double kRoundingWidth = 16 * kUnitRoundoff;

/// Before that, in 128-bit integers: bits of the parameters, that a 64-bit integer holds up to ±2; what evaluation errs
/// by, in units of 2^-kFixedBits (a cubic by Horner: three products, each rounded by a unit and then doubled); and the
/// steps of Newton's interval operator, which gain about 2^40/condition each.
inline constexpr int kShortBits = 62;
inline constexpr int kShortError = 7;
inline constexpr int kShortSteps = 4;

/// Bits of the parameters beyond that: residuals of curves of size 2^44 are then exact to 2^-84 steps.
inline constexpr int kPreciseBits = 128;

/// Part of a Newton step by which the step goes on beyond the root it expects, so that the next exact sign closes the
/// bracket from the other side. Decides nothing.
inline constexpr double kNewtonOvershoot = 0x1p-20;

/// Newton on exact residuals gains about 2^50/condition a step; it stops at steps of 2^(kPreciseSlack − bits), or after
/// so many: far from two roots close together each step only halves the distance.
inline constexpr int kPreciseSlack = 18;
inline constexpr int kPreciseSteps = 64;

/// Coordinates for ordering points that doubles can't tell apart: multiples of 2^-72 steps, from parameters of 192 bits
/// (error 3·2^44·5·2^-174 < 2^-125 steps).
inline constexpr int kFixedBits = 72;
inline constexpr int kFixedParameterBits = 192;

/// Bits of a parameter at which cubics are exact to kFixedBits: art that is symmetric passes corners of the grid at 1/2
/// and 1/4.
inline constexpr int kWholeBits = kFixedBits / 3;

/// Units of 2^-kFixedBits: rounding errs by half a unit, so a difference beyond this has a certain sign.
inline constexpr int kFixedCertain = 4;

/// Bits of a parameter from which a coordinate's own isolating interval is taken. Too few can't mislead: an interval
/// that holds two roots is no answer.
inline constexpr int kCoordinateBits = 256;

/// Curve parameter: ranges of stretches are outer enclosures, a few roundings wide; what is looked for just beside them
/// is within this.
inline constexpr double kBesideRange = 0x1p-40;

/// Lattice steps; end points closer than this are one vertex: 2^-20 of the extent of 2^26 steps (DESIGN §3).
inline constexpr double kMergeDistance = 64.0;

/// Arcs become cubics that stay within this many lattice steps of the true arc (one step, DESIGN §4).
inline constexpr double kArcTolerance = 1.0;

/// Stroke outlines: largest distance, in lattice steps, between the cubic outline and the true offset curve: 2^-22 of
/// the extent, a quarter of the merge distance. At 256 texels that is two steps of the output grid (2^-15 texel);
/// offsets of cubics need 1.6 times as many segments for each factor 2^4 of accuracy.
inline constexpr double kStrokeTolerance = 16.0;

/// Gradient stops closer than this are one hard edge: the SVG parser moves equal offsets apart by 2^-23 up to twice.
inline constexpr double kHardEdgeGap = 3e-7;

/// Relative to the larger canvas side: how far the regions of gradient bands reach beyond the canvas. Anything positive
/// does.
inline constexpr double kBandMargin = 0x1p-4;

/// Part of a row of an index over y: the row of a coordinate is computed with three roundings of a number of up to 2^13
/// rows, so a coordinate may land in a row that begins 2^13·3·2^-53 of a row beyond it.
inline constexpr double kRowSlack = 0x1p-30;

/// Texels; one step of the u16 output grid on [-1/2, 3/2).
inline constexpr double kOutputStep = 0x1p-15;

/// Texels; a piece is stored with a lower degree when that moves it by no more than this: an eighth of the region
/// tolerance.
inline constexpr double kDemotionTolerance = 0x1p-17;

/// Texels; a sampled point farther than this from every edge is in the right region: half a diagonal of the output grid
/// (2^-16·√2) for a control point, the same again for the f32 evaluation and the parameter stop of the sampler (DESIGN
/// §7).
inline constexpr double kRegionTolerance = 0x1p-14;

/// Steps of an 8-bit colour channel: compositing k layers rounds k·2^-51 of a step at most, so a product that is an
/// exact tie lands within this of it for any k below 2^20, and always rounds up. Of 16 bits: for any k below 2^12.
inline constexpr double kColourTie = 0x1p-30;

/// Lattice steps: accuracy of the ground truth's distances. Evaluating a Bezier of coordinates up to 2^28 in double
/// errs by 2^-23 at most.
inline constexpr double kDistanceAccuracy = 1e-6;

/// Curve parameter: a Newton step this short (two to four roundings of the parameter) has converged, being far shorter
/// than the one before; what is left moves a point by less than 3·2^29·2^-53 < 2^-22 steps, about what evaluating the
/// curve in double loses. Asking for less makes the iteration wander in its own rounding noise.
inline constexpr double kParameterStop = 0x1p-52;

/// Colour channel: a mean of a paint may be off by a quarter of a step of 8 bits (rounding it costs half a step more).
/// A paint is smooth but for kinks, where a gradient has a stop; three Gauss points a direction err there by at
/// most 3.5% of the change of slope across the cell, by 0.7% where it lies beyond the outer points. So a sixteenth of a
/// step is asked for of what the points show: how far the middle one of a line is from the mean of the others, or
/// quarters from the whole (quarters err by a quarter of what the whole does, at most).
inline constexpr double kMeanTolerance = 1.0 / (16 * 255);

/// Colour channel: by chance, or beyond the outer points, a kink may not show. The points span 0.77 of the cell; where
/// they differ by no more than this, the change of slope is at most twice this over 0.77, and 0.9% of it (3.5% over 4)
/// is less than a fifth of a step.
inline constexpr double kMeanSpan = 1.0 / 32;

/// Lattice steps: cubics of a network become quadratics that stay this close to them, 2^-22 of the extent: as strokes
/// do (kStrokeTolerance). At 256 texels that is two steps of the positions in signatures (2^-15 texel).
inline constexpr double kQuadraticTolerance = kStrokeTolerance;

/// Texels: where textures of straight segments are asked for, curves become chords this close to them. A curve's point
/// on an edge, which is what is stored, is off by as much, a sixteenth of the 1/255 that samplers may differ by; inside
/// a texel the segment between two such points replaces the curve anyway.
inline constexpr double kFeatureChord = 0x1p-12;

/// Texels: texels in which snapping moves a feature curve by more are told one by one.
inline constexpr double kFeatureMoveTold = 0.5;

/// Radians, and texels inside a texel: tangents closer than this are parallel. Angles are known to 2^-52; the point
/// where two lines meet, to that over their angle, 2^-22 of a texel.
inline constexpr double kFeatureParallel = 0x1p-30;

/// Texels: what is no farther from the input hasn't moved: half a step of positions in a texture. Rounding to the
/// lattice turns tangents by 2^-21 (a quarter of a texel, 512 of them), which moves a middle point by 2^-16 where they
/// meet at 2^-5.
inline constexpr double kFeatureMoveNoise = kOutputStep / 2;

/// Texels: a valid middle point is so far inside its texel, and thereby from the ends: a tangent taken from there is
/// known to 2^-52 over this, 2^-36.
inline constexpr double kFeatureLeastHandle = kOutputStep / 2;

/// Texels: fitted points and middle points stay so far from corners and edges. The coarsest angles, halves, are off by
/// up to 2^-10, which moves a middle point across a texel by as much; eight times that leaves room for tangents that
/// meet at small angles.
inline constexpr double kFeatureMargin = 0x1p-7;

/// Texels: a quadratic this close to its chord is written as straight where numbers of the texture can't hold it: half
/// a step of its positions.
inline constexpr double kFeatureFlat = kOutputStep / 2;

/// Fitting ends at steps of this size (texels, and of the variables that stand for them) and constraints off by as
/// much. The energy is flat around its least value: it is then known to the square of it.
inline constexpr double kFeatureFitStop = 1e-9;
inline constexpr int kFeatureFitSteps = 60;

/// Texels: a corner nearer to a curve lies on it. Coordinates up to 2^14 and a dozen operations err by 2^-36 at most,
/// so from here on the direction from the nearest point is known to 2^-8; nearer it would be rounding noise.
inline constexpr double kFeatureOnCurve = 0x1p-28;

// What follows belongs to the error measures (compiler/measure); nothing of the compiler depends on it.

/// Areas of trapezoids (planar/trapezoid_area), in epsilons of long double: De Casteljau of values up to M errs by less
/// than so many of M in either coordinate (kEvaluationError, an epsilon being two unit roundoffs).
inline constexpr int kAreaEvaluationSteps = 32;

/// Widths of the texel over which such errors count beside its height: one of y moves both ends of the integral across
/// the width (2); one of the derivative is three times as large, over a parameter range of at most 1 (3); room for the
/// sum.
inline constexpr int kAreaWidths = 8;

/// Part of a texel's area: rounding the area to double, once more when it is added up, and the bound itself.
inline constexpr double kAreaRounding = 4 * kUnitRoundoff;

/// Halvings of the stretch of about a pixel in which a picture's class changes: 2^-24 of a pixel.
inline constexpr int kBoundaryHalvings = 24;

/// Pixels: first step of the search along an edge's normal, and the largest: where the picture goes over and back
/// within less, the search may step across.
inline constexpr double kBoundaryFirstStep = 0x1p-14;
inline constexpr double kBoundaryLargestStep = 0.25;

/// Pixels: so far the search looks in eight directions. Beyond √2, two neighbouring pixels' diagonal, changes between
/// sample points show what lies off the normal.
inline constexpr double kBoundaryStarReach = 1.5;

/// Colour channel: a patch may be a step of 8 bits off its paint, as much as rounding its corners twice could make it.
inline constexpr double kPatchTolerance = 1.0 / 255;

/// Part of a region's area: the weight that ties a patch's corner to the mean. It moves a corner that the region's own
/// points determine by less than a hundredth of the spread.
inline constexpr double kPatchRidge = 0x1p-10;

/// Pixels of an image: a pixel up to so much beyond the invalidation distance may be taken for invalid: half of it for
/// lines in place of curves, the rest for roundings (2^14 pixels to 2^-39 each).
inline constexpr double kInvalidationSlack = 0x1p-9;

/// Colour channel of an image: beyond 0 and 1 by less, nothing is said of clipping: half a step of 12 bits, the finest
/// that cameras and film scans store in integers; what resampling in linear light, or their conversion to floats,
/// leaves around 0 and 1. It shows in no sample of 8 bits.
inline constexpr double kSampleOvershoot = 0x1p-13;

/// Against a squared error of 1 a texel, where texels are no smaller than pixels: what a second difference of an
/// image's corner values counts. (Smaller texels: times their number in a pixel, which makes it the same of the surface
/// in pixels; the anchor below divided by it.) A detail of two texels' wavelength, that pixel centres don't see at the
/// corners, is then left out; of four texels, 80 % are kept, and no detail comes out stronger than in the image.
inline constexpr double kImageBending = 1.0 / 32;

/// The same for a first difference: what makes values unique where bending leaves them open (a lone region).
inline constexpr double kImageStretching = 0x1p-14;

/// The same for a hole's mean to be that of the closest reachable sample: gradients go on for the fourth root of
/// kImageBending/kImageAnchor, two texels, into a hole, beyond that the sample is copied.
inline constexpr double kImageAnchor = 0x1p-9;

/// Colour channel: the fit ends when no corner would move by more in a Jacobi step (a thirtieth of a step of 8 bits;
/// divided by the texels in a pixel, as such a step is), or after so many steps; long chains of holes, whose values
/// hardly depend on each other, need some hundred.
inline constexpr double kImageFitStep = 0x1p-13;
/// The same where samples have 16 bits: a thirtieth of their step; of halves, of that below 1.
inline constexpr double kImageFitStep16 = 0x1p-21, kImageFitStepHalf = 0x1p-16;
inline constexpr int kImageFitSteps = 400;

/// Pixels: what a boundary drawn by lines from change to change is off by where it bends with a radius of a pixel or
/// more.
inline constexpr double kBoundaryChordError = 0.125;

/// Colour channel: neighbouring points of a pixel's line that differ by more are looked at for a jump between them, by
/// so many halvings (2^-8 of 1/8 of a pixel).
inline constexpr double kJump = 1.0 / 64;
inline constexpr int kJumpHalvings = 8;

/// Colour channel: a pixel whose centre differs by less from the mean of its corners is taken for linear; so is the run
/// of the means of its lines.
inline constexpr double kLinearPixel = 1.0 / 1024;

/// Colour channel, 0…1: colours that differ by less are equal. Four times the 2^-30 of a pixel to which areas of the
/// exact picture are known (1e-9); k / 255, interpolation, and box means of 2^13 terms err by less than 2^-40. A step
/// of eight bits is a million times as much.
inline constexpr double kColorNoise = 0x1p-28;

/// dB: what a difference of kColorNoise everywhere gives, 20·log10(2^28). Above it, pictures are equal.
inline constexpr double kEqualPsnr = 168.5;

/// dB: right pictures come out between 67 and 90 (measure/README.md); above it, plots say "at most".
inline constexpr double kBestPsnr = 100;

/// Squared distance of two colours, at most 4: a colour nearer by less than this is as near. Squares and sums err by
/// 2^-49; with the least contrast that counts (4/255) this is two millionths of the way from one colour to the other.
inline constexpr double kColorDistanceTie = 0x1p-30;

/// Pixels: an edge this close to a pixel counts as passing through it. Edges are off by 1e-12 of the width, 2^-26 of a
/// pixel where the width has 2^14. Pixels marked in vain cost time, nothing else.
inline constexpr double kCrossedSlack = 0x1p-20;

/// Width units: so far right of the canvas's left border the results beside it are asked for, an edge along the border
/// itself being none. A sixteenth of a lattice step or less, and a thousand times what ends of edges on the border are
/// off by.
inline constexpr double kBorderInset = 0x1p-30;

/// Texels and a cosine: a point is away from medial axes, ends and corners of feature curves if its texel's corners are
/// as far from the curves, to the first, as from the tangent at the nearest point, and in its direction, to the second
/// (a curve of a radius of five texels bends away by a tenth within one): there distances are as good as linear, which
/// is what a texture can hold of them.
inline constexpr double kFeaturePlain = 0.1, kFeatureSameWay = 0.9;

/// Share of a texel, of a bitmap of up to 2^14 texels a side: what eight edges' roundings leave of a result that they
/// cover and uncover. Forgetting it moves a colour by 2^-22 of a step of eight bits.
inline constexpr double kShareNoise = 8 * 0x1p14 * kEvaluationError;

/// Part of the side, to which `bench` finds the bitmap of equal error: from size to size, errors of bitmaps go up and
/// down by about as much (1/√400: of 512² points, a few hundred are on the wrong side).
inline constexpr double kEqualErrorPrecision = 0.05;

/// Texels: a bi-level texture's outline is cut into chords that miss it by at most this: 1/16 of the least wrong area
/// that a texture of 8 bits can have along an edge (half a step, 1/510 of the two texels over which values change).
inline constexpr double kOutlineChord = 0x1p-12;

/// Radians between two pieces of an outline: more is a corner. Chords of a round edge turn by less: within
/// kOutlineChord a circle of half a texel, the roundest that a texture can hold, takes chords of 0.13.
inline constexpr double kCornerTurn = 0.15;

/// Of an outline that comes from pixels, whose single pieces say little: radians between its directions over so many
/// texels, and at least so many pixels, before and behind a point. A circle of 0.7 texels turns by as much.
inline constexpr double kCornerTurnOfPixels = 0.5;
inline constexpr double kCornerWindow = 0.35;
inline constexpr double kCornerPixels = 3;

/// Square texels: two segments that share a point are equally far from what is nearest to the point.
inline constexpr double kSameDistance = 1e-12;

/// Texels from the outline to where the values of a fit's start reach 0 and 1, of one channel and of several. Of 1, 1.5
/// and 2 those that left the least wrong area on six shapes (compiler/bilevel/README.md).
inline constexpr double kSeedReach = 1.5;
inline constexpr double kSeedReachOfSeveral = 1;

/// Texels: how far from its segments a channel's values still follow them.
inline constexpr double kSeedSearch = 2;

/// Ceres' trust region, and the relative change of the cost at which a fit ends.
inline constexpr double kFitTrustRadius = 100;
inline constexpr double kFitTolerance = 1e-4;

/// Ceres' damping of a value counts at least so much as its own weight; a value that the outline crosses beside has
/// some units of it. Of 0.1 to 0.5 and radii of 3 to 1000 what left the least wrong area on six shapes.
inline constexpr double kFitLeastDiagonal = 0.5;

/// Texels: distances of contours up to this count by their squares, larger ones by themselves (Huber's loss).
inline constexpr double kFitExactTo = 0.01;

/// Per texel: contours where values change less are moved as if they changed so much.
inline constexpr double kFitLeastSlope = 0.1;

/// Of a crossing on a line with several in one cell, where one value can't be right for all.
inline constexpr double kFitCrowdedWeight = 0.3;

/// The paper's system: part of a position's weight that is left halfway between level and upright, and the weight of
/// the gradient's length, so that the values have a scale.
inline constexpr double kFitPositionFloor = 0.05;
inline constexpr double kFitSteepness = 0.1;
inline constexpr int kFitPaperSteps = 2;

/// Square texels: what a step of a byte must win, far above roundings of single precision sums of 32 lines.
inline constexpr double kWorthAByte = 1e-7;

/// Square texels of wrong area that it is worth to show a part of the silhouette that wouldn't show at all, or not to
/// show one that it hasn't: a quarter of a texel's side each way, about the spot that one byte makes.
inline constexpr double kWorthAPart = 1.0 / 16;

/// Parts of a pixel: nine pixels that a straight edge covers otherwise than they say, by more in the root mean square,
/// hold a corner or several edges. A corner of a right angle in the middle misfits by 0.1 or more; roundings of 8 bits
/// by 0.002, an edge round with a radius of five pixels by 0.02.
inline constexpr double kEdgeLineMisfit = 0.04;

/// Radians and pixels over which an edge's coverages are differentiated, and the part of its diagonal product below
/// which a normal matrix says nothing. Decides nothing else: a step that doesn't fit better isn't taken.
inline constexpr double kEdgeLineDifference = 0x1p-20;

/// Steps of a silhouette map's points: edges are cut into chords that miss them by at most this. Rounding a point
/// leaves a quarter of a step on average, eight times as much.
inline constexpr double kSilmapChord = 1.0 / 32;

/// Square texels: what a move of a silhouette map's point must win. Far above roundings (2^-45 of a cell), and 2^-16 of
/// what a step of the finest points, 2^-7, sweeps along an edge across the cell.
inline constexpr double kSilmapWorthAMove = 0x1p-23;

/// Square texels: less wrong area in a cell that holds too much isn't reported: what a point of 8 bits that is half a
/// step off leaves beside an edge across the cell.
inline constexpr double kSilmapCrowded = 1.0 / 16;

/// Square texels: smaller parts of the picture may get lost without a word.
inline constexpr double kSilmapLostPart = 1.0 / 16;

/// Square cells, of silhouette maps: settling looks at cells around which more is wrong, again where it won so much,
/// and at those around where it won more still. What these and the next three cost and win was measured on the tiger
/// (compiler/silmap/README.md); nothing of them decides what is reported.
inline constexpr double kSilmapSettle = 0.1, kSilmapSettleAgain = 0.01, kSilmapSettleAround = 0.03;
/// Part of all wrong area: a cell that has more, with its neighbours, has all its places tried, so that what one move
/// can still win stays well below a hundredth of the whole.
inline constexpr double kSilmapHeavy = 1.0 / 256;
/// Square texels: wrong around a texel before it may take another region's colour, twice what a crowded cell may have;
/// what it must win; and the area of a region in a cell for it to be tried.
inline constexpr double kSilmapLend = 0.125, kSilmapLent = 1.0 / 64, kSilmapLendPart = 1.0 / 32;

/// Part of the canvas on the wrong side of an edge that sizes of their own choice may have, where none is asked for:
/// one pixel in a thousand.
inline constexpr double kSilmapChosenError = 1e-3, kPinchmapChosenError = 1e-3;

/// Part of the width of what is done near feature curves: so far they may be from where they belong in textures whose
/// size is chosen, where no distance is asked for. Moved by a quarter, a profile still covers three quarters of where
/// it belongs on either side.
inline constexpr double kFeatureChosenMove = 0.25;

/// Clusters of a pinchmap: a corner farther than this on the wrong side counts no more, for gamma moves a discontinuity
/// by less than a cluster, and it lies half of one from its clusters' middles.
inline constexpr double kPinchmapFarWrong = 1.5;
/// Square clusters: what a cross costs that the drawing hasn't, for it blurs a cluster of two colours, half of it
/// wrongly; what a move of the zones must win, less than shows; and what must be unmendable for a search to pay: as
/// much.
inline constexpr double kPinchmapCross = 0.5, kPinchmapWorthAMove = 0.1, kPinchmapMuch = kPinchmapWorthAMove;
/// Square clusters that lying in a zone costs a corner: a search goes on around those that cost more than the first, a
/// fifth of what a move must win; one with no side as dear as the second, nearly kPinchmapFarWrong, may be on either.
inline constexpr double kPinchmapDear = kPinchmapWorthAMove / 5, kPinchmapOpen = 1.2;
/// Part of what a corner's dearer side costs if its texel is active and needn't be: less than kPinchmapDear of
/// kPinchmapFarWrong, so that it only decides between zones that cost the same.
inline constexpr double kPinchmapIdle = 0.002;
/// Square clusters wrong around 2 x 2 texels: less isn't worth a round of the search for gamma, a hundredth of a
/// move's.
inline constexpr double kPinchmapWorthARound = kPinchmapWorthAMove / 100;
/// Square clusters of wrong area around an active texel: up to here it stays sharp, from there on its strength is 0, as
/// a cross's is.
inline constexpr double kPinchmapSharpTo = 0.3, kPinchmapSoftFrom = kPinchmapCross;
/// k − gamma on the wrong side: more is no discontinuity beside its place (a zone's side is 1 from it) but a part that
/// the map hasn't.
inline constexpr double kPinchmapFarInside = 0.75;
/// |k − gamma| of a point on a discontinuity: both are sums of numbers up to 2, each rounded to 2^-53; a sampler that
/// adds them in another order has it on the other side. A thousand times that.
inline constexpr double kPinchmapOnTheLine = 1e-12;

/// Weights in the fit of a pinchmap's signal, of the mean weight of a sample. Neighbours on one side are drawn together
/// by so much: a sample that points tell anything about moves by less than a step of 16 bits, 2^-16, and one that
/// hardly any do, where strengths taper, doesn't swing beyond its neighbours. A sample with less than the second isn't
/// told anything.
inline constexpr double kSignalTogether = 1e-5, kSignalUnseen = 1e-6;
/// Colours times the mean weight: the largest residual at which the fit ends, a 150th of a step of 16 bits.
inline constexpr double kSignalResidual = 1e-7;
/// Of a pixel that mixes two sides, where no other tells a sample's colour: ten times what draws neighbours
/// together, a ten thousandth of a pixel that doesn't mix.
inline constexpr double kSignalMixed = 1e-4;
/// Of a point on the wrong side of a discontinuity: all of them, at most a tenth of a sample's, move it by less than a
/// step of 8 bits for each quarter of the colours' range that the sides differ by; but what is read beyond an edge that
/// the drawing hasn't looks like the drawing.
inline constexpr double kSignalWrong = 1e-2;
/// Of the mean weight of a sample: one that has less is read by parts of at most 0.45 = sqrt(0.2), about, so that it
/// would move by more than twice what its neighbours are wrong by.
inline constexpr double kSignalFew = 0.2;

/// Of the fit of feature curves, relative to the largest entry of a step's matrix: what is added where it isn't
/// positive definite, half the digits of a double.
inline constexpr double kFeatureFitShift = 1e-8;
/// Relative to a constraint's derivatives: constraints that depend on each other, or can't be met, don't end the step.
/// Some hundred roundings; refinements take out what it leaves.
inline constexpr double kFeatureFitSlack = 1e-13;
/// Relative: merits closer than some roundings are the same.
inline constexpr double kFeatureFitRounding = 1e-14;
/// Texels, and energy a texel: a variable is beyond a bound, or pulls away from one that holds it, if by more than the
/// step's solution is rounded by (2^-53 times the condition that kFeatureFitShift and scaling leave, some 10^3).
inline constexpr double kFeatureFitBound = 1e-12;

/// Squared texels: rounding makes no distance of a feature curve so much smaller, coordinates being below 2^14 and
/// distances below 2^16 (some products of 2^32, each rounded to 2^-53 of it).
inline constexpr double kFeatureDistanceRounding = 0x1p-18;

/// Of a plot's labels: a place is better if its cost is less by more than sums of some hundred costs, each below 10^4,
/// are rounded to.
inline constexpr double kLabelWorth = 1e-9;

/// Square clusters: a search for zones keeps what costs less by more than sums of its steps' differences round to (some
/// 10^6 steps of 2^-53).
inline constexpr double kPinchmapCostRounding = 1e-9;

} // namespace fetexc::budget
