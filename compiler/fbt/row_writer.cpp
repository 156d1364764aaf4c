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
    prepare(texel, features);
    count_slivers();
    // Everything collapsed. Where the collapsed sliver held the corner, the representative sample isn't the texel's
    // own: a lone terminator then carries it.
    if (bands_.size() == 1 && bands_[0].features == 0 && bands_[0].rest == features.corner_region) {
        return write_empty(representative, samples_[bands_[0].rest]);
    }
    for (const RegionSample& s : samples_)
        note_sample(s);
    ++(samples_.size() == 2 ? out_.stats.texels_two_regions : out_.stats.texels_more_regions);
    out_.texels.push_back(representative);
    if (bands_.size() == 1) {
        out_.texels.push_back((kFbtKindSingle << 30) | write_band(bands_[0]));
        return;
    }
    out_.traits.bands = true;
    out_.traits.max_bands = std::max(out_.traits.max_bands, static_cast<std::uint32_t>(bands_.size()));
    ++out_.stats.texels_banded;
    out_.stats.bands += bands_.size();
    directory_ = {static_cast<std::uint32_t>(bands_.size()), 0};
    for (const ReadyBand& b : bands_) {
        directory_.push_back(b.y_end);
        directory_.push_back(write_band(b));
    }
    const std::uint32_t address = next_record();
    for (std::size_t k = 0; k < bands_.size(); ++k)
        out_.relocate.push_back(static_cast<std::uint32_t>(out_.records.size() + 3 + 2 * k));
    out_.records.insert(out_.records.end(), directory_.begin(), directory_.end());
    out_.records.resize((out_.records.size() + 3) / 4 * 4, 0);
    out_.texels.push_back((kFbtKindBanded << 30) | address);
}

bool RowWriter::same_runs(const ReadyFeature& a, const ReadyFeature& b) const {
    return std::ranges::equal(runs_of(a), runs_of(b), [&](const Run& x, const Run& y) {
        return x.degree == y.degree && std::ranges::equal(runs_.pieces_of(x), runs_.pieces_of(y));
    });
}

/// The same pieces under the same ray as an earlier feature: what lies inside is taken by that one.
bool RowWriter::shadowed(const ReadyBand& band, const ReadyFeature& feature) const {
    return std::ranges::any_of(features_of(band),
                               [&](const ReadyFeature& f) { return f.ray == feature.ray && same_runs(f, feature); });
}

/// Slivers: regions thinner than the output grid, of which no band has anything left.
void RowWriter::count_slivers() {
    left_.assign(samples_.size(), false);
    for (const ReadyBand& b : bands_) {
        left_[b.rest] = true;
        for (const ReadyFeature& f : features_of(b))
            left_[f.region] = true;
    }
    for (std::uint32_t r = 0; r < left_.size(); ++r) {
        if (left_[r]) continue;
        ++out_.stats.slivers_collapsed;
        out_.collapsed.push_back(first_vertex_ + r);
    }
}

/// Quantised bands: those without height go, and so do features whose pieces all vanished or fell on each other or on
/// those of another feature.
void RowWriter::prepare(const TexelMap& texel, const TexelFeatures& features) {
    const Grid& g = map_.grid();
    bands_.clear(), features_.clear(), runs_.clear();
    std::uint32_t previous = fbt_quantise(0);
    PieceStats pieces;
    for (const Band& band : features.bands) {
        const bool last = &band == &features.bands.back();
        const double y1 = (band.y1 - static_cast<double>(g.py * texel.j)) / static_cast<double>(g.py);
        const std::uint32_t y_end = last ? fbt_quantise(1) : std::min(fbt_quantise(y1), fbt_quantise(1));
        if (y_end <= previous) continue;
        const auto regions = features.regions_of(band);
        ReadyBand b{y_end, static_cast<std::uint32_t>(features_.size()), 0, regions.back()};
        for (std::size_t k = 0; k < band.features; ++k) {
            const SimpleFeature& f = features.features_of(band)[k];
            const std::size_t first = runs_.runs.size();
            make_runs(map_, texel, features.steps_of(f), runs_, pieces);
            const ReadyFeature ready{static_cast<std::uint32_t>(first),
                                     static_cast<std::uint32_t>(runs_.runs.size() - first), f.ray, regions[k]};
            if (cancel_out(runs_, first) || shadowed(b, ready)) {
                runs_.truncate(first);
            } else {
                features_.push_back(ready);
                ++b.features;
            }
        }
        previous = y_end;
        bands_.push_back(b);
    }
    if (bands_.back().y_end != fbt_quantise(1)) bands_.back().y_end = fbt_quantise(1); // the last band had no height
    out_.stats.pieces_demoted += pieces.demoted;
}

