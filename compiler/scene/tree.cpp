// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/scene/tree.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "compiler/scene/clip_tree.h"
#include "compiler/scene/validate.h"

namespace fetexc {
namespace {

using Nodes = std::vector<Node>;

class TreeBuilder {
  public:
    TreeBuilder(Scene& scene, const std::vector<bool>& drop, bool drop_invisible)
        : scene_(scene), drop_(drop), drop_invisible_(drop_invisible), walk_(scene), composer_(scene),
          mask_content_(scene.masks.size()), blends_with_level_(blends_with_level()) {}

    void run() {
        Nodes out;
        emit_range(kNone, 0, static_cast<std::uint32_t>(scene_.nodes.size()), kNone, out);
        scene_.root_end = static_cast<std::uint32_t>(out.size());
        for (std::uint32_t i = 0; i < scene_.masks.size(); ++i)
            append_mask(i, out);
        scene_.nodes = std::move(out);
    }

  private:
    /// For each group: does a child, or a child of a group that is transparent to it, blend with what lies below?
    /// If not, isolating the group changes nothing.
    [[nodiscard]] std::vector<bool> blends_with_level() const {
        std::vector<bool> out(scene_.nodes.size(), false);
        std::vector<std::uint32_t> open;
        std::vector<std::uint32_t> parent(scene_.nodes.size(), kNone);
        for (std::uint32_t i = 0; i < scene_.nodes.size(); ++i) {
            while (!open.empty() && scene_.nodes[open.back()].end <= i)
                open.pop_back();
            if (!open.empty()) parent[i] = open.back();
            if (scene_.nodes[i].kind == Node::Kind::Group) open.push_back(i);
        }
        for (std::size_t i = scene_.nodes.size(); i-- > 0;) {
            const Node& node = scene_.nodes[i];
            if (parent[i] == kNone || node.kind != Node::Kind::Group) continue;
            const bool seen_through = !(node.opacity < 1) && node.mask == kNone;
            if (node.blend != Blend::Normal || (seen_through && out[i])) out[parent[i]] = true;
        }
        return out;
    }

    /// Siblings from `at` to `end`; own_first is a mask's first node when the range is that mask's content.
    void emit_range(std::uint32_t own_first, std::uint32_t at, std::uint32_t end, std::uint32_t clip, Nodes& out) {
        while ((at = walk_.settle(at, own_first, end)) < end) {
            const bool group = scene_.nodes[at].kind == Node::Kind::Group;
            if (group)
                emit_group(at, clip, out);
            else
                emit_fill(at, clip, out);
            at = group ? scene_.nodes[at].end : at + 1;
        }
    }

    void emit_fill(std::uint32_t i, std::uint32_t clip, Nodes& out) {
        if (i < drop_.size() && drop_[i]) return;
        Node node = scene_.nodes[i];
        node.clip = composer_.compose(node.clip, clip);
        node.opacity = std::clamp(node.opacity, 0.0, 1.0);
        node.end = static_cast<std::uint32_t>(out.size()) + 1;
        out.push_back(node);
    }

    void emit_group(std::uint32_t i, std::uint32_t outer_clip, Nodes& out) {
        Node group = scene_.nodes[i];
        group.opacity = std::clamp(group.opacity, 0.0, 1.0);
        group.isolated = group.isolated && blends_with_level_[i];
        if (drop_invisible_ && is_invisible(group)) return;
        const bool composable = composer_.can_compose(group.clip, outer_clip);
        if (!composable) return emit_clip_wrapper(i, outer_clip, out);
        const std::uint32_t clip = composer_.compose(group.clip, outer_clip);
        if (!is_composited(group) && can_push(i, clip)) return emit_range(kNone, i + 1, group.end, clip, out);
        group.clip = clip;
        emit_kept_group(i, group, out);
    }

