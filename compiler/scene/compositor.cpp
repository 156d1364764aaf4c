// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/scene/compositor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <unordered_map>
#include <utility>
#include <vector>

#include <tbb/concurrent_unordered_map.h>
#include <tbb/concurrent_vector.h>

#include "compiler/error_budget.h"
#include "compiler/scene/clip_tree.h"
#include "compiler/scene/paint.h"
#include "compiler/scene/stack.h"
#include "compiler/scene/tree.h"

namespace fetexc {
namespace {

/// What resolve() needs of the tree, precomputed so that a call costs the number of active fills, not of nodes.
struct TreeIndex {
    std::vector<std::vector<std::uint32_t>> fills_of_shape;
    std::vector<std::uint32_t> composited; ///< nearest composited ancestor group
    std::vector<std::uint32_t> clipped;    ///< nearest ancestor with a clip
    std::vector<bool> covers;              ///< a fill in no composited group that hides what is below it

    explicit TreeIndex(const Scene& scene)
        : fills_of_shape(scene.shapes.size()), composited(scene.nodes.size(), kNone),
          clipped(scene.nodes.size(), kNone), covers(scene.nodes.size(), false) {
        std::vector<std::uint32_t> open;
        for (std::uint32_t i = 0; i < scene.nodes.size(); ++i) {
            while (!open.empty() && scene.nodes[open.back()].end <= i)
                open.pop_back();
            if (!open.empty()) inherit(scene, i, open.back());
            if (scene.nodes[i].kind == Node::Kind::Group)
                open.push_back(i);
            else
                add_fill(scene, i);
        }
    }

  private:
    void add_fill(const Scene& scene, std::uint32_t i) {
        const Node& fill = scene.nodes[i];
        fills_of_shape[fill.shape].push_back(i);
        covers[i] = composited[i] == kNone && fill.opacity >= 1 && paint_is_opaque(scene.paints[fill.paint]);
    }

    void inherit(const Scene& scene, std::uint32_t i, std::uint32_t parent) {
        composited[i] = is_composited(scene.nodes[parent]) ? parent : composited[parent];
        clipped[i] = scene.nodes[parent].clip != kNone ? parent : clipped[parent];
    }
};

/// Builds the reduced stack of one set of inside shapes.
class StackBuilder {
  public:
    StackBuilder(const Scene& scene, const TreeIndex& index, bool skip_hidden)
        : scene_(scene), index_(index), skip_hidden_(skip_hidden), clips_(scene) {}

    Stack build(std::span<const std::uint32_t> inside) {
        clips_.reset(inside);
        active_.clear();
        for (std::uint32_t shape : inside)
            for (std::uint32_t fill : index_.fills_of_shape[shape])
                if (passes_clips(fill)) active_.push_back(fill);
        std::sort(active_.begin(), active_.end());
        return range(skip_hidden_ ? topmost_cover() : 0, scene_.root_end);
    }

  private:
    struct Level {
        std::uint32_t group = kNone;
        Stack stack;
    };

    bool passes_clips(std::uint32_t i) {
        for (; i != kNone; i = index_.clipped[i])
            if (scene_.nodes[i].clip != kNone && !clips_.inside(scene_.nodes[i].clip)) return false;
        return true;
    }

    /// The last active fill of the picture that hides everything below it.
    [[nodiscard]] std::uint32_t topmost_cover() const {
        for (auto it = active_.rbegin(); it != active_.rend(); ++it)
            if (*it < scene_.root_end && index_.covers[*it]) return *it;
        return 0;
    }

    /// The active fills of [first,end) — the picture or a mask's content — composited.
    Stack range(std::uint32_t first, std::uint32_t end) {
        std::vector<Level> levels(1);
        const auto begin = std::lower_bound(active_.begin(), active_.end(), first);
        for (auto it = begin; it != active_.end() && *it < end; ++it) {
            close_groups_before(*it, levels);
            open_groups_of(*it, levels);
            const Node& fill = scene_.nodes[*it];
            push_item(scene_, levels.back().stack, paint_item(scene_, fill.paint, std::clamp(fill.opacity, 0.0, 1.0)));
        }
        close_groups_before(end, levels);
        return std::move(levels.front().stack);
    }

