// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/fbt_maker.h"

namespace fetexc::test {
namespace {

using Words = std::vector<std::uint32_t>;

std::uint32_t next_record(Words& records) {
    records.resize((records.size() + 3) / 4 * 4, 0);
    return static_cast<std::uint32_t>(records.size() / 4);
}

/// Not vector::insert: GCC 12 warns of an overflow there that doesn't exist.
void append(Words& out, const Words& words) {
    for (const std::uint32_t word : words)
        out.push_back(word);
}

} // namespace

std::uint32_t append_list(Words& records, const std::vector<MadeRun>& runs, MadeRegion rest, Words* first_words) {
    const std::uint32_t first = next_record(records);
    for (const MadeRun& run : runs) {
        next_record(records);
        const bool last = &run == &runs.back();
        records.push_back(run.pieces | run.degree << 10 | run.direction << 12 | run.depth << fetex::kFbtDepthShift |
                          (run.last ? fetex::kFbtEntryLastRun | run.inside.model << 16 : 0) |
                          (last ? fetex::kFbtEntryLast | rest.model << 18 : 0) |
                          (run.points.empty() ? fetex::kFbtEntryShared : 0));
        records.push_back(run.last ? run.inside.sample : 0);
        if (first_words) first_words->push_back(static_cast<std::uint32_t>(records.size()));
        append(records, run.points.empty() ? Words{run.shared_from} : run.points);
    }
    if (runs.empty()) append(records, {fetex::kFbtEntryLastRun | fetex::kFbtEntryLast | rest.model << 18, 0, 0});
    records.push_back(rest.sample);
    next_record(records);
    return first;
}

std::uint32_t append_directory(Words& records, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& bands) {
    const std::uint32_t first = next_record(records);
    records.push_back(static_cast<std::uint32_t>(bands.size()));
    for (std::size_t k = 0; k < bands.size(); k += 2)
        records.push_back(bands[k].first | (k + 1 < bands.size() ? bands[k + 1].first << 16 : 0));
    for (const auto& band : bands)
        records.push_back(band.second);
    next_record(records);
    return first;
}

std::uint32_t append_patch(Words& records, std::uint32_t c00, std::uint32_t c10, std::uint32_t c01, std::uint32_t c11) {
    return append_patch(records, {c00, c10, c01, c11});
}

std::uint32_t append_patch(Words& records, const std::vector<std::uint32_t>& samples) {
    const std::uint32_t first = next_record(records);
    records.insert(records.end(), samples.begin(), samples.end());
    return first;
}

} // namespace fetexc::test
