// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/feature_curves/lattice_lines.h"

#include <algorithm>
#include <utility>

#include "compiler/error_budget.h"
#include "compiler/flat_index.h"
#include "compiler/network/simplify.h"
#include "compiler/scene/guard_box.h"
#include "compiler/scene/lattice.h"
#include "compiler/scene/vertex_merge.h"

namespace fetexc {
namespace {

/// Between numbered points of a VertexMerge.
struct Line {
    std::uint32_t a = 0, b = 0;
    std::uint8_t profile = 0;
};

std::vector<Line> add_lines(const Network& chords, const Extent& extent, const TextureProfiles* profiles,
                            VertexMerge& merge) {
    std::vector<Line> lines;
    std::vector<CanvasSegment> inside;
    const LatticeScale scale = lattice_scale(extent);
    const GuardBox box = guard_box(extent);
    for (const NetworkCurve& curve : chords.curves) {
        inside.clear();
        for (const CanvasSegment& s : curve.segments) {
            const CanvasSegment line = to_lattice_space(s, scale);
            if (hull_inside(line, box))
                inside.push_back(line);
            else
                clip_to_guard_box(line, box, inside);
        }
        const std::uint8_t profile = profiles != nullptr ? profiles->number_of(curve) : std::uint8_t{0};
        for (const CanvasSegment& s : inside)
            lines.push_back({merge.add(snap(s.p[0])), merge.add(snap(s.p[1])), profile});
    }
    return lines;
}

struct PairHash {
    std::size_t operator()(std::uint64_t packed) const { return static_cast<std::size_t>(mixed_bits(packed)); }
};

/// Fills vertices and lines from merged points.
void take_leaders(const std::vector<Line>& lines, const VertexMerge& merge, LatticeLines& out) {
    std::vector<std::uint32_t> number;
    const auto vertex = [&](std::uint32_t point) {
        const std::uint32_t leader = merge.leader(point);
        if (number.size() <= leader) number.resize(leader + 1, kNone);
        if (number[leader] == kNone) {
            number[leader] = static_cast<std::uint32_t>(out.vertices.size());
            out.vertices.push_back(merge.at(leader));
        }
        return number[leader];
    };
    FlatIndex<std::uint64_t, PairHash> known(lines.size());
    for (const Line& line : lines) {
        const std::uint32_t a = vertex(line.a), b = vertex(line.b);
        if (a == b) continue;
        const auto [low, high] = std::minmax(a, b);
        const auto [first, is_new] =
            known.try_emplace(std::uint64_t{low} << 32 | high, static_cast<std::uint32_t>(out.lines.size()));
        if (is_new)
            out.lines.push_back({a, b}), out.profiles.push_back(line.profile);
        else
            out.overlaid += out.profiles[first] != line.profile;
    }
}

} // namespace

Result<LatticeLines> lattice_lines(const Network& network, std::uint32_t width, std::uint32_t height,
                                   const TextureProfiles* profiles) {
    const Result<Extent> extent = make_extent(network.width, network.height);
    if (!extent) return extent.error();
    const double texel = std::min(network.width / width, network.height / height);
    const Result<Network> chords = to_lines(network, budget::kFeatureChord * texel);
    if (!chords) return chords.error();
    LatticeLines out{extent.value(), {}, {}, {}};
    VertexMerge merge(segment_count(chords.value()) + 1);
    const std::vector<Line> lines = add_lines(chords.value(), out.extent, profiles, merge);
    merge.run();
    take_leaders(lines, merge, out);
    return out;
}

} // namespace fetexc
