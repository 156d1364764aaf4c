// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes one row of texels into row-local words; rows are joined in order afterwards, so they can be built in
/// parallel.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compiler/compile.h"
#include "compiler/fbt/pieces.h"
#include "compiler/fbt/samples.h"

namespace fetexc {

/// What an entry stands for. Records and vertices are row-local until the rows are joined.
struct RegionEntry {
    std::uint32_t record = 0; ///< the entry that decides, as fetex::FbtRegion has it
    bool rest = false;
    ResultId result = 0;
    std::uint32_t vertex = 0; ///< of the reachability graph
};

struct RowOutput {
    std::vector<std::uint32_t> texels;         ///< addresses row-local
    std::vector<std::uint32_t> records;        ///< four words each
    std::vector<std::uint32_t> record_indices; ///< words of `records` that hold the index of a record
    std::vector<std::uint32_t> word_indices;   ///< words of `records` that hold the index of a word
    std::vector<RegionEntry> entries;
    FbtStats stats;
    fetex::FbtTraits traits;
    std::vector<std::uint32_t> collapsed; ///< vertices of which nothing is left in their texel
};

/// Sequences of words in the records, to find equal ones.
class WrittenWords {
  public:
    void clear();
    /// Where an equal sequence begins; none: these words, about to be written from word `at` on, are new.
    std::optional<std::uint32_t> find_or_add(std::span<const std::uint32_t> words, std::uint32_t at,
                                             const std::vector<std::uint32_t>& records);

  private:
    struct Entry {
        std::uint64_t hash = 0;
        std::uint32_t at = 0;
        std::size_t words = 0;
    };
    void grow();

    std::vector<Entry> entries_;
    std::vector<std::uint32_t> slots_; ///< open addressing: 1 + index of an entry, 0 = free; a power of 2, half empty
};

class RowWriter {
  public:
    RowWriter(const PlanarMap& map, const SampleSource& sampler, fetex::FbtSampleFormat format, RowOutput& out)
        : map_(map), sampler_(sampler), format_(format), out_(out) {}

    /// A texel of one region.
    void write_whole(const RegionSample& sample);
    /// first_vertex: of the texel's regions in the row's reachability graph.
    void write_texel(const TexelMap& texel, const TexelFeatures& features, std::uint32_t first_vertex);

  private:
    /// A feature that didn't vanish.
    struct ReadyFeature {
        std::uint32_t first_run = 0, runs = 0; ///< in runs_
        std::uint32_t ray = 0, region = 0;
        std::uint32_t depth = 0; ///< in how many other features of its band
    };
    /// A band ready to be written.
    struct ReadyBand {
        std::uint32_t y_end = 0;
        std::uint32_t first_feature = 0, features = 0; ///< in features_
        std::uint32_t rest = 0;
    };
    [[nodiscard]] std::span<const ReadyFeature> features_of(const ReadyBand& b) const {
        return std::span(features_).subspan(b.first_feature, b.features);
    }
    [[nodiscard]] std::span<const Run> runs_of(const ReadyFeature& f) const {
        return std::span(runs_.runs).subspan(f.first_run, f.runs);
    }
    [[nodiscard]] bool shadowed(const ReadyBand& band, const ReadyFeature& feature) const;
    [[nodiscard]] bool same_runs(const ReadyFeature& a, const ReadyFeature& b) const;
    void count_slivers();
    void prepare(const TexelMap& texel, const TexelFeatures& features);
    std::uint32_t write_band(const ReadyBand& band);
    void write_directory();
    void write_run(const Run& run, std::uint32_t word0, std::uint32_t region, bool last_run);
    void write_rest(std::uint32_t entry, std::uint32_t region);
    void end_record() { out_.records.resize((out_.records.size() + 3) / 4 * 4, 0); }
    void note_region(std::uint32_t entry, bool rest, std::uint32_t region);
    /// The patch's record, or the first of two.
    std::uint32_t write_patch(const RegionSample& sample);
    /// Patches are in the records then.
    void ready_samples();
    void ready_sample(std::uint32_t region);
    void lift_subtree(const ReadyBand& band, std::uint32_t depth);
    [[nodiscard]] std::uint32_t next_word() const { return static_cast<std::uint32_t>(out_.records.size()); }
    [[nodiscard]] std::uint32_t next_record() const { return next_word() / 4; }
    void note_sample(const RegionSample& sample); ///< in the traits
    void count_region(const RegionSample& sample);

    const PlanarMap& map_;
    const SampleSource& sampler_;
    fetex::FbtSampleFormat format_;
    RowOutput& out_;
    /// Model and sample word of a region.
    struct ReadySample {
        std::uint32_t model = 0, word = 0;
    };

    std::vector<RegionSample> samples_;
    std::vector<ReadySample> ready_; ///< as samples_
    std::vector<ResultId> results_;
    std::uint32_t first_vertex_ = 0;
    WrittenWords written_; ///< runs of the texel
    WrittenWords patches_; ///< of the row
    std::vector<ReadyBand> bands_;
    std::vector<ReadyFeature> features_;
    PieceRuns runs_;
    std::vector<std::uint32_t> words_, lists_;
    std::vector<bool> left_, is_ready_;
};

} // namespace fetexc