    void open_groups_of(std::uint32_t fill, std::vector<Level>& levels) {
        const std::size_t at = levels.size();
        for (std::uint32_t g = index_.composited[fill]; g != levels[at - 1].group; g = index_.composited[g])
            levels.push_back({g, {}});
        std::reverse(levels.begin() + static_cast<std::ptrdiff_t>(at), levels.end());
    }

    void close_groups_before(std::uint32_t node, std::vector<Level>& levels) {
        while (levels.size() > 1 && scene_.nodes[levels.back().group].end <= node) {
            Level level = std::move(levels.back());
            levels.pop_back();
            close_group(scene_.nodes[level.group], std::move(level.stack), levels.back().stack);
        }
    }

    void close_group(const Node& group, Stack content, Stack& parent) {
        if (content.empty()) return;
        StackItem item;
        item.kind = StackItem::Kind::Group;
        item.blend = group.blend;
        item.opacity = std::clamp(group.opacity, 0.0, 1.0);
        item.content = std::move(content);
        for (std::uint32_t mask = group.mask; mask != kNone && item.opacity > 0; mask = scene_.masks[mask].parent)
            apply_mask(scene_.masks[mask], item);
        push_group(scene_, parent, std::move(item));
    }

    /// A mask that is constant here is only a factor.
    void apply_mask(const Mask& mask, StackItem& item) {
        Stack content;
        if (mask.region_shape == kNone || clips_.shape_inside(mask.region_shape)) content = range(mask.first, mask.end);
        if (const std::optional<Rgba> color = solid_color(content))
            item.opacity *= mask_value(mask.luminance, mask.linear_rgb, *color);
        else
            item.masks.push_back({mask.luminance, mask.linear_rgb, std::move(content)});
    }

    const Scene& scene_;
    const TreeIndex& index_;
    bool skip_hidden_;
    ClipEvaluator clips_;
    std::vector<std::uint32_t> active_;
};

std::uint64_t mixed(std::uint64_t h, std::uint64_t word) {
    h = (h ^ word) * 0xff51afd7ed558ccdu;
    return h ^ h >> 32;
}

using Key = std::vector<std::uint64_t>;

struct KeyHash {
    std::size_t operator()(const Key& key) const noexcept {
        std::uint64_t h = 0x9e3779b97f4a7c15u;
        for (std::uint64_t word : key)
            h = mixed(h, word);
        return static_cast<std::size_t>(h);
    }
};

/// Answers to sets of inside shapes, while there is room: the same sets come up all over the picture.
constexpr std::size_t kRememberedSets = std::size_t{1} << 16;
using Inside = std::vector<std::uint32_t>;
struct InsideEqual {
    using is_transparent = void;
    bool operator()(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) const noexcept {
        return std::ranges::equal(a, b);
    }
};
struct InsideHash {
    using transparent_key_equal = InsideEqual;
    std::size_t operator()(std::span<const std::uint32_t> inside) const noexcept {
        std::uint64_t h = 0x9e3779b97f4a7c15u;
        for (std::uint32_t shape : inside)
            h = mixed(h, shape);
        return static_cast<std::size_t>(h);
    }
};

/// Interned results.
struct Entry {
    Stack stack;
    Rgba color; ///< the rounded colour when solid
    bool solid = false;
};
constexpr std::uint32_t kShards = 16;
struct Shard {
    std::mutex mutex;
    std::unordered_map<Key, ResultId, KeyHash> index;
};

/// Products that are a tie in exact arithmetic must not fall to either side by rounding.
std::uint64_t rounded_channel(double v, ColorSteps steps) {
    return static_cast<std::uint64_t>(
        std::floor(std::clamp(v, 0.0, 1.0) * static_cast<double>(steps) + 0.5 + budget::kColourTie));
}

/// 16 bits for each channel, premultiplied: the identity of a solid colour.
std::uint64_t packed(const Rgba& c, ColorSteps steps) {
    return rounded_channel(c.r, steps) | rounded_channel(c.g, steps) << 16 | rounded_channel(c.b, steps) << 32 |
           rounded_channel(c.a, steps) << 48;
}

Rgba unpacked(std::uint64_t c, ColorSteps steps) {
    const auto channel = [&](int shift) {
        return static_cast<double>(c >> shift & 0xffff) / static_cast<double>(steps);
    };
    return {channel(0), channel(16), channel(32), channel(48)};
}

} // namespace

struct Compositor::Impl {
    Impl(const Scene& s, const SkipRules& rules, ColorSteps of_solids)
        : scene(s), skip(rules), steps(of_solids), index(s) {}

