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

struct RowOutput {
    std::vector<std::uint32_t> texels;                       ///< word 0, word 1 per texel; addresses row-local
    std::vector<std::uint32_t> records;                      ///< four words each
    std::vector<std::uint32_t> relocate;                     ///< word indices in records that hold record addresses
    std::vector<std::pair<std::uint32_t, ResultId>> entries; ///< row-local record → result
    FbtStats stats;
    fetex::FbtTraits traits;
};

class RowWriter {
  public:
    RowWriter(const PlanarMap& map, const RegionSampler& sampler, RowOutput& out)
        : map_(map), sampler_(sampler), out_(out) {}

    void write_empty(std::uint32_t representative, const RegionSample& sample);
    void write_texel(std::uint32_t representative, const TexelMap& texel, const TexelFeatures& features);

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
    std::map<std::vector<std::uint32_t>, std::uint32_t> written_; ///< piece words of this texel → record
};

} // namespace fetexc