    /// Pushing must be possible for every child; one that can't take the clip keeps the whole group.
    [[nodiscard]] bool can_push(std::uint32_t i, std::uint32_t clip) const {
        if (clip == kNone) return true;
        const std::uint32_t end = scene_.nodes[i].end;
        for (std::uint32_t at = walk_.settle(i + 1, kNone, end); at < end;) {
            if (!composer_.can_compose(scene_.nodes[at].clip, clip)) return false;
            const bool group = scene_.nodes[at].kind == Node::Kind::Group;
            at = walk_.settle(group ? scene_.nodes[at].end : at + 1, kNone, end);
        }
        return true;
    }

    /// The outer clip could not be chained to the group's own: a plain group carries it.
    void emit_clip_wrapper(std::uint32_t i, std::uint32_t outer_clip, Nodes& out) {
        Node wrapper;
        wrapper.kind = Node::Kind::Group;
        wrapper.clip = outer_clip;
        const std::size_t at = out.size();
        out.push_back(wrapper);
        emit_kept_group(i, scene_.nodes[i], out);
        close_group(at, out);
    }

    void emit_kept_group(std::uint32_t i, Node group, Nodes& out) {
        const std::size_t at = out.size();
        const std::uint32_t end = scene_.nodes[i].end;
        out.push_back(group);
        emit_range(kNone, i + 1, end, kNone, out);
        close_group(at, out);
    }

    /// An empty group goes; opacity over a single fill moves into the fill.
    void close_group(std::size_t at, Nodes& out) {
        if (out.size() == at + 1) {
            out.pop_back();
            return;
        }
        out[at].end = static_cast<std::uint32_t>(out.size());
        const Node group = out[at];
        const bool one_fill = out.size() == at + 2 && out.back().kind == Node::Kind::Fill;
        if (!one_fill || group.blend != Blend::Normal || group.mask != kNone) return;
        if (!composer_.can_compose(out.back().clip, group.clip)) return;
        Node fill = out.back();
        fill.opacity *= group.opacity;
        fill.clip = composer_.compose(fill.clip, group.clip);
        fill.end = static_cast<std::uint32_t>(at) + 1;
        out.pop_back();
        out.back() = fill;
    }

    [[nodiscard]] bool is_invisible(const Node& group) {
        return group.opacity <= 0 || (group.mask != kNone && mask_is_empty(group.mask));
    }

    bool mask_is_empty(std::uint32_t i) {
        const std::uint32_t parent = scene_.masks[i].parent;
        return mask_content(i).empty() || (parent != kNone && mask_is_empty(parent));
    }

    /// A mask's rebuilt content, ends relative to its first node.
    const Nodes& mask_content(std::uint32_t i) {
        if (!mask_content_[i]) {
            const Mask mask = scene_.masks[i];
            Nodes content;
            emit_range(mask.first, mask.first, mask.end, kNone, content);
            mask_content_[i] = std::move(content);
        }
        return *mask_content_[i];
    }

    void append_mask(std::uint32_t i, Nodes& out) {
        const auto first = static_cast<std::uint32_t>(out.size());
        for (Node node : mask_content(i)) {
            node.end += first;
            out.push_back(node);
        }
        new_ranges_.emplace_back(first, static_cast<std::uint32_t>(out.size()));
    }

  public:
    /// Only after run(), which needs the old ranges throughout.
    void store_mask_ranges() {
        for (std::uint32_t i = 0; i < scene_.masks.size(); ++i)
            std::tie(scene_.masks[i].first, scene_.masks[i].end) = new_ranges_[i];
    }

  private:
    Scene& scene_;
    const std::vector<bool>& drop_;
    bool drop_invisible_;
    SiblingWalk walk_;
    ClipComposer composer_;
    std::vector<std::optional<Nodes>> mask_content_;
    std::vector<bool> blends_with_level_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> new_ranges_;
};

} // namespace

void rebuild_tree(Scene& scene, const std::vector<bool>& drop, bool drop_invisible) {
    TreeBuilder builder(scene, drop, drop_invisible);
    builder.run();
    builder.store_mask_ranges();
}

} // namespace fetexc