    /// A builder has scratch memory per clip: lent to one call at a time.
    std::unique_ptr<StackBuilder> take_builder() {
        const std::lock_guard lock(builders_mutex);
        if (builders.empty()) return std::make_unique<StackBuilder>(scene, index, skip.hidden_fills);
        std::unique_ptr<StackBuilder> builder = std::move(builders.back());
        builders.pop_back();
        return builder;
    }
    void give_back(std::unique_ptr<StackBuilder> builder) {
        const std::lock_guard lock(builders_mutex);
        builders.push_back(std::move(builder));
    }

    ResultId intern(Stack stack) {
        Entry entry;
        Key key;
        if (const std::optional<Rgba> color = solid_color(stack)) {
            key = {packed(*color, steps)}; // one word: no stack's key is that short
            entry.solid = true;
            entry.color = unpacked(key.front(), steps);
        } else {
            append_key(stack, key);
            entry.stack = std::move(stack);
        }
        Shard& shard = shards[(KeyHash{}(key) >> 60) % kShards];
        const std::lock_guard lock(shard.mutex);
        const auto [it, fresh] = shard.index.try_emplace(std::move(key), 0);
        if (fresh) it->second = static_cast<ResultId>(entries.push_back(std::move(entry)) - entries.begin());
        return it->second;
    }

    const Scene& scene;
    SkipRules skip;
    ColorSteps steps;
    TreeIndex index;
    std::mutex builders_mutex;
    std::vector<std::unique_ptr<StackBuilder>> builders;
    std::array<Shard, kShards> shards;
    tbb::concurrent_vector<Entry> entries; ///< by id; read without a lock, as `known` is
    tbb::concurrent_unordered_map<Inside, ResultId, InsideHash> known;
};

Compositor::Compositor(const Scene& scene, const SkipRules& skip, ColorSteps steps)
    : impl_(std::make_unique<Impl>(scene, skip, steps)) {}
Compositor::~Compositor() = default;

ResultId Compositor::resolve(std::span<const std::uint32_t> inside) {
    if (impl_->skip.known_results) {
        if (const auto it = impl_->known.find(inside); it != impl_->known.end()) return it->second;
    }
    std::unique_ptr<StackBuilder> builder = impl_->take_builder();
    Stack stack = builder->build(inside);
    impl_->give_back(std::move(builder));
    const ResultId result = impl_->intern(std::move(stack));
    if (impl_->skip.known_results && impl_->known.size() < kRememberedSets)
        impl_->known.emplace(Inside(inside.begin(), inside.end()), result);
    return result;
}

bool Compositor::is_solid(ResultId id) const { return impl_->entries[id].solid; }

Rgba Compositor::color(ResultId id, CanvasPoint p) const {
    const Entry& entry = impl_->entries[id];
    return entry.solid ? entry.color : stack_color(impl_->scene, entry.stack, p);
}

} // namespace fetexc
