// SPDX-License-Identifier: Apache-2.0 OR MIT
/// Each word is looked at once in each role (entry, quadratic, cubic, patch), however often hostile data points at it.
#include "formats/validate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <unordered_set>

#include "formats/fbt_mip.h"
#include "formats/fbt_samples.h"

namespace fetex {
namespace {

constexpr std::uint32_t kEntryBits = (1u << 24) - 1;
constexpr std::uint32_t kQuantisedZero = 0x4000, kQuantisedOne = 0xc000;

/// How far, in steps, a coordinate of a quadratic or cubic with these quantised control values moves against its
/// general direction: half of what its total variation exceeds the distance of its ends.
double backtrack(const std::array<double, 4>& c, std::uint32_t degree) {
    const auto at = [&](double t) {
        const double s = 1 - t;
        if (degree == 2) return c[0] * s * s + 2 * c[1] * s * t + c[2] * t * t;
        return c[0] * s * s * s + 3 * (c[1] * s * s * t + c[2] * s * t * t) + c[3] * t * t * t;
    };
    // derivative / degree = a t² + 2 b t + d0
    const double d0 = c[1] - c[0], d1 = c[2] - c[1];
    const double a = degree == 3 ? d0 - 2 * d1 + (c[3] - c[2]) : 0.0, b = degree == 3 ? d1 - d0 : 0.5 * (d1 - d0);
    const double discriminant = b * b - a * d0;
    const double end = c[degree];
    double previous = c[0], variation = 0;
    if (discriminant > 0) {
        const double q = -(b + std::copysign(std::sqrt(discriminant), b));
        std::array<double, 2> roots = {a != 0 ? q / a : 2.0, q != 0 ? d0 / q : 2.0};
        std::sort(roots.begin(), roots.end());
        for (const double t : roots) {
            if (!(t > 0 && t < 1)) continue;
            variation += std::abs(at(t) - previous);
            previous = at(t);
        }
    }
    variation += std::abs(end - previous);
    return 0.5 * (variation - std::abs(end - c[0]));
}

/// Pieces of one degree, by the word where they begin: each is visited once, and the next of a run that wasn't is found
/// in nearly constant time (union-find over the visited ones; pieces of a run are `degree` words apart).
class VisitOnce {
  public:
    VisitOnce() = default;
    VisitOnce(std::size_t words, std::uint32_t degree) : degree_(degree), column_(words / degree + 2) {
        next_.resize(column_ * degree);
        std::iota(next_.begin(), next_.end(), std::size_t{0});
    }
    /// The first word ≥ `word`, a multiple of the degree further on, that wasn't visited.
    std::size_t first_unvisited(std::size_t word) {
        std::size_t k = word % degree_ * column_ + word / degree_;
        while (next_[k] != k)
            k = next_[k] = next_[next_[k]];
        return k % column_ * degree_ + k / column_;
    }
    void visit(std::size_t word) {
        const std::size_t k = word % degree_ * column_ + word / degree_;
        next_[k] = k + 1;
    }

  private:
    std::size_t degree_ = 1, column_ = 0;
    std::vector<std::size_t> next_; ///< columns of words that are the same modulo the degree, one spare place in each
};

class Checker {
  public:
    /// limit 0: record no finding and go on, for the traits alone.
    Checker(const FbtTexture& texture, std::size_t limit) : texture_(texture), limit_(limit) {}

    bool check_sizes();
    void check_corners();
    void check_mips();
    void check_texels();
    void check_traits();
    [[nodiscard]] const FbtTraits& traits() const { return traits_; }
    std::vector<Finding> take() { return std::move(findings_); }

  private:
    void report(FindingCode code, std::uint64_t word, const char* part, const std::string& message);
    void in_texels(FindingCode code, std::uint64_t texel, const std::string& message) {
        report(code, texel, "texels", message);
    }
    void in_record(FindingCode code, std::uint64_t record, const std::string& message) {
        report(code, record * 4, "records", message);
    }
    [[nodiscard]] bool full() const { return limit_ != 0 && findings_.size() >= limit_; }
    [[nodiscard]] const std::uint32_t* record(std::uint64_t k) const { return texture_.records.data() + k * 4; }

