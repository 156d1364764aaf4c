// SPDX-License-Identifier: Apache-2.0 OR MIT
/// Each record is looked at once in each role (entry, quadratic, cubic), however often hostile data points at it.
#include "formats/validate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace fetex {
namespace {

constexpr std::uint32_t kMaskNeedsRight = 0x55, kMaskNeedsBelow = 0xaa; ///< codes 1 and 3; codes 2 and 3
constexpr std::uint32_t kEntryBits = 0x003fffffu;
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

/// The next index not visited yet, in nearly constant time (union-find over visited neighbours).
class VisitOnce {
  public:
    explicit VisitOnce(std::size_t size) : next_(size + 1) { std::iota(next_.begin(), next_.end(), 0u); }
    std::uint32_t first_unvisited(std::uint32_t k) {
        while (next_[k] != k)
            k = next_[k] = next_[next_[k]];
        return k;
    }
    void visit(std::uint32_t k) { next_[k] = k + 1; }

  private:
    std::vector<std::uint32_t> next_;
};

/// What a list of entries, or all lists of a directory, ask for.
struct Needs {
    bool valid = false;
    std::uint32_t masks = 0; ///< union of the availability masks
};

class Checker {
  public:
    /// limit 0: record no finding and go on, for the traits alone.
    Checker(const FbtTexture& texture, std::size_t limit) : texture_(texture), limit_(limit) {}

    bool check_sizes();
    void check_texels();
    void check_traits();
    [[nodiscard]] const FbtTraits& traits() const { return traits_; }
    std::vector<Finding> take() { return std::move(findings_); }

  private:
    void report(FindingCode code, std::uint64_t word, const char* part, const std::string& message);
    void in_texels(FindingCode code, std::uint64_t texel, const std::string& message) {
        report(code, texel * 2, "texels", message);
    }
    void in_record(FindingCode code, std::uint64_t record, const std::string& message) {
        report(code, record * 4, "records", message);
    }
    [[nodiscard]] bool full() const { return limit_ != 0 && findings_.size() >= limit_; }
    [[nodiscard]] const std::uint32_t* record(std::uint64_t k) const { return texture_.records.data() + k * 4; }

    void check_texel(std::uint32_t i, std::uint32_t j);
    void check_apron_texel(std::uint64_t texel);
    Needs check_directory(std::uint32_t address);
    Needs walk_directory(std::uint32_t address);
    Needs check_list(std::uint32_t first);
    bool check_entry(std::uint32_t at, bool after_unfinished);
    bool check_terminator(std::uint32_t at, bool after_unfinished);
    bool check_run(std::uint32_t at);
    bool check_pieces(std::uint32_t at, std::uint32_t first, std::uint32_t degree, std::uint32_t count);
    void check_curve(std::uint32_t piece, std::uint32_t degree);
    void check_sample(std::uint32_t sample, bool in_records, std::uint64_t where);
    void note_mask(std::uint32_t mask) { traits_.interpolated |= mask != 0; }

