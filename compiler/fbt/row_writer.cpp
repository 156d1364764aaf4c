// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/fbt/row_writer.h"

#include <algorithm>

namespace fetexc {

using namespace fetex;

namespace {

constexpr std::uint32_t kAlpha = 0xff000000u;

} // namespace

void RowWriter::note_sample(const RegionSample& s) {
    out_.traits.translucent |= s.model == kFbtModelSolid && s.rgba < kAlpha;
    out_.traits.corners |= s.model == kFbtModelCorners;
}

void RowWriter::count_region(const RegionSample& s) {
    ++out_.stats.regions;
    if (s.model != kFbtModelSolid) ++out_.stats.regions_interpolated;
}

void RowWriter::write_whole(const RegionSample& sample) {
    note_sample(sample);
    count_region(sample);
    ++out_.stats.texels_empty;
    const std::uint32_t c = sample.rgba;
    std::uint32_t word = 0;
    if (sample.model == kFbtModelSolid && c >= kAlpha) {
        word = (c & 0xffffffu) | kFbtOpaque;
    } else if (sample.model == kFbtModelCorners) {
        word = (kFbtKindShaded << 30) | (kFbtModelCorners << 28);
    } else if (sample.model == kFbtModelPatch || c != 0) {
        word = (kFbtKindShaded << 30) | (kFbtModelPatch << 28) | write_patch(sample);
    }
    out_.texels.push_back(word);
}

void RowWriter::write_texel(const TexelMap& texel, const TexelFeatures& features, std::uint32_t first_vertex) {
    first_vertex_ = first_vertex;
    samples_.clear();
    written_.clear();
    results_ = features.region_result;
    for (std::uint32_t r = 0; r < features.region_result.size(); ++r)
        samples_.push_back(sampler_.region(texel, features, r));
    prepare(texel, features);
    count_slivers();
    // Everything collapsed. Where the collapsed sliver held the corner, a lone rest stands for the region.
    if (bands_.size() == 1 && bands_[0].features == 0 && bands_[0].rest == features.corner_region)
        return write_whole(samples_[bands_[0].rest]);
    ready_samples();
    for (const RegionSample& s : samples_)
        count_region(s);
    ++(samples_.size() == 2 ? out_.stats.texels_two_regions : out_.stats.texels_more_regions);
    lists_.clear();
    for (const ReadyBand& b : bands_)
        lists_.push_back(write_band(b));
    if (bands_.size() == 1) {
        out_.texels.push_back((kFbtKindSingle << 30) | lists_[0]);
    } else {
        out_.texels.push_back((kFbtKindBanded << 30) | next_record());
        write_directory();
    }
}

void RowWriter::write_directory() {
    const auto n = static_cast<std::uint32_t>(bands_.size());
    out_.traits.bands = true;
    out_.traits.max_bands = std::max(out_.traits.max_bands, n);
    ++out_.stats.texels_banded;
    out_.stats.bands += n;
    out_.records.push_back(n);
    for (std::uint32_t k = 0; k < n; k += 2)
        out_.records.push_back(bands_[k].y_end | (k + 1 < n ? bands_[k + 1].y_end << 16 : 0));
    for (const std::uint32_t list : lists_) {
        out_.record_indices.push_back(next_word());
        out_.records.push_back(list);
    }
    end_record();
}

std::uint32_t RowWriter::write_patch(const RegionSample& sample) {
    const std::uint32_t words = fbt_sample_words(format_);
    const auto patch = std::span(sample.patch).first(std::size_t{4} * words);
    out_.traits.patches = true;
    for (std::size_t k = 0; k < patch.size(); k += words)
        out_.traits.translucent |= !fbt_sample_opaque(patch.data() + k, format_);
    const std::uint32_t at = next_word();
    if (const std::optional<std::uint32_t> equal = patches_.find_or_add(patch, at, out_.records)) return *equal / 4;
    out_.records.insert(out_.records.end(), patch.begin(), patch.end());
    return at / 4;
}

/// In the order in which the bands name the regions, which does not depend on how faces were numbered.
void RowWriter::ready_samples() {
    ready_.assign(samples_.size(), {});
    is_ready_.assign(samples_.size(), false);
    for (const ReadyBand& b : bands_) {
        for (const ReadyFeature& f : features_of(b))
            ready_sample(f.region);
        ready_sample(b.rest);
    }
}

void RowWriter::ready_sample(std::uint32_t region) {
    if (is_ready_[region]) return;
    is_ready_[region] = true;
    const RegionSample& s = samples_[region];
    note_sample(s);
    ready_[region] = {s.model, s.model == kFbtModelPatch ? write_patch(s) : s.rgba};
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
                                     static_cast<std::uint32_t>(runs_.runs.size() - first), f.ray, regions[k], f.depth};
            if (cancel_out(runs_, first) || shadowed(b, ready)) {
                runs_.truncate(first);
                lift_subtree(b, f.depth);
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

/// What lay inside a feature that goes, at the end of the band so far, lies inside the one around that now.
void RowWriter::lift_subtree(const ReadyBand& band, std::uint32_t depth) {
    for (std::size_t k = features_.size(); k > band.first_feature && features_[k - 1].depth > depth; --k)
        --features_[k - 1].depth;
}

std::uint32_t RowWriter::write_band(const ReadyBand& band) {
    const std::uint32_t first = next_record();
    std::uint32_t entry = first, entries = 0;
    for (const ReadyFeature& f : features_of(band)) {
        ++out_.stats.features;
        out_.traits.directions |= 1u << f.ray;
        const std::uint32_t depth = std::min(f.depth, kFbtMaxDepth);
        out_.traits.max_depth = std::max(out_.traits.max_depth, depth);
        for (const Run& run : runs_of(f)) {
            end_record();
            entry = next_record();
            ++entries;
            const bool last_run = &run == &runs_of(f).back();
            const bool last = last_run && &f == &features_of(band).back();
            const auto degree = static_cast<std::uint32_t>(run.degree);
            out_.traits.degrees |= 1u << degree;
            out_.traits.max_degree = std::max(out_.traits.max_degree, degree);
            write_run(run,
                      run.pieces | (degree << 10) | (f.ray << 12) | (last_run ? kFbtEntryLastRun : 0) |
                          (last ? kFbtEntryLast : 0) | (depth << kFbtDepthShift),
                      f.region, last_run);
        }
    }
    if (entries == 0) {
        for (const std::uint32_t word : {kFbtEntryLastRun | kFbtEntryLast, 0u, 0u})
            out_.records.push_back(word);
        entries = 1;
    }
    write_rest(entry, band.rest);
    out_.traits.max_entries = std::max(out_.traits.max_entries, entries);
    return first;
}

void RowWriter::note_region(std::uint32_t entry, bool rest, std::uint32_t region) {
    out_.entries.push_back({entry, rest, results_[region], first_vertex_ + region});
}

void RowWriter::write_rest(std::uint32_t entry, std::uint32_t region) {
    const ReadySample s = ready_[region];
    out_.records[std::size_t{4} * entry] |= s.model << 18;
    if (s.model == kFbtModelPatch) out_.record_indices.push_back(next_word());
    out_.records.push_back(s.word);
    end_record();
    note_region(entry, true, region);
}

/// A run whose points this texel has already (in another band) refers to them, where that is shorter.
void RowWriter::write_run(const Run& run, std::uint32_t word0, std::uint32_t region, bool last_run) {
    const ReadySample s = last_run ? ready_[region] : ReadySample{};
    const std::uint32_t entry = next_record();
    words_.clear();
    for (const Piece& p : runs_.pieces_of(run)) {
        if (words_.empty()) words_.push_back(p.p[0]);
        words_.insert(words_.end(), p.p.begin() + 1, p.p.begin() + 1 + run.degree);
    }
    word0 |= s.model << 16;
    const FbtEntry own(word0), other(word0 | kFbtEntryShared);
    const bool shorter = other.records() < own.records();
    const std::uint32_t equal =
        shorter ? written_.find_or_add(words_, next_word() + 2, out_.records).value_or(kNone) : kNone;
    out_.records.push_back(equal != kNone ? word0 | kFbtEntryShared : word0);
    if (s.model == kFbtModelPatch) out_.record_indices.push_back(next_word());
    out_.records.push_back(s.word);
    if (equal != kNone) {
        ++out_.stats.runs_shared;
        out_.traits.shared = true;
        out_.word_indices.push_back(next_word());
        out_.records.push_back(equal);
    } else {
        out_.stats.pieces += run.pieces;
        out_.records.insert(out_.records.end(), words_.begin(), words_.end());
    }
    if (last_run) note_region(entry, false, region);
}

void WrittenWords::clear() {
    if (entries_.empty()) return;
    entries_.clear();
    slots_.assign(16, 0);
}

void WrittenWords::grow() {
    slots_.assign(std::max<std::size_t>(16, 2 * slots_.size()), 0);
    for (std::uint32_t e = 0; e < entries_.size(); ++e) {
        std::size_t slot = entries_[e].hash & (slots_.size() - 1);
        while (slots_[slot] != 0)
            slot = (slot + 1) & (slots_.size() - 1);
        slots_[slot] = e + 1;
    }
}

std::optional<std::uint32_t> WrittenWords::find_or_add(std::span<const std::uint32_t> words, std::uint32_t at,
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
        if (std::ranges::equal(words, std::span(records).subspan(e.at, e.words))) return e.at;
    }
    entries_.push_back({hash, at, words.size()});
    slots_[slot] = static_cast<std::uint32_t>(entries_.size());
    return {};
}

} // namespace fetexc
