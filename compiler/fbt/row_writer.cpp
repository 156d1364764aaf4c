// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/fbt/row_writer.h"

#include <algorithm>

namespace fetexc {

using namespace fetex;

void RowWriter::note_sample(const RegionSample& s) {
    out_.traits.translucent = out_.traits.translucent || (s.rgba >> 24) != 255;
    out_.traits.interpolated = out_.traits.interpolated || s.mask != 0;
    ++out_.stats.regions;
    if (s.mask != 0) ++out_.stats.regions_interpolated;
}

void RowWriter::write_empty(std::uint32_t representative, const RegionSample& sample) {
    note_sample(sample);
    ++out_.stats.texels_empty;
    out_.texels.push_back(representative);
    out_.texels.push_back((kFbtKindEmpty << 30) | sample.mask);
}

void RowWriter::write_texel(std::uint32_t representative, const TexelMap& texel, const TexelFeatures& features,
                            std::uint32_t first_vertex) {
    first_vertex_ = first_vertex;
    samples_.clear();
    written_.clear();
    results_ = features.region_result;
    for (std::uint32_t r = 0; r < features.region_result.size(); ++r)
        samples_.push_back(sampler_.region(texel, features, r));
    const std::vector<ReadyBand> bands = prepare(texel, features);
    count_slivers(bands);
    // Everything collapsed. Where the collapsed sliver held the corner, the representative sample isn't the texel's
    // own: a lone terminator then carries it.
    if (bands.size() == 1 && bands[0].features.empty() && bands[0].rest == features.corner_region) {
        return write_empty(representative, samples_[bands[0].rest]);
    }
    for (const RegionSample& s : samples_)
        note_sample(s);
    ++(samples_.size() == 2 ? out_.stats.texels_two_regions : out_.stats.texels_more_regions);
    out_.texels.push_back(representative);
    if (bands.size() == 1) {
        out_.texels.push_back((kFbtKindSingle << 30) | write_band(bands[0]));
        return;
    }
    out_.traits.bands = true;
    out_.traits.max_bands = std::max(out_.traits.max_bands, static_cast<std::uint32_t>(bands.size()));
    ++out_.stats.texels_banded;
    out_.stats.bands += bands.size();
    std::vector<std::uint32_t> directory{static_cast<std::uint32_t>(bands.size()), 0};
    for (const ReadyBand& b : bands) {
        directory.push_back(b.y_end);
        directory.push_back(write_band(b));
    }
    const std::uint32_t address = next_record();
    for (std::size_t k = 0; k < bands.size(); ++k)
        out_.relocate.push_back(static_cast<std::uint32_t>(out_.records.size() + 3 + 2 * k));
    out_.records.insert(out_.records.end(), directory.begin(), directory.end());
    out_.records.resize((out_.records.size() + 3) / 4 * 4, 0);
    out_.texels.push_back((kFbtKindBanded << 30) | address);
}

/// The same pieces under the same ray as an earlier feature: what lies inside is taken by that one.
bool RowWriter::shadowed(const std::vector<ReadyFeature>& before, const std::vector<Run>& runs, std::uint32_t ray) {
    return std::any_of(before.begin(), before.end(),
                       [&](const ReadyFeature& f) { return f.ray == ray && f.runs == runs; });
}

/// Slivers: regions thinner than the output grid, of which no band has anything left.
void RowWriter::count_slivers(const std::vector<ReadyBand>& bands) {
    std::vector<bool> left(samples_.size(), false);
    for (const ReadyBand& b : bands) {
        left[b.rest] = true;
        for (const ReadyFeature& f : b.features)
            left[f.region] = true;
    }
    for (std::uint32_t r = 0; r < left.size(); ++r) {
        if (left[r]) continue;
        ++out_.stats.slivers_collapsed;
        out_.collapsed.push_back(first_vertex_ + r);
    }
}

/// Quantised bands: those without height go, and so do features whose pieces all vanished or fell on each other or on
/// those of another feature.
std::vector<RowWriter::ReadyBand> RowWriter::prepare(const TexelMap& texel, const TexelFeatures& features) {
    const Grid& g = map_.grid();
    std::vector<ReadyBand> ready;
    std::uint32_t previous = fbt_quantise(0);
    PieceStats pieces;
    for (const Band& band : features.bands) {
        const bool last = &band == &features.bands.back();
        const double y1 = (band.y1 - static_cast<double>(g.py * texel.j)) / static_cast<double>(g.py);
        const std::uint32_t y_end = last ? fbt_quantise(1) : std::min(fbt_quantise(y1), fbt_quantise(1));
        if (y_end <= previous) continue;
        ReadyBand b;
        b.y_end = y_end, b.rest = band.regions.back();
        for (std::size_t k = 0; k < band.features.size(); ++k) {
            std::vector<Run> runs = make_runs(map_, texel, band.features[k].steps, pieces);
            if (!cancel_out(runs) && !shadowed(b.features, runs, band.features[k].ray))
                b.features.push_back({std::move(runs), band.features[k].ray, band.regions[k]});
        }
        previous = y_end;
        ready.push_back(std::move(b));
    }
    if (ready.back().y_end != fbt_quantise(1)) ready.back().y_end = fbt_quantise(1); // the last band had no height
    out_.stats.pieces_demoted += pieces.demoted;
    return ready;
}

std::uint32_t RowWriter::write_band(const ReadyBand& band) {
    std::vector<std::uint32_t> addresses;
    for (const ReadyFeature& f : band.features) {
        for (const Run& run : f.runs)
            addresses.push_back(write_pieces(run));
    }
    const std::uint32_t first = next_record();
    std::size_t k = 0;
    for (const ReadyFeature& f : band.features) {
        ++out_.stats.features;
        out_.traits.directions |= 1u << f.ray;
        for (const Run& run : f.runs) {
            const bool last = &run == &f.runs.back();
            const auto degree = static_cast<std::uint32_t>(run.degree);
            out_.traits.degrees |= 1u << degree;
            out_.traits.max_degree = std::max(out_.traits.max_degree, degree);
            write_entry(addresses[k++],
                        static_cast<std::uint32_t>(run.pieces.size()) | (degree << 16) | (f.ray << 18) |
                            (last ? kFbtEntryLastRun : 0),
                        f.region, last);
        }
    }
    write_entry(0, kFbtEntryTerminator, band.rest, true);
    out_.traits.max_entries = std::max(out_.traits.max_entries, next_record() - first);
    return first;
}

void RowWriter::write_entry(std::uint32_t address, std::uint32_t word1, std::uint32_t region, bool last) {
    if ((word1 & kFbtEntryTerminator) == 0) out_.relocate.push_back(static_cast<std::uint32_t>(out_.records.size()));
    if (last) out_.entries.push_back({next_record(), results_[region], first_vertex_ + region});
    const RegionSample s = last ? samples_[region] : RegionSample{};
    out_.records.insert(out_.records.end(), {address, word1, s.rgba, s.mask});
}

/// Piece records of a run; a run that this texel has already (in another band) is shared.
std::uint32_t RowWriter::write_pieces(const Run& run) {
    std::vector<std::uint32_t> words;
    for (const Piece& p : run.pieces) {
        if (run.degree == 1) {
            if (words.empty()) words.push_back(p.p[0]);
            words.push_back(p.p[1]);
        } else {
            for (int i = 0; i < 4; ++i)
                words.push_back(i <= run.degree ? p.p[i] : 0);
        }
    }
    words.resize((words.size() + 3) / 4 * 4, 0);
    const auto [it, fresh] = written_.try_emplace(words, next_record());
    if (fresh) {
        out_.stats.pieces += run.pieces.size();
        out_.records.insert(out_.records.end(), words.begin(), words.end());
    } else {
        ++out_.stats.runs_shared;
    }
    return it->second;
}

} // namespace fetexc