std::uint32_t RowWriter::write_band(const ReadyBand& band) {
    addresses_.clear();
    for (const ReadyFeature& f : features_of(band)) {
        for (const Run& run : runs_of(f))
            addresses_.push_back(write_pieces(run));
    }
    const std::uint32_t first = next_record();
    std::size_t k = 0;
    for (const ReadyFeature& f : features_of(band)) {
        ++out_.stats.features;
        out_.traits.directions |= 1u << f.ray;
        for (const Run& run : runs_of(f)) {
            const bool last = &run == &runs_of(f).back();
            const auto degree = static_cast<std::uint32_t>(run.degree);
            out_.traits.degrees |= 1u << degree;
            out_.traits.max_degree = std::max(out_.traits.max_degree, degree);
            write_entry(addresses_[k++], run.pieces | (degree << 16) | (f.ray << 18) | (last ? kFbtEntryLastRun : 0),
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
    words_.clear();
    for (const Piece& p : runs_.pieces_of(run)) {
        if (run.degree == 1) {
            if (words_.empty()) words_.push_back(p.p[0]);
            words_.push_back(p.p[1]);
        } else {
            for (int i = 0; i < 4; ++i)
                words_.push_back(i <= run.degree ? p.p[i] : 0);
        }
    }
    words_.resize((words_.size() + 3) / 4 * 4, 0);
    const std::uint32_t record = next_record();
    if (const std::optional<std::uint32_t> equal = written_.find_or_add(words_, record, out_.records)) {
        ++out_.stats.runs_shared;
        return *equal;
    }
    out_.stats.pieces += run.pieces;
    out_.records.insert(out_.records.end(), words_.begin(), words_.end());
    return record;
}

void WrittenRuns::clear() {
    if (entries_.empty()) return;
    entries_.clear();
    slots_.assign(16, 0);
}

void WrittenRuns::grow() {
    slots_.assign(std::max<std::size_t>(16, 2 * slots_.size()), 0);
    for (std::uint32_t e = 0; e < entries_.size(); ++e) {
        std::size_t slot = entries_[e].hash & (slots_.size() - 1);
        while (slots_[slot] != 0)
            slot = (slot + 1) & (slots_.size() - 1);
        slots_[slot] = e + 1;
    }
}

std::optional<std::uint32_t> WrittenRuns::find_or_add(std::span<const std::uint32_t> words, std::uint32_t record,
                                                      const std::vector<std::uint32_t>& records) {
    if (2 * (entries_.size() + 1) > slots_.size()) grow();
    std::uint64_t hash = 0x9e3779b97f4a7c15u;
    for (const std::uint32_t w : words) {
        hash = (hash ^ w) * 0xff51afd7ed558ccdu;
        hash ^= hash >> 32;
    }
    std::size_t slot = hash & (slots_.size() - 1);
    for (; slots_[slot] != 0; slot = (slot + 1) & (slots_.size() - 1)) {
        const Entry& e = entries_[slots_[slot] - 1];
        if (e.hash != hash || e.words != words.size()) continue;
        if (std::ranges::equal(words, std::span(records).subspan(std::size_t{4} * e.record, e.words))) return e.record;
    }
    entries_.push_back({hash, record, words.size()});
    slots_[slot] = static_cast<std::uint32_t>(entries_.size());
    return {};
}

} // namespace fetexc
