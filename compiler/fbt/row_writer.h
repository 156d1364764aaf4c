// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes one row of texels into row-local words; rows are joined in order afterwards, so they can be built in
/// parallel.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "compiler/compile.h"
#include "compiler/fbt/pieces.h"
#include "compiler/fbt/samples.h"

namespace fetexc {

/// What an entry stands for. Records and vertices are row-local until the rows are joined.
struct RegionEntry {
    std::uint32_t record = 0; ///< last run of a feature, or terminator
    ResultId result = 0;
    std::uint32_t vertex = 0; ///< of the reachability graph
};

struct RowOutput {
    std::vector<std::uint32_t> texels;   ///< word 0, word 1 per texel; addresses row-local
    std::vector<std::uint32_t> records;  ///< four words each
    std::vector<std::uint32_t> relocate; ///< word indices in records that hold record addresses
    std::vector<RegionEntry> entries;
    FbtStats stats;
    fetex::FbtTraits traits;
    std::vector<std::uint32_t> collapsed; ///< vertices of which nothing is left in their texel
};

class RowWriter {
  public:
    RowWriter(const PlanarMap& map, const RegionSampler& sampler, RowOutput& out)
        : map_(map), sampler_(sampler), out_(out) {}

    void write_empty(std::uint32_t representative, const RegionSample& sample);
    /// first_vertex: of the texel's regions in the row's reachability graph.
    void write_texel(std::uint32_t representative, const TexelMap& texel, const TexelFeatures& features,
                     std::uint32_t first_vertex);

  private:
    /// A band ready to be written: runs per feature that didn't vanish.
    struct ReadyFeature {
        std::vector<Run> runs;
        std::uint32_t ray = 0, region = 0;
    };
    struct ReadyBand {
        std::uint32_t y_end = 0;
        std::vector<ReadyFeature> features;
        std::uint32_t rest = 0;
    };
    static bool shadowed(const std::vector<ReadyFeature>& before, const std::vector<Run>& runs, std::uint32_t ray);
    void count_slivers(const std::vector<ReadyBand>& bands);
    std::vector<ReadyBand> prepare(const TexelMap& texel, const TexelFeatures& features);
    std::uint32_t write_band(const ReadyBand& band);
    std::uint32_t write_pieces(const Run& run);
    void write_entry(std::uint32_t address, std::uint32_t word1, std::uint32_t region, bool last);
    [[nodiscard]] std::uint32_t next_record() const { return static_cast<std::uint32_t>(out_.records.size() / 4); }
    void note_sample(const RegionSample& sample);

    const PlanarMap& map_;
    const RegionSampler& sampler_;
    RowOutput& out_;
    std::vector<RegionSample> samples_;
    std::vector<ResultId> results_;
    std::uint32_t first_vertex_ = 0;
    std::map<std::vector<std::uint32_t>, std::uint32_t> written_; ///< piece words of this texel → record
};

} // namespace fetexc