    const FbtTexture& texture_;
    std::size_t limit_;
    std::vector<Finding> findings_;
    FbtTraits traits_;
    std::uint32_t record_count_ = 0;
    static constexpr std::uint32_t kBadList = 0xffffffffu;
    std::vector<std::uint32_t> list_length_; ///< [record]: entries from here to the terminator; 0 unknown
    std::vector<std::uint8_t> list_masks_;   ///< [record]: union of masks from here to the terminator
    std::unordered_map<std::uint32_t, Needs> directories_;
    std::array<VisitOnce, 2> curves_ = {VisitOnce(0), VisitOnce(0)}; ///< degree 2, degree 3
};

void Checker::report(FindingCode code, std::uint64_t word, const char* part, const std::string& message) {
    if (limit_ == 0 || full()) return;
    findings_.push_back({code, word * 4, std::string(part) + ": " + message});
}

bool Checker::check_sizes() {
    const auto& t = texture_;
    const std::uint64_t count = std::uint64_t{t.width + t.apron} * (t.height + t.apron);
    record_count_ = static_cast<std::uint32_t>(t.records.size() / 4);
    const char* wrong = nullptr;
    if (t.width < 1 || t.width > kFbtMaxSide || t.height < 1 || t.height > kFbtMaxSide) {
        wrong = "width or height outside 1 … 16384";
    } else if (t.apron > 1) {
        wrong = "apron is neither 0 nor 1";
    } else if (t.texels.size() != count * 2) {
        wrong = "the texel array hasn't (width+apron)·(height+apron) texels";
    } else if (t.records.size() % 4 != 0 || t.records.size() / 4 > kFbtAddressMask) {
        wrong = "the record array isn't of whole records, or is beyond 30-bit addresses";
    }
    if (wrong) report(FindingCode::FbtDimensions, 0, "header", wrong);
    return wrong == nullptr;
}

void Checker::check_texels() {
    list_length_.assign(record_count_, 0);
    list_masks_.assign(record_count_, 0);
    curves_ = {VisitOnce(record_count_), VisitOnce(record_count_)};
    const std::uint32_t columns = texture_.width + texture_.apron, rows = texture_.height + texture_.apron;
    for (std::uint32_t j = 0; j < rows && !full(); ++j) {
        for (std::uint32_t i = 0; i < columns && !full(); ++i) {
            const std::uint64_t texel = std::uint64_t{j} * columns + i;
            check_sample(texture_.texels[texel * 2], false, texel);
            if (i < texture_.width && j < texture_.height) {
                check_texel(i, j);
            } else {
                check_apron_texel(texel);
            }
        }
    }
}

void Checker::check_texel(std::uint32_t i, std::uint32_t j) {
    const std::uint64_t texel = std::uint64_t{j} * (texture_.width + texture_.apron) + i;
    const std::string name = "texel (" + std::to_string(i) + "," + std::to_string(j) + ")";
    const std::uint32_t word = texture_.texels[texel * 2 + 1], kind = word >> 30;
    Needs needs;
    if (kind == kFbtKindEmpty) {
        if ((word & kFbtAddressMask) > 0xffu) in_texels(FindingCode::FbtReservedBits, texel, name + ": reserved bits");
        note_mask(word & 0xffu);
        needs.masks = word & 0xffu;
    } else if (kind > kFbtKindBanded) {
        return in_texels(FindingCode::FbtTexelKind, texel, name + ": kind 3");
    } else if ((word & kFbtAddressMask) >= record_count_) {
        return in_texels(FindingCode::FbtAddress, texel, name + ": address beyond the records");
    } else if (kind == kFbtKindBanded) {
        traits_.bands = true;
        needs = check_directory(word & kFbtAddressMask);
    } else {
        needs = check_list(word & kFbtAddressMask);
    }
    const bool right = i + 1 < texture_.width + texture_.apron, below = j + 1 < texture_.height + texture_.apron;
    if (((needs.masks & kMaskNeedsRight) != 0 && !right) || ((needs.masks & kMaskNeedsBelow) != 0 && !below))
        in_texels(FindingCode::FbtMask, texel, name + ": a mask asks for a texel beyond the texture, no apron");
}

void Checker::check_apron_texel(std::uint64_t texel) {
    if (texture_.texels[texel * 2 + 1] != 0)
        in_texels(FindingCode::FbtReservedBits, texel, "word 1 of an apron texel isn't 0");
}

Needs Checker::check_directory(std::uint32_t address) {
    const auto known = directories_.find(address);
    if (known != directories_.end()) return known->second;
    const Needs needs = walk_directory(address);
    directories_.emplace(address, needs);
    return needs;
}

Needs Checker::walk_directory(std::uint32_t address) {
    const std::uint32_t* words = record(address);
    const std::uint32_t bands = words[0];
    if (bands == 0 || fbt_directory_records(bands) > record_count_ - address) {
        in_record(FindingCode::FbtBandCount, address, "directory without bands, or beyond the records");
        return {};
    }
    if (words[1] != 0) in_record(FindingCode::FbtReservedBits, address, "word 1 of a directory isn't 0");
    if (bands % 2 == 0 && (words[2 + 2 * std::size_t{bands}] | words[3 + 2 * std::size_t{bands}]) != 0)
        in_record(FindingCode::FbtPadding, address, "padding of a directory isn't 0");
    Needs needs{true, 0};
    std::uint32_t previous = kQuantisedZero;
    for (std::uint32_t k = 0; k < bands; ++k) {
        const std::uint32_t y_end = words[2 + 2 * std::size_t{k}], first = words[3 + 2 * std::size_t{k}];
        if (y_end <= previous || y_end > kQuantisedOne || (k + 1 == bands && y_end != kQuantisedOne)) {
            in_record(FindingCode::FbtBandOrder, address, "y_end of band " + std::to_string(k) + " out of order");
            return {};
        }
        previous = y_end;
        if (first >= record_count_) {
            in_record(FindingCode::FbtAddress, address, "address of band " + std::to_string(k) + " beyond the records");
            return {};
        }
        const Needs band = check_list(first);
        needs.valid &= band.valid;
        needs.masks |= band.masks;
    }
    traits_.max_bands = std::max(traits_.max_bands, bands);
    return needs;
}

/// Walks to the terminator or to an entry walked before, then notes lengths and masks backwards.
Needs Checker::check_list(std::uint32_t first) {
    std::uint32_t at = first;
    bool unfinished = false, good = true;
    while (at < record_count_ && list_length_[at] == 0) {
        if (!check_entry(at, unfinished)) {
            good = false;
            break;
        }
        const std::uint32_t bits = record(at)[1];
        list_masks_[at] = static_cast<std::uint8_t>(record(at)[3]);
        if (bits & kFbtEntryTerminator) {
            list_length_[at] = 1;
            break;
        }
        unfinished = (bits & kFbtEntryLastRun) == 0;
        ++at;
    }
    if (at == record_count_) {
        in_record(FindingCode::FbtNoTerminator, first, "entry list without a terminator");
        good = false;
    } else if (good && unfinished && (record(at)[1] & kFbtEntryTerminator) != 0) {
        good = check_terminator(at, unfinished);
    }
    std::uint32_t length = good ? list_length_[at] : kBadList;
    std::uint32_t masks = good ? list_masks_[at] : 0;
    if (at < record_count_) list_length_[at] = length;
    for (std::uint32_t k = at; k > first;) {
        --k;
        length = length >= kFbtMaxEntries ? kBadList : length + 1;
        masks |= list_masks_[k];
        list_length_[k] = length;
        list_masks_[k] = static_cast<std::uint8_t>(masks);
    }
    if (good && length == kBadList) in_record(FindingCode::FbtTooManyEntries, first, "more entries than 2^20");
    if (length == kBadList) return {};
    traits_.max_entries = std::max(traits_.max_entries, length);
    return {true, masks};
}

bool Checker::check_entry(std::uint32_t at, bool after_unfinished) {
    const std::uint32_t* entry = record(at);
    if (entry[1] & kFbtEntryTerminator) {
        if (!check_terminator(at, after_unfinished)) return false;
    } else if (!check_run(at)) {
        return false;
    }
    if (entry[3] > 0xffu) in_record(FindingCode::FbtReservedBits, at, "reserved bits beside a mask");
    if (entry[1] & (kFbtEntryLastRun | kFbtEntryTerminator)) {
        check_sample(entry[2], true, at);
        note_mask(entry[3] & 0xffu);
    } else if ((entry[2] | entry[3]) != 0) {
        in_record(FindingCode::FbtStraySample, at, "sample or mask on a run that isn't the last of its feature");
    }
    return true;
}

bool Checker::check_terminator(std::uint32_t at, bool after_unfinished) {
    const std::uint32_t* entry = record(at);
    if (after_unfinished) {
        in_record(FindingCode::FbtUnfinishedFeature, at, "terminator after a run that isn't the last of its feature");
        return false;
    }
    if (entry[0] != 0 || entry[1] != kFbtEntryTerminator)
        in_record(FindingCode::FbtTerminator, at, "terminator with pieces or other bits");
    return true;
}

bool Checker::check_run(std::uint32_t at) {
    const std::uint32_t* entry = record(at);
    const std::uint32_t count = entry[1] & 0xffffu, degree = entry[1] >> 16 & 3u;
    if ((entry[1] & ~kEntryBits) != 0) in_record(FindingCode::FbtReservedBits, at, "reserved bits of an entry");
    if (count == 0) {
        in_record(FindingCode::FbtEmptyRun, at, "run without pieces");
        return false;
    }
    if (degree == 0) {
        in_record(FindingCode::FbtDegree, at, "run of degree 0");
        return false;
    }
    if (entry[0] >= record_count_ || fbt_piece_records(degree, count) > record_count_ - entry[0]) {
        in_record(FindingCode::FbtPieceAddress, at, "pieces beyond the records");
        return false;
    }
    traits_.degrees |= 1u << degree;
    traits_.max_degree = std::max(traits_.max_degree, degree);
    traits_.directions |= 1u << (entry[1] >> 18 & 3u);
    return check_pieces(at, entry[0], degree, count);
}

bool Checker::check_pieces(std::uint32_t at, std::uint32_t first, std::uint32_t degree, std::uint32_t count) {
    if (degree == 1) {
        const std::uint32_t* points = record(first);
        for (std::uint64_t k = std::uint64_t{count} + 1; k < fbt_piece_records(1, count) * 4; ++k)
            if (points[k] != 0) in_record(FindingCode::FbtPadding, at, "padding of a polyline isn't 0");
        return true;
    }
    VisitOnce& curves = curves_[degree - 2];
    for (std::uint32_t k = curves.first_unvisited(first); k < first + count; k = curves.first_unvisited(k)) {
        check_curve(k, degree);
        curves.visit(k);
    }
    return true;
}

void Checker::check_curve(std::uint32_t piece, std::uint32_t degree) {
    const std::uint32_t* points = record(piece);
    if (degree == 2 && points[3] != 0) in_record(FindingCode::FbtPadding, piece, "padding of a quadratic isn't 0");
    for (const std::uint32_t shift : {0u, 16u}) {
        std::array<double, 4> c{};
        for (std::uint32_t n = 0; n <= degree; ++n)
            c[n] = static_cast<double>(points[n] >> shift & 0xffffu);
        if (backtrack(c, degree) > kFbtMonotoneSlack)
            in_record(FindingCode::FbtNotMonotone, piece,
                      shift == 0 ? "piece turns back in x" : "piece turns back in y");
    }
}

void Checker::check_sample(std::uint32_t sample, bool in_records, std::uint64_t where) {
    const std::uint32_t alpha = sample >> 24;
    traits_.translucent |= alpha < 255;
    if ((sample & 0xffu) <= alpha && (sample >> 8 & 0xffu) <= alpha && (sample >> 16 & 0xffu) <= alpha) return;
    if (in_records) return in_record(FindingCode::FbtNotPremultiplied, where, "a colour channel exceeds alpha");
    in_texels(FindingCode::FbtNotPremultiplied, where, "a colour channel exceeds alpha");
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
    differs("interpolated", stated.interpolated, real.interpolated);
    differs("translucent", stated.translucent, real.translucent);
    differs("directions", stated.directions, real.directions);
    differs("max_entries", stated.max_entries, real.max_entries);
    differs("max_bands", stated.max_bands, real.max_bands);
}

} // namespace

std::vector<Finding> validate_fbt(const FbtTexture& texture, std::size_t limit) {
    Checker checker(texture, std::max<std::size_t>(limit, 1));
    if (!checker.check_sizes()) return checker.take();
    checker.check_texels();
    checker.check_traits();
    return checker.take();
}

FbtTraits fbt_traits(const FbtTexture& texture) {
    Checker checker(texture, 0);
    if (!checker.check_sizes()) return {};
    checker.check_texels();
    return checker.traits();
}

} // namespace fetex