    void check_texel(std::uint32_t i, std::uint32_t j);
    void check_directory(std::uint32_t address);
    void walk_directory(std::uint32_t address);
    void check_list(std::uint32_t first);
    bool check_entry(std::uint32_t at);
    void check_depth(std::uint32_t at, const FbtEntry& entry);
    bool check_run(std::uint32_t at, const FbtEntry& entry);
    void check_curve(std::size_t word, std::uint32_t degree);
    /// Model and sample of a region; where: a texel or a record.
    void check_region(std::uint32_t model, std::uint32_t sample, bool in_records, std::uint64_t where);
    void check_patch(std::uint32_t address);
    /// RGBA8.
    void check_sample(std::uint32_t sample, const char* part, std::uint64_t word);
    /// In the texture's sample format; words: of the part, the sample's first.
    void check_formatted(const std::vector<std::uint32_t>& words, const char* part, std::uint64_t word);

    const FbtTexture& texture_;
    std::size_t limit_;
    std::vector<Finding> findings_;
    FbtTraits traits_;
    std::uint32_t record_count_ = 0;
    static constexpr std::uint32_t kBadList = 0xffffffffu;
    std::vector<std::uint32_t> list_length_; ///< [record]: entries from here to the last; 0 unknown
    std::vector<bool> patch_seen_;           ///< [record]
    std::vector<std::uint32_t> path_;
    std::unordered_set<std::uint32_t> directories_;
    std::array<VisitOnce, 2> curves_; ///< degree 2, degree 3
};

void Checker::report(FindingCode code, std::uint64_t word, const char* part, const std::string& message) {
    if (limit_ == 0 || full()) return;
    findings_.push_back({code, word * 4, std::string(part) + ": " + message});
}

bool Checker::check_sizes() {
    const auto& t = texture_;
    record_count_ = static_cast<std::uint32_t>(t.records.size() / 4);
    const char* wrong = nullptr;
    if (t.width < 1 || t.width > kFbtMaxSide || t.height < 1 || t.height > kFbtMaxSide) {
        wrong = "width or height outside 1 … 16384";
    } else if (t.texels.size() != std::uint64_t{t.width} * t.height) {
        wrong = "the texel array hasn't width·height texels";
    } else if (t.sample_format > FbtSampleFormat::Rgba16F) {
        wrong = "unknown sample format";
    } else if (!t.corners.empty() &&
               t.corners.size() != (std::uint64_t{t.width} + 1) * (t.height + 1) * fbt_sample_words(t.sample_format)) {
        wrong = "the corner array is neither empty nor of (width+1)·(height+1) samples";
    } else if (t.records.size() % 4 != 0 || t.records.size() / 4 > kFbtAddressMask) {
        wrong = "the record array isn't of whole records, or is beyond 30-bit addresses";
    } else if (!t.mips.empty() && t.mips.size() != fbt_mip_samples(t.width, t.height)) {
        wrong = "the mip chain is neither empty nor of all its levels";
    }
    if (wrong) report(FindingCode::FbtDimensions, 0, "header", wrong);
    return wrong == nullptr;
}

void Checker::check_corners() {
    for (std::size_t k = 0; k < texture_.corners.size() && !full(); k += fbt_sample_words(texture_.sample_format))
        check_formatted(texture_.corners, "corners", k);
}

void Checker::check_mips() {
    for (std::size_t k = 0; k < texture_.mips.size() && !full(); ++k)
        check_sample(texture_.mips[k], "mips", k);
}

void Checker::check_texels() {
    list_length_.assign(record_count_, 0);
    patch_seen_.assign(record_count_, false);
    curves_ = {VisitOnce(texture_.records.size(), 2), VisitOnce(texture_.records.size(), 3)};
    for (std::uint32_t j = 0; j < texture_.height && !full(); ++j) {
        for (std::uint32_t i = 0; i < texture_.width && !full(); ++i)
            check_texel(i, j);
    }
}

void Checker::check_texel(std::uint32_t i, std::uint32_t j) {
    const std::uint64_t texel = std::uint64_t{j} * texture_.width + i;
    const std::string name = "texel (" + std::to_string(i) + "," + std::to_string(j) + ")";
    const std::uint32_t word = texture_.texels[texel], kind = word >> 30;
    if (kind == kFbtKindSolid) {
        const bool opaque = (word & kFbtOpaque) != 0;
        if (word > (kFbtOpaque | 0xffffffu) || (!opaque && word != 0))
            in_texels(FindingCode::FbtReservedBits, texel, name + ": reserved bits, or a colour that isn't opaque");
        traits_.translucent |= !opaque;
    } else if (kind == kFbtKindShaded) {
        if ((word >> 28 & 3u) == kFbtModelSolid)
            return in_texels(FindingCode::FbtModel, texel, name + ": shaded by the solid model");
        check_region(word >> 28 & 3u, word & kFbtSampleMask, false, texel);
    } else if ((word & kFbtAddressMask) >= record_count_) {
        in_texels(FindingCode::FbtAddress, texel, name + ": address beyond the records");
    } else if (kind == kFbtKindBanded) {
        traits_.bands = true;
        check_directory(word & kFbtAddressMask);
    } else {
        check_list(word & kFbtAddressMask);
    }
}

void Checker::check_directory(std::uint32_t address) {
    if (directories_.insert(address).second) walk_directory(address);
}

void Checker::walk_directory(std::uint32_t address) {
    const std::uint32_t* words = record(address);
    const std::uint32_t bands = words[0];
    if (bands == 0 || fbt_directory_records(bands) > record_count_ - address)
        return in_record(FindingCode::FbtBandCount, address, "directory without bands, or beyond the records");
    const std::size_t lists = 1 + (std::size_t{bands} + 1) / 2;
    bool padded = bands % 2 == 0 || words[lists - 1] >> 16 == 0;
    for (std::size_t k = lists + bands; k < 4 * fbt_directory_records(bands); ++k)
        padded = padded && words[k] == 0;
    if (!padded) in_record(FindingCode::FbtPadding, address, "padding of a directory isn't 0");
    std::uint32_t previous = kQuantisedZero;
    for (std::uint32_t k = 0; k < bands; ++k) {
        const std::uint32_t y_end = fbt_band_end(words, k), first = words[lists + k];
        if (y_end <= previous || y_end > kQuantisedOne || (k + 1 == bands && y_end != kQuantisedOne))
            return in_record(FindingCode::FbtBandOrder, address,
                             "y_end of band " + std::to_string(k) + " out of order");
        previous = y_end;
        if (first >= record_count_)
            return in_record(FindingCode::FbtAddress, address,
                             "address of band " + std::to_string(k) + " beyond the records");
        check_list(first);
    }
    traits_.max_bands = std::max(traits_.max_bands, bands);
}

/// Walks to the last entry or to one walked before, then notes lengths backwards.
void Checker::check_list(std::uint32_t first) {
    path_.clear();
    std::uint32_t length = 0; // of what follows the path
    for (std::uint32_t at = first;;) {
        if (at >= record_count_) {
            in_record(FindingCode::FbtNoLastEntry, first, "entry list without a last entry");
            length = kBadList;
            break;
        }
        if (list_length_[at] != 0) {
            length = list_length_[at];
            break;
        }
        path_.push_back(at);
        if (!check_entry(at)) {
            length = kBadList;
            break;
        }
        const FbtEntry entry(record(at)[0]);
        if (entry.last()) break;
        at += entry.records();
    }
    for (auto at = path_.rbegin(); at != path_.rend(); ++at) {
        if (length == kFbtMaxEntries) in_record(FindingCode::FbtTooManyEntries, *at, "more entries than 2^20");
        length = length >= kFbtMaxEntries ? kBadList : length + 1;
        list_length_[*at] = length;
    }
    if (length != kBadList) traits_.max_entries = std::max(traits_.max_entries, length);
}

/// False: what follows it can't be found.
bool Checker::check_entry(std::uint32_t at) {
    const std::uint32_t* words = record(at);
    const FbtEntry entry(words[0]);
    if ((words[0] & ~kEntryBits) != 0) in_record(FindingCode::FbtReservedBits, at, "reserved bits of an entry");
    if ((entry.pieces() == 0) != (entry.degree() == 0)) {
        in_record(FindingCode::FbtDegree, at, "pieces without a degree, or a degree without pieces");
        return false;
    }
    if (entry.records() > record_count_ - at) {
        in_record(FindingCode::FbtPieceAddress, at, "an entry beyond the records");
        return false;
    }
    if (entry.last()) {
        check_region(entry.rest_model(), words[entry.rest_word()], true, at);
        if (!entry.last_run()) {
            in_record(FindingCode::FbtUnfinishedFeature, at, "the last entry isn't the last run of its feature");
            return false;
        }
    } else if (entry.rest_model() != 0) {
        in_record(FindingCode::FbtStraySample, at, "a rest before the last entry");
    }
    check_depth(at, entry);
    for (std::size_t k = entry.rest_word() + (entry.last() ? 1 : 0); k < std::size_t{4} * entry.records(); ++k)
        if (words[k] != 0) in_record(FindingCode::FbtPadding, at, "padding of an entry isn't 0");
    if (entry.pieces() == 0) {
        const std::uint32_t plain = kFbtEntryLast | kFbtEntryLastRun | entry.rest_model() << 18;
        if (words[0] == plain && words[1] == 0 && words[2] == 0) return true;
        in_record(FindingCode::FbtEmptyRun, at, "an entry without pieces that isn't a lone rest");
        return false;
    }
    if (entry.last_run()) {
        check_region(entry.model(), words[1], true, at);
    } else if ((entry.model() | words[1]) != 0) {
        in_record(FindingCode::FbtStraySample, at, "a sample on a run that isn't the last of its feature");
    }
    return check_run(at, entry);
}

/// Post-order: what follows a feature encloses it, or is beside it or inside what is.
void Checker::check_depth(std::uint32_t at, const FbtEntry& entry) {
    traits_.max_depth = std::max(traits_.max_depth, entry.depth());
    const std::uint32_t next = at + entry.records();
    bool wrong = false;
    if (entry.last()) {
        wrong = entry.depth() != 0;
    } else if (next < record_count_) {
        const std::uint32_t depth = FbtEntry(record(next)[0]).depth();
        wrong = entry.last_run() ? depth + 1 < entry.depth() : depth != entry.depth();
    }
    if (wrong) in_record(FindingCode::FbtNesting, at, "the depth doesn't fit what follows");
}

bool Checker::check_run(std::uint32_t at, const FbtEntry& entry) {
    const std::uint32_t degree = entry.degree();
    const std::size_t size = texture_.records.size();
    const std::size_t first = entry.shared() ? record(at)[2] : std::size_t{4} * at + 2;
    if (first >= size || entry.points() > size - first) {
        in_record(FindingCode::FbtPieceAddress, at, "points beyond the records");
        return false;
    }
    traits_.shared |= entry.shared();
    traits_.degrees |= 1u << degree;
    traits_.max_degree = std::max(traits_.max_degree, degree);
    traits_.directions |= 1u << entry.direction();
    if (degree == 1) return true;
    VisitOnce& curves = curves_[degree - 2];
    const std::size_t end = first + std::size_t{entry.pieces()} * degree;
    for (std::size_t k = curves.first_unvisited(first); k < end; k = curves.first_unvisited(k)) {
        check_curve(k, degree);
        curves.visit(k);
    }
    return true;
}

void Checker::check_region(std::uint32_t model, std::uint32_t sample, bool in_records, std::uint64_t where) {
    const auto found = [&](FindingCode code, const char* message) {
        in_records ? in_record(code, where, message) : in_texels(code, where, message);
    };
    if (model == kFbtModelSolid)
        return check_sample(sample, in_records ? "records" : "texels", where * (in_records ? 4 : 1));
    if (model == kFbtModelCorners) {
        traits_.corners = true;
        if (sample != 0) found(FindingCode::FbtReservedBits, "a sample beside the model corners");
        if (texture_.corners.empty()) found(FindingCode::FbtCorners, "the model corners in a texture that has none");
    } else if (model != kFbtModelPatch) {
        found(FindingCode::FbtModel, "unknown model");
    } else if (sample >= record_count_ || record_count_ - sample < fbt_patch_records(texture_.sample_format)) {
        found(FindingCode::FbtAddress, "a patch beyond the records");
    } else {
        traits_.patches = true;
        check_patch(sample);
    }
}

void Checker::check_patch(std::uint32_t address) {
    if (patch_seen_[address]) return;
    patch_seen_[address] = true;
    for (std::uint32_t k = 0; k < 4; ++k)
        check_formatted(texture_.records, "records",
                        std::size_t{4} * address + k * fbt_sample_words(texture_.sample_format));
}

void Checker::check_curve(std::size_t word, std::uint32_t degree) {
    const std::uint32_t* points = texture_.records.data() + word;
    for (const std::uint32_t shift : {0u, 16u}) {
        std::array<double, 4> c{};
        for (std::uint32_t n = 0; n <= degree; ++n)
            c[n] = static_cast<double>(points[n] >> shift & 0xffffu);
        if (backtrack(c, degree) > kFbtMonotoneSlack)
            report(FindingCode::FbtNotMonotone, word, "records",
                   shift == 0 ? "piece turns back in x" : "piece turns back in y");
    }
}

void Checker::check_formatted(const std::vector<std::uint32_t>& words, const char* part, std::uint64_t word) {
    const FbtSampleFormat format = texture_.sample_format;
    const std::uint32_t* sample = words.data() + word;
    if (format == FbtSampleFormat::Rgba8) return check_sample(*sample, part, word);
    const std::uint32_t alpha = sample[1] >> 16;
    const std::array<std::uint32_t, 3> color = {sample[0] & 0xffffu, sample[0] >> 16, sample[1] & 0xffffu};
    traits_.translucent |= !fbt_sample_opaque(sample, format);
    if (format == FbtSampleFormat::Rgba16) {
        if (*std::ranges::max_element(color) > alpha)
            report(FindingCode::FbtNotPremultiplied, word, part, "a colour channel exceeds alpha");
        return;
    }
    // Halves without a sign order as integers do.
    if (*std::ranges::max_element(color) >= kFbtHalfInfinity || alpha > kFbtHalfOne)
        return report(FindingCode::FbtSampleValue, word, part,
                      "a half that is negative, infinite or no number, or an alpha above 1");
    if (alpha == 0 && (sample[0] != 0 || color[2] != 0))
        report(FindingCode::FbtNotPremultiplied, word, part, "a colour where alpha is 0");
}

void Checker::check_sample(std::uint32_t sample, const char* part, std::uint64_t word) {
    const std::uint32_t alpha = sample >> 24;
    traits_.translucent |= alpha < 255;
    if ((sample & 0xffu) <= alpha && (sample >> 8 & 0xffu) <= alpha && (sample >> 16 & 0xffu) <= alpha) return;
    report(FindingCode::FbtNotPremultiplied, word, part, "a colour channel exceeds alpha");
}

void Checker::check_traits() {
    const FbtTraits &stated = texture_.traits, &real = traits_;
    const auto differs = [this](const char* name, std::uint32_t a, std::uint32_t b) {
        if (a != b)
            report(FindingCode::FbtTraitsMismatch, 0, "header",
                   std::string(name) + " is stated as " + std::to_string(a) + ", the texture has " + std::to_string(b));
    };
    differs("max_degree", stated.max_degree, real.max_degree);
    differs("degrees", stated.degrees, real.degrees);
    differs("bands", stated.bands, real.bands);
    differs("corners", stated.corners, real.corners);
    differs("patches", stated.patches, real.patches);
    differs("shared", stated.shared, real.shared);
    differs("translucent", stated.translucent, real.translucent);
    differs("directions", stated.directions, real.directions);
    differs("max_entries", stated.max_entries, real.max_entries);
    differs("max_bands", stated.max_bands, real.max_bands);
    differs("max_depth", stated.max_depth, real.max_depth);
}

} // namespace

std::vector<Finding> validate_fbt(const FbtTexture& texture, std::size_t limit) {
    Checker checker(texture, std::max<std::size_t>(limit, 1));
    if (!checker.check_sizes()) return checker.take();
    checker.check_corners();
    checker.check_mips();
    checker.check_texels();
    checker.check_traits();
    return checker.take();
}

FbtTraits fbt_traits(const FbtTexture& texture) {
    Checker checker(texture, 0);
    if (!checker.check_sizes()) return {};
    checker.check_corners();
    checker.check_mips();
    checker.check_texels();
    return checker.traits();
}

} // namespace fetex
